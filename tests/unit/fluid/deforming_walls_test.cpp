// Walls that deform, against what they must do: where their vertices move as a rigid body's points do, they are that body.
#include <gtest/gtest.h>

#include <random>

#include "fluid/effects/viscosity/viscosity.hpp"
#include "fluid/pfem/fluid.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::deforming_walls_test {
namespace {

constexpr double size = 0.1, dt = 5e-3;
const Vec<2> at(0.1, -0.1);  // of the box's frame, in the world

/// A box of many facets, half under water; rigid, or with vertices that deform.
FluidSpec<2> box_afloat(bool deforms) {
  auto spec = scenes::still_water(3, 1, size);
  Surface<2> surface = scenes::rectangle({-0.35, -0.25}, {0.35, 0.25});
  Surface<2> fine;
  constexpr int each = 6;
  const auto corners = surface.vertices.cols();
  fine.vertices.resize(2, each * corners);
  fine.facets.resize(2, each * corners);
  for (Eigen::Index k = 0; k < fine.vertices.cols(); ++k) {
    const double share = static_cast<double>(k % each) / each;
    const int from = surface.facets(0, k / each), to = surface.facets(1, k / each);
    fine.vertices.col(k) = (1 - share) * surface.vertices.col(from) + share * surface.vertices.col(to);
    fine.facets.col(k) << static_cast<int>(k), static_cast<int>((k + 1) % fine.vertices.cols());
  }
  Isometry<2> pose = Isometry<2>::Identity();
  pose.translation() = at;
  if (deforms) fine.vertices.colwise() += at;
  auto box = scenes::wall("box", fine, size);
  box.deforms = deforms;
  if (!deforms) box.pose = pose;
  spec.walls.insert(spec.walls.begin(), box);
  return spec;
}

/// Velocities of the vertices of a surface that moves with a twist about a point.
AtVertices<2> moving(const AtVertices<2>& vertices, const Twist<2>& s, const Vec<2>& about) {
  AtVertices<2> v(2, vertices.cols());
  for (Eigen::Index k = 0; k < v.cols(); ++k) v.col(k) = rigid_velocity<2>(s, Vec<2>(vertices.col(k) - about));
  return v;
}

/// The columns of vertices' velocities that are rigid motions about a point.
Eigen::MatrixXd rigid_motions(const AtVertices<2>& vertices, const Vec<2>& about) {
  Eigen::MatrixXd Z(vertices.size(), 3);
  for (int k = 0; k < 3; ++k) Z.col(k) = moving(vertices, Twist<2>::Unit(k), about).reshaped();
  return Z;
}

class DeformingWall : public testing::TestWithParam<bool> {};  // with viscosity, and walls that water sticks to
INSTANTIATE_TEST_SUITE_P(Water, DeformingWall, testing::Bool());

TEST_P(DeformingWall, is_a_rigid_body_where_its_vertices_move_as_one) {
  const auto fluid = [&](bool deforms) {
    auto spec = box_afloat(deforms);
    spec.walls[0].sticks = GetParam();
    auto effects = scenes::gravity({0, -9.81});
    if (GetParam()) effects.push_back(std::make_unique<Viscosity<2>>(20.0));
    return std::make_unique<Fluid<2>>(std::move(spec), std::move(effects));
  };
  const auto rigid = fluid(false), soft = fluid(true);
  const Twist<2> s(0.3, -0.4, 0.5);
  for (int step = 0; step < 4; ++step) {
    const double kick = step == 0 ? dt / 2 : dt;
    const Vec<2> about = rigid->wall_places()[0].translation();
    ASSERT_TRUE(rigid->begin(kick, dt, {}).ok());
    ASSERT_TRUE(soft->begin(kick, dt, {}).ok());
    // Over the step the pose turns about its moving centre; vertices that go there on straight ways have the mean velocity.
    const Isometry<2> next = moved<2>(rigid->wall_places()[0].pose(), s, dt);
    const AtVertices<2> from = *soft->wall_vertices(0);
    AtVertices<2> to(2, from.cols());
    for (Eigen::Index k = 0; k < from.cols(); ++k)
      to.col(k) = next * (rigid->wall_places()[0].inverse() * Vec<2>(from.col(k)));
    ASSERT_TRUE(rigid->solve(std::vector<WallVelocity<2>>{s, {}}).status.ok());
    ASSERT_TRUE(
        soft->solve(std::vector<WallVelocity<2>>{WallVelocity<2>::at_vertices((to - from) / dt), {}}).status.ok());
    // The mean differs from the twist's velocity by (w dt)^2 / 24 of w x r, and by half of w dt across it, which is no flux
    // through the surface to first order: 1e-3 of the speed here.
    const Wrench<2> of_rigid = rigid->loads()[0].total();
    const AtVertices<2>& on = soft->result().at_vertices[0];
    Wrench<2> of_soft = Wrench<2>::Zero();
    for (Eigen::Index k = 0; k < on.cols(); ++k)
      of_soft += wrench_of<2>(Vec<2>(from.col(k) - about), Vec<2>(on.col(k)));
    EXPECT_LE((of_soft - of_rigid).norm(), 5e-3 * of_rigid.norm()) << step;
    Wrench<2> about_origin = Wrench<2>::Zero();
    for (Eigen::Index k = 0; k < on.cols(); ++k) about_origin += wrench_of<2>(Vec<2>(from.col(k)), Vec<2>(on.col(k)));
    EXPECT_LE((about_origin - soft->loads()[0].total()).norm(), 1e-9 * of_rigid.norm());
    EXPECT_NEAR(soft->result().power_on_walls, rigid->result().power_on_walls, 5e-3 * of_rigid.norm() * s.norm());
    rigid->commit(std::vector<WallPlace<2>>{next, rigid->wall_places()[1]});
    Eigen::VectorXd placement = to.reshaped();
    soft->commit(soft->places_of(placement));
    EXPECT_EQ(*soft->wall_vertices(0), to);
  }
  EXPECT_EQ(rigid->nodes().size(), soft->nodes().size());
}

TEST(DeformingWalls, have_the_added_mass_of_a_rigid_body_in_its_motions) {
  Fluid<2> rigid(box_afloat(false), scenes::gravity({0, -9.81})), soft(box_afloat(true), scenes::gravity({0, -9.81}));
  ASSERT_TRUE(rigid.begin(dt, dt, {}).ok());
  ASSERT_TRUE(soft.begin(dt, dt, {}).ok());
  const std::size_t box = 0;
  const Eigen::MatrixXd Z = rigid_motions(*soft.wall_vertices(0), at);
  const Eigen::MatrixXd one = rigid.interface_slope({&box, 1}), each = soft.interface_slope({&box, 1});
  EXPECT_LE((Z.transpose() * each * Z - one).norm(), 1e-9 * one.norm());
  EXPECT_LE((each - each.transpose()).norm(), 1e-9 * each.norm());
  EXPECT_LE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(each).eigenvalues().maxCoeff(), 1e-9 * each.norm());
  // With the corrections of a step, which end where a thousandth is left of what they correct, and are not linear until then.
  const Eigen::MatrixXd G = rigid.added_mass({&box, 1}), all = soft.added_mass({&box, 1});
  EXPECT_LE((Z.transpose() * all * Z - G).norm(), 1e-3 * G.norm());
}

// The exact term: modes of the vertices that are the rigid motions, with the body's inertia.
TEST(DeformingWalls, answer_the_pressure_in_one_solve_as_the_rigid_body_does) {
  Fluid<2> rigid(box_afloat(false), scenes::gravity({0, -9.81})), soft(box_afloat(true), scenes::gravity({0, -9.81}));
  const Eigen::MatrixXd M = Eigen::Vector3d(3, 3, 0.2).asDiagonal();  // a hundredth of the water in its place
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(rigid.layout().size(), 3);
  modes.topRows<3>().setIdentity();
  ASSERT_TRUE(rigid.begin(dt / 2, dt, {.modal = {modes, M}}).ok());
  Eigen::MatrixXd of_vertices = Eigen::MatrixXd::Zero(soft.layout().size(), 3);
  const Eigen::MatrixXd Z = rigid_motions(soft.wall_vertices(0) ? *soft.wall_vertices(0) : AtVertices<2>(), at);
  of_vertices.topRows(Z.rows()) = Z;
  ASSERT_TRUE(soft.begin(dt / 2, dt, {.modal = {of_vertices, M}}).ok());
  ASSERT_TRUE(rigid.solve(std::vector<WallVelocity<2>>(2)).status.ok());
  ASSERT_TRUE(soft.solve(std::vector<WallVelocity<2>>(2)).status.ok());
  const Twist<2> s = rigid.result().wall_velocities[0].rigid;
  const AtVertices<2>& v = soft.result().wall_velocities[0].vertices;
  const AtVertices<2> expected = moving(*soft.wall_vertices(0), s, at);
  EXPECT_GT(s.norm(), 0.01) << "it is pushed up";
  EXPECT_LE((v - expected).norm(), 2e-3 * expected.norm());
  // Newton's law of the modes, by the impulses on the vertices.
  const Eigen::VectorXd impulse = Z.transpose() * (dt / 2 * soft.result().at_vertices[0]).reshaped();
  const Eigen::VectorXd y = Z.colPivHouseholderQr().solve(v.reshaped());
  EXPECT_LE((impulse - M * y).norm(), 1e-9 * impulse.norm());
}

TEST(DeformingWalls, go_on_with_the_same_bits_from_a_checkpoint) {
  Fluid<2> first(box_afloat(true), scenes::gravity({0, -9.81})), second(box_afloat(true), scenes::gravity({0, -9.81}));
  const auto step = [](Fluid<2>& fluid, double share) {
    const AtVertices<2> x = *fluid.wall_vertices(0);
    const AtVertices<2> v = share * moving(x, {0, 0.2, 1}, at);
    EXPECT_TRUE(fluid.begin(dt, dt, {}).ok());
    EXPECT_TRUE(fluid.solve(std::vector<WallVelocity<2>>{WallVelocity<2>::at_vertices(v), {}}).status.ok());
    fluid.commit(fluid.places_of((x + dt * v).reshaped()));
  };
  step(first, 1);
  std::stringstream file;
  first.save(file);
  second.load(file);
  step(first, 0.5), step(second, 0.5);
  EXPECT_EQ(first.nodes().x, second.nodes().x);
  EXPECT_EQ(*first.wall_vertices(0), *second.wall_vertices(0));
}

/// A box of water whose floor rises in the middle: what the wall sweeps goes up, to the order of the mesh.
TEST(DeformingWalls, displace_what_they_sweep) {
  Fluid<2> water(box_afloat(true), scenes::gravity({0, -9.81}));
  const double before = water.ledger().volume;
  for (int step = 0; step < 10; ++step) {
    const AtVertices<2> x = *water.wall_vertices(0);
    AtVertices<2> v = AtVertices<2>::Zero(2, x.cols());  // it swells
    for (Eigen::Index k = 0; k < v.cols(); ++k) v.col(k) = 0.3 * (x.col(k) - at);
    ASSERT_TRUE(water.begin(step == 0 ? dt / 2 : dt, dt, {}).ok());
    ASSERT_TRUE(water.solve(std::vector<WallVelocity<2>>{WallVelocity<2>::at_vertices(v), {}}).status.ok());
    ASSERT_TRUE(water.acceptable().ok());
    water.commit(water.places_of((x + dt * v).reshaped()));
  }
  EXPECT_NEAR(water.ledger().volume, before, 1e-4 * before);
  double highest = -1;
  for (const auto& x : water.nodes().x) highest = std::max(highest, x.y());
  EXPECT_GT(highest, 0);
}

}  // namespace
}  // namespace splashdown::fluid::deforming_walls_test
