// [symmetry]: what is read, what is refused because its mirror image is another, how surfaces are cut.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "apps/build/build.hpp"
#include "apps/effects/symmetry/symmetry.hpp"
#include "apps/scene/mirror.hpp"
#include "rigid/shapes/solids.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::mirrored_scene_test {
namespace {

const std::string half_wedge = testing::replaced(testing::wedge_drop, "[output]", "[symmetry]\n[output]");

const std::string half_capsule = R"(dimension = 3
[time]
end = 0.1
[gravity]
[symmetry]
[tank]
min = [-3, -3, -2]
max = [3, 3, 1]
[fluid]
density = 1000
[[fluid.region]]
shape = "box"
min = [-3, -3, -2]
max = [3, 3, 0]
[[body]]
name = "capsule"
shape = {type = "capsule", radius = 0.2, length = 0.6}
density = 300
position = [0, 0, 0.5]
velocity = [4, 0, -3]
pitch_deg = 10
)";

struct Broken {
  const char* name;
  std::vector<std::string> set;
  const char* says;
  const char* cure;
};
void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

class BrokenMirror : public ::testing::TestWithParam<std::pair<const std::string*, Broken>> {};

TEST_P(BrokenMirror, is_told_with_key_distance_and_cure) {
  const auto& [scene, broken] = GetParam();
  EXPECT_TRUE(testing::messages_of(*scene).empty()) << ::testing::PrintToString(testing::messages_of(*scene));
  const auto messages = testing::messages_of(*scene, broken.set);
  ASSERT_EQ(messages.size(), 1u) << ::testing::PrintToString(messages);
  EXPECT_NE(messages[0].find(broken.says), std::string::npos) << messages[0];
  EXPECT_NE(messages[0].find(broken.cure), std::string::npos) << messages[0];
}

std::vector<std::pair<const std::string*, Broken>> of(const std::string& scene, const std::vector<Broken>& all) {
  std::vector<std::pair<const std::string*, Broken>> pairs;
  for (const auto& broken : all) pairs.emplace_back(&scene, broken);
  return pairs;
}
std::string name_of(const ::testing::TestParamInfo<std::pair<const std::string*, Broken>>& info) {
  return info.param.second.name;
}

INSTANTIATE_TEST_SUITE_P(
    InThePlane, BrokenMirror,
    ::testing::ValuesIn(
        of(half_wedge,
           {{"tank", {"tank.max.0=3"}, "reaches from -2 to 3 m along x", "Use -3 and 3 m, or symmetry.at = 0.5."},
            {"liquid", {"fluid.region.0.max.0=1"}, "1 m off its boundary", "Make the liquid symmetric"},
            {"current", {"fluid.region.0.velocity=[1.0, 0.0]"}, "flows across the plane at 1 m/s", "Use 0 along x"},
            {"gradient",
             {"fluid.region.0.velocity_gradient=[[0.0, 1.0], [0.0, 0.0]]"},
             "velocity is not its own mirror image",
             "Leave out the entries"},
            {"gravity",
             {"gravity.acceleration=[1.0, -9.81]"},
             "[gravity] has a component of 1 m/s^2",
             "remove [symmetry]"},
            {"place", {"body.wedge.position.0=0.1"}, "0.2 m off the hull", "middle lies 0.1 m off the plane: move"},
            {"heel", {"body.wedge.pitch_deg=5"}, "m off the hull", "Turn the body"},
            {"velocity", {"body.wedge.velocity.0=1"}, "moves across the plane at 1 m/s", "Use 0 along x"},
            {"spin", {"body.wedge.spin_deg=3"}, "turns at 3 deg/s", "Use 0"},
            {"centre", {"body.wedge.centre_of_mass=[0.05, 0.1]"}, "lies 0.05 m off the plane", "Put it into the plane"},
            {"freedom", {"body.wedge.free=[\"y\", \"rotation\"]"}, "lets nothing move in 'rotation'", "Take it out"},
            {"axis", {"symmetry.normal=y"}, "symmetry.normal = \"y\"", "'x'"}})),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    InSpace, BrokenMirror,
    ::testing::ValuesIn(
        of(half_capsule,
           {{"roll_and_yaw", {"body.capsule.heading_deg=20"}, "m off the hull", "Turn the body"},
            {"pitch_across_x", {"symmetry.normal=x"}, "m off the hull", "Turn the body"},
            {"spin", {"body.capsule.spin_deg=[5, 20, 0]"}, "turns at 5 deg/s", "Only a turn about y is symmetric"},
            {"inertia",
             {"body.capsule.inertia=[[10.0, 1.0, 0.0], [1.0, 12.0, 0.0], [0.0, 0.0, 12.0]]"},
             "product of inertia across the plane",
             "Set those with y to 0"},
            {"upright", {"symmetry.normal=z"}, "symmetry.normal = \"z\"", "'y'"}})),
    name_of);

const std::string mooring = R"([[line]]
name = "port"
body = "capsule"
point = [0.1, 0.1, 0]
anchor = [1, 2, 0.5]
length = 1
axial_stiffness = 1e4
)";
std::string starboard() {
  return testing::replaced(testing::replaced(mooring, "0.1, 0.1", "0.1, -0.1"), "1, 2,", "1, -2,");
}
std::string with_lines(const std::string& lines) {
  return half_capsule + testing::replaced(lines, "\"port\"", "\"first\"");
}

TEST(MirroredScene, has_lines_in_its_plane_and_in_pairs) {
  const auto second = testing::replaced(starboard(), "\"port\"", "\"second\"");
  const auto middle = testing::replaced(testing::replaced(mooring, "0.1, 0.1", "0.1, 0"), "1, 2,", "1, 0,");
  EXPECT_TRUE(testing::messages_of(with_lines(mooring) + second).empty());
  EXPECT_TRUE(testing::messages_of(with_lines(middle)).empty());
  for (const auto& alone : {mooring, starboard(), mooring + testing::replaced(second, "length = 1", "length = 1.1")}) {
    const auto messages = testing::messages_of(with_lines(alone));
    ASSERT_EQ(messages.size(), 1u) << alone;
    EXPECT_NE(messages[0].find("has no mirror image"), std::string::npos) << messages[0];
  }
}

// A hull that was meshed at random is 6 mm off its mirror image: elements of 60 mm do not feel it, those of 20 mm do.
TEST(MirroredScene, takes_hulls_as_symmetric_as_their_elements) {
  const auto messages = [](double size, double heading) {
    const auto hull =
        fmt::format("shape = {{type = \"surface\", file = \"{}/uav_landing/uav.stl\"}}", SPLASHDOWN_EXAMPLES);
    const auto scene = testing::replaced(half_capsule, "shape = {type = \"capsule\", radius = 0.2, length = 0.6}",
                                         fmt::format("{}\nsize = {}\nheading_deg = {}", hull, size, heading));
    return testing::messages_of(scene);
  };
  EXPECT_TRUE(messages(0.06, 0).empty()) << messages(0.06, 0)[0];
  for (const auto& told : {messages(0.02, 0), messages(0.06, 5)}) {
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("m off the hull"), std::string::npos) << told[0];
  }
}

TEST(MirroredScene, keeps_what_is_told_and_halves_what_is_simulated) {
  const auto scene = read_scene_text(half_capsule, "scene.toml", {}).scene;
  const auto whole = body_spec<3>(scene.bodies[0]);
  const auto bodies = bodies_of<3>(scene);
  EXPECT_DOUBLE_EQ(bodies->spec(0).mass, 0.5 * whole.mass);
  EXPECT_TRUE(bodies->spec(0).inertia.isApprox(0.5 * whole.inertia));
  EXPECT_EQ(bodies->spec(0).free, (std::array<bool, 6>{true, false, true, false, true, false}));
  const auto spec = fluid_spec<3>(scene);
  ASSERT_EQ(spec.walls.size(), 2u);
  EXPECT_EQ(spec.walls[1].surface.vertices.row(1).minCoeff(), 0);
  for (const auto& wall : spec.walls) EXPECT_TRUE(wall.mirror.has_value());
}

template <int d>
double enclosed(const rigid::Surface<d>& surface) {
  double sum = 0;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    Eigen::Matrix<double, d, d> corners;
    for (int k = 0; k < d; ++k) corners.col(k) = surface.vertices.col(surface.facets(k, f));
    sum += corners.determinant();
  }
  return sum / (d == 2 ? 2 : 6);
}

// Cut anywhere, in any attitude: what is before the plane, closed by its image, holds as much on both sides.
TEST(MirroredScene, a_surface_joined_to_its_image_is_closed_and_symmetric) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const auto solid = i % 3 == 0   ? rigid::box({1 + 0.5 * any(random), 1, 0.7}).surface
                       : i % 3 == 1 ? rigid::sphere(0.8).surface
                                    : rigid::cone(0.6, 0.9).surface;
    const ShapeMirror<3> mirror{rigid::Vec<3>(any(random), any(random), any(random)).normalized(), 0.3 * any(random)};
    const auto joined = symmetrised<3>(mirror, solid);
    std::map<std::pair<int, int>, int> edges;
    for (Eigen::Index f = 0; f < joined.facets.cols(); ++f)
      for (int k = 0; k < 3; ++k) ++edges[{joined.facets(k, f), joined.facets((k + 1) % 3, f)}];
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1) << i;
      EXPECT_EQ((edges.count({edge.second, edge.first})), 1u) << i << ": open";
    }
    const auto other = symmetrised<3>({-mirror.normal, -mirror.offset}, solid);
    EXPECT_NEAR(enclosed<3>(joined) + enclosed<3>(other), 2 * enclosed<3>(solid), 1e-12 * enclosed<3>(solid)) << i;
  }
}

TEST(MirroredScene, a_symmetric_surface_is_only_cut) {
  const auto sphere = rigid::sphere(1).surface;
  const auto joined = symmetrised<3>({rigid::Vec<3>::UnitY(), 0}, sphere);
  EXPECT_NEAR(enclosed<3>(joined), enclosed<3>(sphere), 1e-13);
  EXPECT_LT(asymmetry_of<3>(Mirror{1, 0}, joined).distance, 1e-14);
}

}  // namespace
}  // namespace splashdown::apps::mirrored_scene_test
