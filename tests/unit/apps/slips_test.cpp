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
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::slips_test {
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

struct Count {
  int tried = 0, caught = 0;
};

Count slips_of(const char* name) {
  const auto file = std::filesystem::path(SPLASHDOWN_EXAMPLES) / name;
  const auto table = toml::parse_file(file.string());
  const auto scene = read_scene(file).scene;
  std::vector<Key> keys;
  find_keys(table, "", keys);
  Count count;
  std::string missed;
  for (const auto& key : keys)
    for (const double factor : factors) {
      if (!changes_the_physics(key, factor, scene)) continue;
      ++count.tried;
      if (is_caught(file, fmt::format("{}={}", key.path, multiplied(*key.node, factor))))
        ++count.caught;
      else
        missed += fmt::format(", {} x {:g}", key.path, factor);
    }
  fmt::print("{}: {} of {} caught; not{}\n", name, count.caught, count.tried, missed);
  return count;
}

// Left out are values that fit all others: an end 3.6 times later, a mass of some other body, a start at another height.
TEST(SlipsOfExamples, are_caught_in_four_of_five_that_change_the_physics) {
  Count all;
  for (const char* name : ten) {
    const auto count = slips_of(name);
    EXPECT_GT(count.tried, 30) << name;
    all.tried += count.tried;
    all.caught += count.caught;
  }
  fmt::print("{} of {} slips caught, {:.1f} %\n", all.caught, all.tried, 100. * all.caught / all.tried);
  EXPECT_GE(all.caught, 0.8 * all.tried);
}

/// One slip each in a wedge that drops on water, and how the question about it begins.
struct AskedSlip {
  const char *slip, *question;
};
TEST(Slip, of_each_kind_is_asked_about) {
  for (const auto& [slip, question] :
       {AskedSlip{"gravity.acceleration=[9.81, 0]",
                  "gravity.acceleration pulls along the horizontal (9.81 m/s^2): up is y"},
        AskedSlip{"gravity.acceleration=[0, -9810]", "gravity.acceleration = 9810 m/s^2: more than on any planet"},
        AskedSlip{"gravity.acceleration=[0, 0]", "gravity.acceleration is zero"},
        AskedSlip{"body.0.inertia=5e6", "body.wedge.inertia is 1"},
        AskedSlip{"body.0.inertia=0.01", "body.wedge.inertia is 0.0"},
        AskedSlip{"body.0.centre_of_mass=[0, 70]", "body.wedge.centre_of_mass = (0, 70) m lies outside the hull"},
        AskedSlip{"body.0.velocity=[0, -61.5]", "body.wedge.velocity: 61.5 m/s downward is a fall from 193 m"},
        AskedSlip{"body.0.velocity=[0, -6150]", "body.wedge.velocity: 6150 m/s downward"},
        AskedSlip{"body.0.position=[0, -0.2]", "body.wedge starts all under water with 6.15 m/s downward"},
        AskedSlip{"body.0.position=[0, -0.1]", "body.wedge starts by"},
        AskedSlip{"time.end=1e-4", "time.end = 0.0001 s: body.wedge is"},
        AskedSlip{"body.0.size=0.3", "body.wedge.size = 0.3 m: elements larger than the hull is thick"},
        AskedSlip{"body.0.shape.deadrise_deg=0.5", "body.wedge.shape.deadrise_deg = 0.5: as good as flat"},
        AskedSlip{"tank.min=[-2, -1.5]", "fluid.region[0] begins 0.5 m above the tank's floor"},
        AskedSlip{"tank.max=[2.5, 1]", "fluid.region[0] ends 0.5 m before the tank's wall along x"},
        AskedSlip{"fluid.region.0.max=[2.5, 0]", "fluid.region[0] reaches 0.5 m beyond the tank along x"},
        AskedSlip{"fluid.density=5000", "fluid.density = 5000: between the heaviest solutions"},
        AskedSlip{"fluid.viscosity={dynamic = 1e-6}", "fluid.viscosity.dynamic = 1e-06 Pa s: water of this density"},
        AskedSlip{"fluid.absorber={width = 1.0, rate = 8000.0}", "fluid.absorber.rate = 8000 1/s"},
        AskedSlip{"fluid.absorber={width = 1e-3, rate = 8.0}", "fluid.absorber.width = 0.001 m"},
        AskedSlip{"contact={friction = 3e-4}", "contact.friction = 0.0003: as good as none"},
        AskedSlip{"record=[{kind = \"acceleration\", name = \"seat\", body = \"wedge\", point = [50, 0]}]",
                  "record seat: point = (50, 0) m lies 49.8 m outside the hull of 'wedge'"}}) {
    const auto scene = read_scene_text(testing::wedge_drop, "scene.toml", std::vector<std::string>{slip}).scene;
    const auto list = questions<2>(scene, predicted_cost<2>(scene));
    EXPECT_TRUE(std::ranges::any_of(list, [&, q = question](const std::string& text) { return text.starts_with(q); }))
        << slip << ": " << ::testing::PrintToString(list);
  }
}

}  // namespace
}  // namespace splashdown::apps::slips_test
