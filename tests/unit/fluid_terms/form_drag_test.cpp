// Laws of form drag on a hull in a cloud of nodes, without pressure.
#include "fluid/effects/form_drag/form_drag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fluid_terms/still_mesh.hpp"

namespace splashdown::fluid::form_drag_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double roundoff = 1e-12;

/// A cube or a square with sides of 1.6, or a plate that is thin along the last axis, in the midst of nodes on a lattice. Facets of
/// a hull are its own, finely cut along the first axis.
template <int d>
struct Cloud : testing::StillMesh<d> {
  using testing::StillMesh<d>::nodes;
  using testing::StillMesh<d>::mesh;
  using testing::StillMesh<d>::lumped_volume;
  using testing::StillMesh<d>::walls;
  using testing::StillMesh<d>::poses;
  std::vector<Twist<d>> motion{Twist<d>::Zero()};
  bool closes = true;  ///< the flow behind the hull
  double spacing = d == 2 ? 0.05 : 0.2;
  bool half_only = false;

  /// `only_half`: what lies at x > 0.
  explicit Cloud(double thickness = 1.6, int cuts = 8, bool only_half = false) : half_only(only_half) {
    walls.resize(1);
    poses.assign(1, Isometry<d>::Identity());
    Vec<d> half = Vec<d>::Constant(0.8);
    half[d - 1] = thickness / 2;
    const int count = static_cast<int>(std::ceil(2 * half.norm() / spacing));
    Eigen::Matrix<int, d, 1> at = Eigen::Matrix<int, d, 1>::Constant(-count);
    while (at[d - 1] <= count) {
      const Vec<d> x = spacing * (at.template cast<double>().array() + 0.5);
      if ((x.array().abs() > half.array()).any() && (x[0] > 0 || !half_only)) {
        nodes.add(x, Vec<d>::Zero(), 0, {}, false);
        lumped_volume.push_back(std::pow(spacing, d));
      }
      for (int k = 0; k < d && ++at[k] > count && k < d - 1; ++k) at[k] = -count;
    }
    for (int axis = 0; axis < d; ++axis)
      for (const double side : {-1.0, 1.0}) add_side(axis, side, half, cuts);
    walls[0].surface.vertices.resize(d, static_cast<Eigen::Index>(mesh.boundary.size()) * d);
    walls[0].surface.facets.resize(d, static_cast<Eigen::Index>(mesh.boundary.size()));
    for (std::size_t f = 0; f < mesh.boundary.size(); ++f)
      for (int k = 0; k < d; ++k) {
        const auto vertex = static_cast<int>(d * f) + k;
        walls[0].surface.vertices.col(vertex) = nodes.x[mesh.boundary[f].nodes[d - 1 - k]];
        walls[0].surface.facets(k, static_cast<Eigen::Index>(f)) = vertex;
      }
  }

  /// The water past the hull runs towards its middle faster than the hull moves: a flow that closes.
  void close_behind() {
    for (const auto& f : mesh.boundary) {
      const Vec<d> normal = area_vector_of<d>(f, nodes.x).normalized();
      Vec<d> centre = Vec<d>::Zero();
      for (int n : f.nodes) centre += nodes.x[n] / d;
      const Vec<d> past = rigid_velocity<d>(motion[0], centre);
      Vec<d> inward = middle_of_rear() - centre;
      inward -= normal * normal.dot(inward);
      for (int n : f.nodes) nodes.v[n] = past + 2 * past.norm() * inward.normalized();
    }
  }
  Vec<d> middle_of_rear() const {
    Vec<d> sum = Vec<d>::Zero();
    double all = 0;
    for (const auto& f : mesh.boundary) {
      Vec<d> centre = Vec<d>::Zero();
      for (int n : f.nodes) centre += nodes.x[n] / d;
      const double rear = std::max(0.0, area_vector_of<d>(f, nodes.x).dot(rigid_velocity<d>(motion[0], centre)));
      sum += rear * centre, all += rear;
    }
    if (half_only) sum[0] = 0;
    return sum / all;
  }
  /// Velocities after a kick; `impulse`: on the hull about its centre.
  std::vector<Vec<d>> predict(FormDrag<d>& effect, Wrench<d>& impulse) {
    if (closes) close_behind();
    return this->with_view([&](const StepView<d>& view) {
      std::vector<Vec<d>> v = nodes.v;
      const std::vector<WallVelocity<d>> hulls(motion.begin(), motion.end());
      std::vector<WallImpulse<d>> on_walls(1);
      EXPECT_TRUE(effect.begin(view).ok());
      EXPECT_TRUE(effect.predict(view, {nodes.v, hulls}, {v, on_walls}).ok());
      impulse = on_walls[0].rigid;
      return v;
    });
  }
  void commit(FormDrag<d>& effect) const {
    this->with_view([&](const StepView<d>& view) { effect.commit(view); });
  }

 private:
  int corner(const Vec<d>& x) {
    lumped_volume.push_back(0);
    return nodes.add(x, Vec<d>::Zero(), 0, {.wall = 0}, false);
  }
  // Area vectors point into the hull.
  void add_side(int axis, double side, const Vec<d>& half, int cuts) {
    for (int c = 0; c < cuts; ++c) {
      const int along = axis == 0 ? 1 : 0;
      Vec<d> a = -half, b = half;
      a[axis] = b[axis] = side * half[axis];
      a[along] = -half[along] + 2 * half[along] * c / cuts;
      b[along] = -half[along] + 2 * half[along] * (c + 1) / cuts;
      if (half_only && a[0] + b[0] <= 0) continue;
      std::vector<std::array<Vec<d>, d>> facets;
      if constexpr (d == 2) {
        facets = {{a, b}};
      } else {
        Vec<3> ab = b, ba = a;
        ab[3 - axis - along] = a[3 - axis - along], ba[3 - axis - along] = b[3 - axis - along];
        facets = {{a, ab, b}, {a, b, ba}};
      }
      for (auto& f : facets) {
        if (area_vector(f)[axis] * side > 0) std::swap(f[0], f[1]);
        Facet<d> facet{{}, 0};
        for (int k = 0; k < d; ++k) facet.nodes[k] = corner(f[k]);
        mesh.boundary.push_back(facet);
      }
    }
  }
};

template <int d>
FormDrag<d> drag(double coefficient = 1.3, double develops = 0) {
  return FormDrag<d>({{.coefficient = coefficient, .develops = develops}});
}

template <class Dimension>
class FormDragIn : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FormDragIn, Dimensions);

TYPED_TEST(FormDragIn, is_that_of_the_coefficient_in_water_at_rest_and_in_a_current) {
  constexpr int d = TypeParam::value;
  const double area = std::pow(1.6, d - 1);
  for (int axis = 0; axis < d; ++axis)
    for (const double speed : {0.01, 2.0, -30.0})
      for (const double current : {0.0, 7.0}) {
        Cloud<d> cloud;
        cloud.motion[0][axis] = speed + current;
        cloud.set_velocity([&](const Vec<d>&) -> Vec<d> { return current * Vec<d>::Unit(axis); });
        auto effect = drag<d>();
        Wrench<d> impulse;
        cloud.predict(effect, impulse);
        const double exact = -650 * area * speed * std::abs(speed) * cloud.kick;
        EXPECT_LT((impulse - exact * Wrench<d>::Unit(axis)).norm(), 100 * roundoff * (std::abs(exact) + current))
            << speed << " " << current;
      }
}

// The mirror stands across the first axis, and the hull, which reaches across it, moves along the last one. At once, and as drag grows.
TYPED_TEST(FormDragIn, of_one_half_before_a_mirror_is_half_of_that_of_the_whole) {
  constexpr int d = TypeParam::value;
  for (const double develops : {0.0, 0.01})
    for (const bool closes : {true, false}) {
      Cloud<d> whole, half(1.6, 8, true);
      half.walls = whole.walls;
      for (auto* cloud : {&whole, &half}) {
        cloud->motion[0][d - 1] = -3;
        cloud->closes = closes;
        cloud->set_velocity([&](const Vec<d>& x) -> Vec<d> { return 0.2 * x[0] * x[0] * Vec<d>::Unit(d - 1); });
      }
      auto effect = drag<d>(1.3, develops);
      FormDrag<d> mirrored({{.coefficient = 1.3, .develops = develops}}, Mirror{0, 0});
      Wrench<d> on_whole, on_half;
      std::vector<Vec<d>> v_whole, v_half;
      for (int step = 0; step < 3; ++step) {
        v_whole = whole.predict(effect, on_whole), v_half = half.predict(mirrored, on_half);
        EXPECT_LE((on_half - 0.5 * on_whole).norm(), 1e3 * roundoff * on_whole.norm());
        whole.commit(effect), half.commit(mirrored);
      }
      EXPECT_GT(on_whole.norm(), 0);
      std::size_t same = 0;
      for (std::size_t i = 0; i < v_half.size(); ++i)
        for (std::size_t k = 0; k < v_whole.size(); ++k)
          if (half.nodes.x[i] == whole.nodes.x[k] && half.nodes.tie[i].wall < 0) {
            EXPECT_LT((v_half[i] - v_whole[k]).norm(), 1e3 * roundoff) << i;
            ++same;
          }
      EXPECT_GT(same, 50U);
    }
}

// The velocity that a circle or sphere as large as the hull's makes: a dipole, whose mean over spheres is zero. The lattice knows
// spheres to its spacing over their radius.
TYPED_TEST(FormDragIn, takes_no_notice_of_the_flow_that_the_hull_makes) {
  constexpr int d = TypeParam::value;
  Cloud<d> cloud;
  const Vec<d> u = Vec<d>::Unit(0) * 2;
  cloud.motion[0].template head<d>() = u;
  auto effect = drag<d>();
  Wrench<d> in_still_water, in_its_flow;
  cloud.predict(effect, in_still_water);
  cloud.set_velocity([&](const Vec<d>& x) -> Vec<d> {
    const double r = x.norm(), strength = d == 2 ? 1.0 : 0.5;
    return strength / std::pow(r, d) * (d * x.dot(u) / (r * r) * x - u);
  });
  cloud.predict(effect, in_its_flow);
  EXPECT_LT((in_its_flow - in_still_water).norm(), 0.02 * in_still_water.norm());
}

// In a first impact and in front of an open cavity.
TYPED_TEST(FormDragIn, is_absent_where_the_rear_is_dry) {
  constexpr int d = TypeParam::value;
  Cloud<d> cloud;
  cloud.motion[0][d - 1] = -5;
  cloud.closes = false;  // there is nothing behind
  std::erase_if(cloud.mesh.boundary, [&](const Facet<d>& f) { return area_vector_of<d>(f, cloud.nodes.x)[d - 1] < 0; });
  auto effect = drag<d>();
  Wrench<d> impulse;
  EXPECT_EQ(cloud.predict(effect, impulse), cloud.nodes.v);
  EXPECT_EQ(impulse, Wrench<d>(Wrench<d>::Zero()));
}

// Off sharp edges the fluid separates by itself.
TYPED_TEST(FormDragIn, is_small_where_the_water_behind_goes_with_the_hull) {
  constexpr int d = TypeParam::value;
  Cloud<d> cloud;
  cloud.motion[0][0] = 5;
  cloud.closes = false;
  for (std::size_t i = 0; i < cloud.nodes.size(); ++i)
    if (cloud.nodes.tie[i].wall == 0) cloud.nodes.v[i] = 5 * Vec<d>::UnitX();
  auto effect = drag<d>();
  Wrench<d> impulse;
  cloud.predict(effect, impulse);
  const double whole = 650 * std::pow(1.6, d - 1) * 25 * cloud.kick;
  EXPECT_NEAR(-impulse[0], 0.13 * whole, 1e-9 * whole);
}

TYPED_TEST(FormDragIn, water_and_hull_keep_momentum_and_its_moment_and_lose_energy) {
  constexpr int d = TypeParam::value;
  Cloud<d> cloud(0.4, 8);
  for (int k = 0; k < freedoms<d>; ++k) cloud.motion[0][k] = 2 - 0.7 * k;
  cloud.set_velocity([](const Vec<d>& x) -> Vec<d> { return 0.2 * (3 * x).array().sin(); });
  auto effect = drag<d>();
  for (const double kick : {1e-4, 1e-2, 1.0}) {
    cloud.kick = kick;
    Wrench<d> impulse;
    const auto v = cloud.predict(effect, impulse);
    EXPECT_GT(impulse.norm(), 0);
    EXPECT_LT((cloud.momentum(v) - cloud.momentum(cloud.nodes.v) + impulse).norm(), 1e-9 * impulse.norm()) << kick;
    const double gain = cloud.kinetic_energy(v) - cloud.kinetic_energy(cloud.nodes.v) + impulse.dot(cloud.motion[0]);
    EXPECT_LT(gain, 0) << kick;
    EXPECT_NEAR(effect.diagnostics(cloud.nodes, {})[0].second * kick, gain, 1e-8 * std::abs(gain)) << kick;
  }
}

TYPED_TEST(FormDragIn, turns_with_water_and_hull) {
  constexpr int d = TypeParam::value;
  Cloud<d> cloud(0.4, 8);
  for (int k = 0; k < freedoms<d>; ++k) cloud.motion[0][k] = 2 - 0.7 * k;
  auto effect = drag<d>();
  Wrench<d> straight, turned;
  cloud.predict(effect, straight);
  Mat<d> turn;
  if constexpr (d == 2)
    turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  else
    turn = Eigen::AngleAxisd(0.7, Vec<3>(1, -2, 0.5).normalized()).toRotationMatrix();
  for (auto& x : cloud.nodes.x) x = turn * x;
  Isometry<d> turned_by = Isometry<d>::Identity();
  turned_by.linear() = turn;
  cloud.poses[0] = turned_by;
  const auto rotated = [&](Wrench<d> w) {
    w.template head<d>() = turn * w.template head<d>();
    if constexpr (d == 3) w.template tail<3>() = turn * w.template tail<3>();
    return w;
  };
  cloud.motion[0] = rotated(cloud.motion[0]);
  cloud.predict(effect, turned);
  EXPECT_LT((turned - rotated(straight)).norm(), 1e-9 * straight.norm());
}

// Strips of a plate that turns about its middle: M = C/2 rho int |w r|^2 r dr = C rho w^2 a^4 / 4, by the midpoint rule.
TEST(FormDrag, of_a_plate_that_turns_is_that_of_its_strips) {
  Cloud<2> cloud(1e-3, 64);
  cloud.motion[0][2] = 3;
  auto effect = drag<2>(2);
  Wrench<2> impulse;
  cloud.predict(effect, impulse);
  const double exact = -2 * 1000 * 9 * std::pow(0.8, 4) / 4 * cloud.kick;
  EXPECT_NEAR(impulse[2], exact, 5e-3 * std::abs(exact));
  EXPECT_LT(impulse.head<2>().norm(), 1e-9 * std::abs(exact));
}

// Impulsively started circle, Re = 3000: drag (Koumoutsakos, Leonard, J. Fluid Mech. 296, 1995, digitised) less its friction and what
// that makes of the pressure, 4 (2 pi / (Re T))^(1/2) (boundary-layer theory); T = U t / R.
TEST(FormDrag, of_a_round_hull_grows_like_that_of_a_started_circle) {
  constexpr double measured[][2] = {{0.6081, 0.3075}, {1.1851, 0.4532}, {1.7125, 0.7702},
                                    {2.1903, 1.0555}, {2.8542, 1.1601}, {3.2637, 1.2995},
                                    {3.6794, 1.4231}, {4.3061, 1.3122}, {5.1189, 1.1791}};
  Cloud<2> cloud;
  const double speed = 2, breadth = 1.6 * std::sqrt(4 / pi);
  cloud.motion[0][0] = speed;
  auto effect = drag<2>(1.2, 1.8);
  double way = 0;
  for (const auto& [T, total] : measured) {
    cloud.kick = (T / 2 * breadth - way) / speed;
    way += speed * cloud.kick;
    Wrench<2> impulse;
    cloud.predict(effect, impulse);
    cloud.commit(effect);
    cloud.kick = 1e-9;
    cloud.predict(effect, impulse);
    const double found = -impulse[0] / cloud.kick / (500 * 1.6 * speed * speed);
    EXPECT_NEAR(found, total - 4 * std::sqrt(2 * pi / (3000 * T)), 0.16) << T;
  }
}

TEST(FormDrag, of_a_round_hull_begins_anew_where_the_motion_turns) {
  Cloud<2> cloud;
  auto effect = drag<2>(1.2, 1.8);
  const auto force = [&](double velocity, double way) {
    cloud.motion[0][0] = velocity;
    cloud.kick = way;
    Wrench<2> impulse;
    cloud.predict(effect, impulse);
    cloud.commit(effect);
    cloud.kick = 1e-9;
    cloud.predict(effect, impulse);
    return -impulse[0] / cloud.kick;
  };
  EXPECT_NEAR(force(1, 10), 1.2 * 500 * 1.6, 1e-6);
  EXPECT_EQ(force(-1, 1e-6), 0);
  EXPECT_NEAR(force(-1, 10), -1.2 * 500 * 1.6, 1e-6);
}

// Strips have ways of their own: those at the ends of a hull that turns separate first.
TEST(FormDrag, of_a_round_hull_that_turns_grows_from_its_ends) {
  Cloud<2> cloud;
  cloud.motion[0][2] = 3;
  auto effect = drag<2>(2, 1.8), at_once = drag<2>(2, 0);
  const auto moment_after = [&](FormDrag<2>& of, double angle) {
    cloud.kick = angle / cloud.motion[0][2];
    Wrench<2> impulse;
    cloud.predict(of, impulse);
    cloud.commit(of);
    cloud.kick = 1e-9;
    cloud.predict(of, impulse);
    return impulse[2] / cloud.kick;
  };
  const double all = moment_after(at_once, 1), half = moment_after(effect, 2);
  EXPECT_LT(half / all, 0.9);
  EXPECT_GT(half / all, 0.1);
  EXPECT_NEAR(moment_after(effect, 20), all, 1e-3 * std::abs(all));
  cloud.motion[0][2] = -3;
  EXPECT_EQ(moment_after(effect, -1e-9), 0) << "it begins anew where it turns back";
}

TEST(FormDrag, remembers_what_it_is_given_back) {
  Cloud<2> cloud;
  cloud.motion[0][0] = 1;
  auto effect = drag<2>(1.2, 1.8), other = drag<2>(1.2, 1.8);
  cloud.kick = 1;
  Wrench<2> impulse, again;
  cloud.predict(effect, impulse);
  EXPECT_EQ(effect.memory()[0], 0);  // nothing is remembered of what is not taken
  cloud.commit(effect);
  ASSERT_EQ(effect.memory().size(), other.memory().size());
  std::copy(effect.memory().begin(), effect.memory().end(), other.memory().begin());
  cloud.predict(effect, impulse);
  cloud.predict(other, again);
  EXPECT_NE(impulse[0], 0);
  EXPECT_EQ(impulse, again);
}

}  // namespace
}  // namespace splashdown::fluid::form_drag_test
