// Slips of a thousand, of km/h, of inches and of a sign in every number of ten examples: how many are caught.
//
// Caught: the scene is refused, or something is asked about it (of the examples themselves nothing is). Counted are keys that
// change the physics: what equations, geometry and initial state are made of. Not counted are
//   - what is looked at and how long it is kept: [output], [[record]];
//   - how it is computed: [coupling], fluid.size, time.cfl, time.dt_max, the element sizes of bodies and tank;
//   - a key that stays what it is: zeros, and sizes of a list of them;
//   - mirror images: the sign of an angle, or of a list whose vertical entry is zero, of the only body of a scene without joints.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <algorithm>
#include <functional>

#include "apps/check/questions.hpp"
#include "apps/scene/read/read.hpp"

namespace splashdown::apps {
namespace {

constexpr const char* ten[] = {"wedge_drop/scene.toml",      "capsule_drop_2d/scene.toml",
                               "floating_box/scene.toml",    "sloshing/scene.toml",
                               "hinged_plate/scene.toml",    "two_boxes/scene.toml",
                               "uav_landing/scene.toml",     "sphere_heave/scene.toml",
                               "float_stability/scene.toml", "capsule_water_landing/scene_attitude.toml"};
constexpr double factors[] = {1e3, 1e-3, 3.6, 25.4, -1};

/// A key with numbers, as --set calls it.
struct Key {
  std::string path;
  const toml::node* node;
};

bool is_numeric(const toml::node& node) {
  if (node.is_number()) return true;
  const auto* list = node.as_array();
  return list && !list->empty() && std::ranges::all_of(*list, is_numeric);
}

void find_keys(const toml::table& table, const std::string& path, std::vector<Key>& keys) {
  for (const auto& [name, node] : table) {
    const auto here = path.empty() ? std::string(name.str()) : fmt::format("{}.{}", path, name.str());
    if (is_numeric(node)) keys.push_back({here, &node});
    if (const auto* inner = node.as_table()) find_keys(*inner, here, keys);
    if (const auto* list = node.as_array(); list && list->is_array_of_tables())
      for (std::size_t i = 0; i < list->size(); ++i)
        find_keys(*list->get(i)->as_table(), fmt::format("{}.{}", here, i), keys);
  }
}

std::string multiplied(const toml::node& node, double factor) {
  if (const auto value = node.value<double>()) return fmt::format("{:#}", *value == 0 ? 0 : *value * factor);
  std::string text;
  for (const auto& entry : *node.as_array()) text += (text.empty() ? "" : ", ") + multiplied(entry, factor);
  return "[" + text + "]";
}

bool changes_the_physics(const Key& key, double factor, const Scene& scene) {
  const auto& path = key.path;
  for (const char* part : {"output.", "record.", "coupling.", "fluid.size.", "time.cfl", "time.dt_max", "tank.size"})
    if (path.starts_with(part)) return false;
  if (path == "dimension" || (path.starts_with("body.") && path.ends_with(".size") && !path.ends_with("shape.size")))
    return false;
  if (multiplied(*key.node, 2) == multiplied(*key.node, 1)) return false;
  const bool alone = scene.bodies.size() == 1 && scene.joints.empty() && path.starts_with("body.");
  if (factor > 0 || !alone) return true;
  const bool is_angle = path.ends_with("pitch_deg") || path.ends_with("heading_deg") || path.ends_with("roll_deg");
  const auto* list = key.node->as_array();
  const bool is_level = list && list->back().value<double>() == 0.;
  return !is_angle && !(is_level && !path.ends_with("shape.profile"));
}

bool asks(const Scene& scene, const Cost& cost) {
  return !(scene.dimension == 2 ? questions<2>(scene, cost) : questions<3>(scene, cost)).empty();
}

bool is_caught(const std::filesystem::path& file, const std::string& slip) {
  try {
    const auto scene = read_scene(file, std::vector{slip}).scene;
    if (asks(scene, {})) return true;  // most, without the price of the run
    const auto cost = scene.dimension == 2 ? predicted_cost<2>(scene) : predicted_cost<3>(scene);
    return too_large(cost) || asks(scene, cost);
  } catch (const SceneError&) {
    return true;
  } catch (const std::invalid_argument&) {
    return true;
  }
}

class SlipsOfExamples : public ::testing::TestWithParam<const char*> {};

struct Count {
  int tried = 0, caught = 0;
};
Count of_physics, of_all;

TEST_P(SlipsOfExamples, are_mostly_caught) {
  const auto file = std::filesystem::path(SPLASHDOWN_EXAMPLES) / GetParam();
  const auto table = toml::parse_file(file.string());
  const auto scene = read_scene(file).scene;
  std::vector<Key> keys;
  find_keys(table, "", keys);
  Count physics;
  for (const auto& key : keys)
    for (const double factor : factors) {
      if (!changes_the_physics(key, factor, scene)) continue;
      const auto slip = fmt::format("{}={}", key.path, multiplied(*key.node, factor));
      ++physics.tried;
      if (is_caught(file, slip))
        ++physics.caught;
      else
        fmt::print("not caught  {} times {:g}: {}\n", key.path, factor, slip.substr(0, 80));
    }
  fmt::print("{}: {} of {} slips caught\n", GetParam(), physics.caught, physics.tried);
  of_physics.tried += physics.tried, of_physics.caught += physics.caught;
  EXPECT_GT(physics.tried, 30);
}
INSTANTIATE_TEST_SUITE_P(Ten, SlipsOfExamples, ::testing::ValuesIn(ten));

}  // namespace
}  // namespace splashdown::apps
