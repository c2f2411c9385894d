// Errors of deflections and frequencies by the adjoint: against meshes that are refined for them until they are far better, and what
// such refinement saves.
#include "elastic/goals/goals.hpp"

#include <gtest/gtest.h>

#include "core/goals/corner_order.hpp"
#include "core/goals/refined_size.hpp"
#include "solids.hpp"

namespace splashdown::elastic::goals_test {
namespace {

TEST(CornerOrder, exponents_are_those_of_williams) {
  using enum CornerSide;
  const double right = std::numbers::pi / 2, kappa = 3 - 4 * 0.3;
  EXPECT_NEAR(corner_exponent(3 * right, free, free, kappa), 0.544484, 1e-6);
  EXPECT_NEAR(corner_exponent(4 * right, free, free, kappa), 0.5, 1e-6);
  EXPECT_NEAR(corner_exponent(3 * right, held, held, 1), 0.544484, 1e-6);  // Moffatt's
  EXPECT_NEAR(corner_exponent(right, held, free, kappa), 0.711173, 1e-5);
  EXPECT_NEAR(corner_exponent(2 * right, free, held, kappa), 0.5, 0.005);  // the real part of a pair
  EXPECT_EQ(corner_exponent(right, free, free, kappa), 1);
  EXPECT_EQ(corner_exponent(right / 3, free, held, kappa), 1);
}

enum class Form { bracket, taper, notch };

/// A plate of the class: its outline and what holds it, what it is made of, what bends it, and where it is looked at.
struct Plate {
  Surface<2> outline;
  Vec<2> point;
  std::shared_ptr<const Law<2>> law;
  Vec<2> force;  // per volume
  double thin;   // the thinnest part

  Plate(Form form, std::mt19937& random) {
    const auto uniform = [&](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(random);
    };
    const double length = uniform(2, 4), height = uniform(0.6, 1.2);
    const double end = uniform(0.4, 0.8) * height, depth = uniform(0.3, 0.6) * height;
    point = {length, 0};
    thin = end;
    switch (form) {
      case Form::bracket: {
        const double top = end + uniform(1, 2), inner = length - end;
        outline = polygon({{0, 0}, {length, 0}, {length, top}, {inner, top}, {inner, end}, {0, end}});
        point = {length, top};
        break;
      }
      case Form::taper:
        outline = polygon({{0, 0}, {length, 0}, {length, end}, {0, height}});
        break;
      case Form::notch: {
        const double at = uniform(0.25, 0.5) * length, half = uniform(0.05, 0.3);
        outline = polygon({{0, 0},
                           {length, 0},
                           {length, height},
                           {at + half, height},
                           {at, height - depth},
                           {at - half, height},
                           {0, height}});
        thin = height - depth;
        break;
      }
    }
    const Isotropic moduli{.young_modulus = 1, .poisson_ratio = uniform(0, 0.45)};
    const int choice = std::uniform_int_distribution<int>(0, 2)(random);
    law = choice == 0 ? small_strain<2>(moduli) : choice == 1 ? st_venant_kirchhoff<2>(moduli) : neo_hookean<2>(moduli);
    // The tip of a beam goes down by 1.5 w L^4/h^2: up to a third of its length, less where strains are infinite.
    const double turn = uniform(0, 2 * std::numbers::pi), most = form == Form::taper ? 0.2 : 0.03;
    force = uniform(0.1, 1) * most * thin * thin / std::pow(length, 3) * Vec<2>(std::cos(turn), std::sin(turn));
  }

  std::unique_ptr<Solid<2>> on(const SolidMesh<2>& mesh) const {
    auto solid = std::make_unique<Solid<2>>(mesh, law, 1);
    solid->clamp([](const Vec<2>& X) { return X.x() < 1e-9; });
    return solid;
  }
  LoadOn<2> load() const {
    return [w = force](const Solid<2>& solid) -> Field { return solid.mass() * solid.uniform(w); };
  }
  /// The way that the point is displaced, nearly.
  Vec<2> way() const {
    const auto solid = on(outline_mesh(outline, thin));
    const auto place = *locate<2>(solid->mesh(), point, 1e-9);
    return solid->value(equilibrium(*solid, load()(*solid)), place).normalized();
  }
};

constexpr int deflection = 0;

/// A deflection along a direction, or a frequency.
GoalError goal_on(const Plate& plate, const SolidMesh<2>& mesh, int mode, const Vec<2>& way) {
  const auto solid = plate.on(mesh);
  if (mode != deflection) return frequency_goal(*solid, mode);
  const Field u = equilibrium(*solid, plate.load()(*solid));
  return deflection_goal<2>(*solid, u, plate.load(), *locate<2>(solid->mesh(), plate.point, 1e-9), way);
}

/// A mesh that is better for a goal.
SolidMesh<2> refined(const Plate& plate, const SolidMesh<2>& mesh, const GoalError& goal) {
  return outline_mesh(plate.outline, [size = refined_size(mesh.nodes, mesh.cells, goal.by_cell, refined_share),
                                      most = plate.thin](const Vec<2>& x) { return std::min(most, size(x)); });
}

/// What the goal truly is: its error on the last mesh is a fiftieth of that on the first, and what is told of it is taken off.
double truth(const Plate& plate, int mode, const Vec<2>& way) {
  auto mesh = outline_mesh(plate.outline, plate.thin);
  const double first = std::abs(goal_on(plate, mesh, mode, way).error);
  for (int k = 0; k < 14; ++k) {
    const auto goal = goal_on(plate, mesh, mode, way);
    if (std::abs(goal.error) < 0.002 * first) return goal.value - goal.error;
    mesh = refined(plate, mesh, goal);
  }
  const auto goal = goal_on(plate, mesh, mode, way);
  EXPECT_LT(std::abs(goal.error), 0.02 * first);
  return goal.value - goal.error;
}

void expect_effectivity(int plates, unsigned seed) {
  std::mt19937 random(seed);
  for (int k = 0; k < plates; ++k)
    for (const auto form : {Form::bracket, Form::taper, Form::notch}) {
      const Plate plate(form, random);
      const auto way = plate.way();
      for (const int mode : {deflection, 1, 2}) {
        const double exact = truth(plate, mode, way);
        for (const double parts : {1., 1.7}) {
          const auto goal = goal_on(plate, outline_mesh(plate.outline, plate.thin / parts), mode, way);
          const double effectivity = goal.error / (goal.value - exact);
          std::printf("plate %d form %d goal %d: error %.2e, told %.3f of it\n", k, static_cast<int>(form), mode,
                      (goal.value - exact) / exact, effectivity);
          EXPECT_GT(effectivity, 0.7) << k << " " << static_cast<int>(form) << " " << mode;
          EXPECT_LT(effectivity, 1.5) << k << " " << static_cast<int>(form) << " " << mode;
        }
      }
    }
}

// Of plates with corners, random in all that they have; deflections up to a third of the length.
TEST(SolidGoal, error_is_the_true_one) { expect_effectivity(2, 7); }
TEST(SolidGoalNightly, error_is_the_true_one_of_sixty_plates) { expect_effectivity(20, 11); }

// Meshes alike everywhere are of order 2 lambda, about 1.1, at the corner of a bracket.
TEST(SolidGoal, refinement_by_it_takes_half_the_unknowns) {
  std::mt19937 random(3);
  const Plate plate(Form::bracket, random);
  const auto way = plate.way();
  for (const int mode : {deflection, 1}) {
    const double exact = truth(plate, mode, way);
    const auto alike = outline_mesh(plate.outline, plate.thin / 4);
    const double error = std::abs(goal_on(plate, alike, mode, way).value - exact);
    auto mesh = outline_mesh(plate.outline, plate.thin);
    double least = std::numeric_limits<double>::infinity();
    int nodes = 0;
    for (int k = 0; k < 12; ++k) {
      const auto goal = goal_on(plate, mesh, mode, way);
      if (2 * mesh.size() > alike.size()) break;
      if (std::abs(goal.value - exact) < least) {
        least = std::abs(goal.value - exact);
        nodes = mesh.size();
      }
      mesh = refined(plate, mesh, goal);
    }
    std::printf("goal %d: %d nodes alike, error %.2e; refined %d, %.2e\n", mode, alike.size(), error / exact, nodes,
                least / exact);
    EXPECT_LT(least, error);
  }
}

// Edges of the clamp are singular in space.
TEST(SolidGoal, error_in_space_is_the_true_one) {
  const Vec<3> size(3, 1, 0.8);
  const auto on = [&](int n) {
    auto solid = std::make_unique<Solid<3>>(box_mesh<3>(size, {3 * n, n, n}), small_strain<3>(soft), 1);
    solid->clamp([](const Vec<3>& X) { return X.x() < 1e-9; });
    return solid;
  };
  const LoadOn<3> load = [](const Solid<3>& solid) -> Field { return solid.mass() * solid.uniform({0, 0, -1e-3}); };
  const auto deflection_on = [&](const Solid<3>& solid) {
    return deflection_goal<3>(solid, equilibrium(solid, load(solid)), load, *locate<3>(solid.mesh(), size, 1e-9),
                              Vec<3>::UnitZ());
  };
  const auto coarse = on(1), fine = on(2);
  const auto of_coarse = deflection_on(*coarse), of_fine = deflection_on(*fine);
  const double off = of_coarse.value - (of_fine.value - of_fine.error);
  EXPECT_GT(of_coarse.error / off, 0.7);
  EXPECT_LT(of_coarse.error / off, 1.5);
  const auto f_coarse = frequency_goal(*coarse, 1), f_fine = frequency_goal(*fine, 1);
  const double f_off = f_coarse.value - (f_fine.value - f_fine.error);
  EXPECT_GT(f_coarse.error / f_off, 0.7);
  EXPECT_LT(f_coarse.error / f_off, 1.5);
}

template <int d>
void expect_same(const SolidMesh<d>& mesh) {
  Solid<d> solid(mesh, small_strain<d>(soft), 2);
  solid.clamp([](const Vec<d>& X) { return X.x() < 1e-9; });
  const auto place = *locate<d>(mesh, Vec<d>::Constant(0.4), 1e-9);
  solid.add_point_mass(place, 0.7);
  const auto [fine, places] = solid.divided();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Field u(solid.size()), at(fine.size());
  for (double& x : u) x = uniform(random);
  leave_out(solid.held(), u);
  for (int a = 0; a < fine.mesh().size(); ++a) {
    const auto& [cell, in] = places[static_cast<std::size_t>(a)];
    at.template segment<d>(d * a) = solid.value(u, {cell, in});
  }
  const double energy = solid.strain_energy(u), motion = u.dot(solid.mass() * u);
  EXPECT_NEAR(fine.strain_energy(at), energy, 1e-12 * energy);
  EXPECT_NEAR(at.dot(fine.mass() * at), motion, 1e-12 * motion);
  EXPECT_LT((fine.value(at, in_divided<d>(place)) - solid.value(u, place)).norm(), 1e-13);
  Field left = at;
  leave_out(fine.held(), left);
  EXPECT_EQ((left - at).norm(), 0);
}

TEST(SolidGoal, a_divided_solid_has_the_same_energies_for_what_was_there) {
  expect_same<2>(shaken(box_mesh<2>({2, 1}, {4, 3}), 0.08));
  expect_same<3>(shaken(box_mesh<3>({2, 1, 1}, {3, 3, 3}), 0.08));
}

}  // namespace
}  // namespace splashdown::elastic::goals_test
