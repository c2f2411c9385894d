// A body whose wall deforms, by itself and with water of a hundred lines, for tests.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "elastic/participant.hpp"
#include "solids.hpp"
#include "tests/unit/coupling/toys.hpp"

namespace splashdown::elastic {

using coupling::toys::Matrix;
using coupling::toys::Vector;
using coupling::toys::Water;

constexpr int all_nodes = 0;

template <int d>
SolidMesh<d> box() {
  if constexpr (d == 2)
    return box_mesh<2>({4, 1}, {4, 1});
  else
    return box_mesh<3>({3, 1, 1}, {2, 1, 1});
}

/// A body of density 1; young_modulus 1 makes waves cross it in its length in seconds.
template <int d>
struct Made {
  bool linear = false, clamped = false;
  int modes = all_nodes;
  bool both = false;  // all nodes move, and the exact term has the modes
  double young_modulus = 1;
  Vec<d> gravity = Vec<d>::Zero();
  Twist<d> velocity = Twist<d>::Zero();
  Rayleigh damping = {};
  double unresolved = 0;
  std::function<Vec<d>(double)> drive = {};  ///< velocity of what is clamped

  std::unique_ptr<Solid<d>> solid() const {
    const Isotropic moduli{young_modulus, 0.33};
    auto made =
        std::make_unique<Solid<d>>(box<d>(), linear ? small_strain<d>(moduli) : st_venant_kirchhoff<d>(moduli), 1);
    if (clamped) made->clamp([](const Vec<d>& X) { return X.x() < 1e-9; });
    return made;
  }
  std::unique_ptr<Participant<d>> part() const {
    std::vector<SolidSpec<d>> specs;
    auto& spec = specs.emplace_back();
    spec.solid = solid();
    spec.body.name = "box";
    spec.body.pose.translation() = spec.solid->centre(Field::Zero(spec.solid->size()));
    spec.body.velocity = velocity;
    spec.gravity = gravity;
    spec.damping = damping;
    spec.unresolved = unresolved;
    spec.wall = WallChoice{modes, both};
    if (drive)
      spec.drive = [move = drive, held = spec.solid->held()](double t) {
        Field all = Field::Zero(static_cast<Eigen::Index>(held.size()));
        for (std::size_t k = 0; k < held.size(); ++k)
          if (held[k]) all[static_cast<Eigen::Index>(k)] = move(t)[static_cast<Eigen::Index>(k) % d];
        return all;
      };
    return std::make_unique<Participant<d>>(std::move(specs));
  }
};

/// Water that sticks to every vertex, `heaviness` times the body's mass, all of it coupled to all.
inline Matrix added_mass(const coupling::StructurePart& body, double heaviness) {
  const Eigen::Index n = body.scales().size();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Matrix R = Matrix::NullaryExpr(n, n, [&] { return uniform(random); });
  const Matrix G = Matrix::Identity(n, n) + 3. / static_cast<double>(n) * R.transpose() * R;
  return heaviness * 2 * body.walls()[0].mass / G.diagonal().sum() * G;
}

/// It goes along with the body at t = 0, or is hit by it; a spring pulls it back to where it is then.
inline std::unique_ptr<Water> water_for(const coupling::StructurePart& body, double heaviness, double spring,
                                        bool goes_along = true) {
  const Matrix G = added_mass(body, heaviness), I = Matrix::Identity(G.rows(), G.rows());
  auto water =
      std::make_unique<Water>(G, 0 * I, spring * I, std::vector<std::size_t>(static_cast<std::size_t>(G.rows()), 0));
  water->rest = water->state().place = body.placement();
  if (goes_along) water->state().rate = body.velocities();
  return water;
}

/// Pushes the surface step by step, with steps of different lengths; looks at the body after each.
template <int d>
void push_on(Participant<d>& body, int steps, double dt, const std::function<Vector(double)>& force,
             const std::function<void(double work, double t)>& look, bool same = false) {
  double last = 0, t = 0;
  for (int k = 0; k < steps; ++k) {
    const double length = !same && k % 3 == 0 ? 0.7 * dt : dt, kick = (last + length) / 2;
    const Vector before = body.velocities(), impulse = kick * force(t);
    body.begin({.kick = kick, .dt = length});
    body.solve(impulse);
    ASSERT_TRUE(body.acceptable().ok()) << body.acceptable().cause;
    body.commit();
    t += length;
    last = length;
    look(0.5 * impulse.dot(before + body.velocities()), t);
  }
}

}  // namespace splashdown::elastic
