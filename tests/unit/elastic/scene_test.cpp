// [body.elastic]: what is read, built, stepped, refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "apps/build/build.hpp"
#include "apps/effects/elastic/elastic.hpp"
#include "apps/effects/elastic/solid.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/scales.hpp"
#include "elastic/participant.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::scene_test {
namespace {

using testing::Mistake;

/// A rubber beam that is held at its left end and loaded at the other.
const std::string beam = R"(title = "beam"
[time]
end = 0.1
dt_max = 0.01
[gravity]
acceleration = [0, -9.81]
[[body]]
name = "beam"
density = 1200
position = [1, 2]
shape = { type = "box", width = 1, height = 0.1 }
[body.elastic]
young_modulus = 1e7
poisson_ratio = 0.3
size = 0.1
clamp = [{min = [-0.5, -0.05], max = [-0.5, 0.05]}]
point = [{name = "tip", point = [0.5, 0]}]
point_mass = [{mass = 2, point = [0.4, 0]}]
modes = 2
[[body.force]]
axes = "world"
force = [0, 30]
point = [0.5, 0]
)";

Scene scene_of(const std::string& text) { return read_scene_text(text, "scene.toml").scene; }
std::string with(const std::string& from, const std::string& to) { return testing::replaced(beam, from, to); }

TEST(ElasticScene, is_read_with_its_defaults) {
  const auto scene = scene_of(beam);
  const auto& table = scene.effects.find<ElasticTables>()->of_bodies.at(0);
  EXPECT_EQ(table.law, "st_venant_kirchhoff");
  EXPECT_EQ(table.scheme, "generalised_alpha");
  EXPECT_EQ(table.spectral_radius, 0.9);
  EXPECT_EQ(table.clamps.size(), 1u);
  EXPECT_EQ(table.points.at(0).name, "tip");
  EXPECT_EQ(table.point_masses.at(0).mass, 2);
  EXPECT_EQ(table.modes, 2);
}

/// The beam in equilibrium with its weight alone, with goals: forces at points have no finite displacement of their own.
std::string with_goals(const std::string& more) {
  auto text = testing::replaced(beam, "point_mass = [{mass = 2, point = [0.4, 0]}]\n", "");
  text = testing::replaced(text, "[[body.force]]\naxes = \"world\"\nforce = [0, 30]\npoint = [0.5, 0]\n", "");
  return testing::replaced(text, "modes = 2\n", "scheme = \"steady\"\ngoal = [{point = \"tip\"}, {mode = 1}]\n" + more);
}

// Refined meshes tell less, and what they tell is what has changed.
TEST(ElasticScene, tells_goals_with_their_errors_and_refines_its_mesh_for_them) {
  const auto told = [](const std::string& text) {
    auto world = build_world<2>(scene_of(text));
    EXPECT_TRUE(world.stepper->attempt(0.01).ok());
    world.stepper->commit();
    return world.solids->goals();
  };
  const auto coarse = told(with_goals("")), fine = told(with_goals("adapt = 4\n")),
             same = told(with_goals("refine = 2\n"));
  ASSERT_EQ(coarse.size(), 2u);
  EXPECT_EQ(coarse[0].name, "tip.uy");
  EXPECT_EQ(coarse[0].unit, "m");
  EXPECT_EQ(coarse[1].name, "beam.f1");
  EXPECT_EQ(coarse[1].unit, "Hz");
  for (std::size_t k = 0; k < 2; ++k) {
    const double truth = fine[k].value - fine[k].error;
    EXPECT_LT(std::abs(fine[k].error), 0.2 * std::abs(coarse[k].error));
    EXPECT_LT(std::abs(same[k].error), std::abs(coarse[k].error));
    EXPECT_GT(coarse[k].error / (coarse[k].value - truth), 0.7);
    EXPECT_LT(coarse[k].error / (coarse[k].value - truth), 1.5);
  }
}

TEST(ElasticScene, builds_a_world_of_solids_alone_and_none_without_the_table) {
  const auto world = build_world<2>(scene_of(beam));
  ASSERT_NE(world.solids, nullptr);
  EXPECT_EQ(world.bodies, nullptr);
  EXPECT_EQ(world.fluid, nullptr);
  EXPECT_EQ(world.solids->spec(0).name, "beam");
  const double off = 2 * 0.4 / (1200 * 0.1 + 2);  // the point mass at 0.4 m
  EXPECT_LT((world.solids->state(0).pose.translation() - Vec<2>(1 + off, 2)).norm(), 1e-12);
  EXPECT_EQ(build_world<2>(scene_of(testing::wedge_drop)).solids, nullptr);
}

double tip(const World<2>& world) { return world.solids->signals().at(1).second; }

TEST(ElasticScene, comes_to_the_place_that_its_loads_hold) {
  // Euler-Bernoulli in plane strain with its weight, a mass at 0.9 L and a force at L; L/h = 10: shear adds 1 %.
  const auto world = build_world<2>(scene_of(with("modes = 2", "scheme = \"steady\"")));
  ASSERT_TRUE(world.stepper->attempt(0.01).ok());
  world.stepper->commit();
  const double EI = 1e7 / (1 - 0.09) * 1e-3 / 12, g = 9.81;
  const double a = 0.9, own = -1200 * 0.1 * g / (8 * EI), mass = -2 * g * a * a * (3 - a) / (6 * EI),
               force = 30 / (3 * EI);
  EXPECT_NEAR(tip(world) / (own + mass + force), 1, 0.02);
  const auto now = world.solids->deformation(0);
  EXPECT_GT(now.strain_energy, 0);
  EXPECT_EQ(now.at.x() < 0.8, true) << "at the clamp, in the world's frame";
}

TEST(ElasticScene, falls_freely_without_a_clamp) {
  const auto world = build_world<2>(scene_of(
      with("clamp = [{min = [-0.5, -0.05], max = [-0.5, 0.05]}]\n", "")
          .substr(0, with("clamp = [{min = [-0.5, -0.05], max = [-0.5, 0.05]}]\n", "").find("[[body.force]]"))));
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(world.stepper->attempt(0.01).ok());
    world.stepper->commit();
  }
  // With its point mass, whose centre is not that of the beam alone; displacement of all is g t^2/2.
  EXPECT_NEAR(tip(world), -9.81 * 0.01 / 2, 1e-9);
  EXPECT_NEAR(world.solids->velocity_n(0)[1], -0.981, 1e-9);
  EXPECT_LT(world.solids->deformation(0).von_mises, 1e-3) << "nothing strains it";
}

TEST(ElasticScene, of_turek_and_hron_is_where_the_library_has_it) {
  const auto world = build_world<2>(read_scene(SPLASHDOWN_EXAMPLES "/turek_hron_csm/scene.toml").scene);
  ASSERT_TRUE(world.stepper->attempt(0.5).ok());
  world.stepper->commit();
  EXPECT_NEAR(world.solids->signals().at(0).second / -7.187e-3, 1, 0.003);
  EXPECT_NEAR(tip(world) / -66.10e-3, 1, 0.003);
}

TEST(ElasticScene, goes_on_from_a_checkpoint_bit_by_bit) {
  const auto one = build_world<2>(scene_of(beam)), other = build_world<2>(scene_of(beam));
  const auto go = [](const World<2>& world) {
    EXPECT_TRUE(world.stepper->attempt(0.01).ok());
    world.stepper->commit();
  };
  go(one);
  std::stringstream state;
  one.stepper->save(state);
  other.stepper->load(state);
  go(one);
  go(other);
  EXPECT_EQ(tip(one), tip(other));
  std::stringstream cut(state.str().substr(0, state.str().size() / 2));
  EXPECT_THROW(other.stepper->load(cut), std::runtime_error);
}

TEST(ElasticScene, has_rigid_bodies_beside_elastic_ones) {
  const std::string ball =
      "[[body]]\nname = \"ball\"\nmass = 1\nposition = [9, 9]\nshape = {type = \"circle\", radius = 1}\n";
  const auto both = build_world<2>(scene_of(with("[[body]]\nname = \"beam\"", ball + "[[body]]\nname = \"beam\"")));
  const auto alone = build_world<2>(scene_of(beam));
  ASSERT_NE(both.bodies, nullptr);
  ASSERT_NE(both.solids, nullptr);
  for (const auto* world : {&both, &alone})
    for (int k = 0; k < 5; ++k) {
      ASSERT_TRUE(world->stepper->attempt(0.01).ok());
      world->stepper->commit();
    }
  EXPECT_EQ(tip(both), tip(alone)) << "the beam knows nothing of the ball";
  // Leapfrog from rest: half a kick, then whole ones.
  EXPECT_NEAR(both.bodies->state(0).velocity[1], -9.81 * 0.045, 1e-12);
}

TEST(ElasticScene, tells_the_deformed_surface_with_its_stresses) {
  const auto world = build_world<2>(scene_of(with("modes = 2", "scheme = \"steady\"")));
  ASSERT_TRUE(world.stepper->attempt(0.01).ok());
  world.stepper->commit();
  const auto skin = world.solids->deformed(0);
  double lowest = 0, most = 0;
  for (std::size_t k = 0; k < skin.displacement.size(); ++k) {
    lowest = std::min(lowest, skin.displacement[k].y());
    most = std::max(most, skin.von_mises[k]);
  }
  EXPECT_NEAR(lowest / tip(world), 1, 0.01) << "the tip comes lowest";
  // The greatest stress of a beam is at its surface, beside the clamp: the rule's points lie inside, corners are singular.
  EXPECT_NEAR(most / world.solids->deformation(0).von_mises, 1, 0.5);
}

const std::string part_of_all = "modes = 2\npart = [{name = \"all\", min = [-9, -9], max = [9, 9]";

TEST(ElasticScene, has_parts_of_other_materials) {
  const auto text =
      with("modes = 2",
           "modes = 2\npart = [{name = \"tip\", young_modulus = 5e7, density = 2400, min = [0.25, -1], "
           "max = [1, 1]}, {name = \"rod\", law = \"small_strain\", points = [[-0.5, 0], [0, 0], [0, 0.02]]}]");
  const auto scene = scene_of(text);
  const auto& parts = scene.effects.find<ElasticTables>()->of_bodies.at(0).parts;
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].law, "st_venant_kirchhoff") << "what is not given is the body's";
  EXPECT_EQ(parts[0].young_modulus, 5e7);
  EXPECT_EQ(parts[0].poisson_ratio, 0.3);
  EXPECT_EQ(parts[1].young_modulus, 1e7);
  EXPECT_FALSE(parts[1].density);
  const auto specs = solid_specs<2>(scene);
  EXPECT_NEAR(specs.at(0).solid->total_mass(), 0.075 * 1200 + 0.025 * 2400 + 2, 1e-10);
  const auto note = ElasticKind().note(scene, {});
  ASSERT_TRUE(note);
  EXPECT_NE(note->reason.find("mass 152 kg/m with centre"), std::string::npos) << note->reason;
}

/// All that ask for mass, centre and inertia are told those of the solid that is stepped.
TEST(ElasticScene, weighs_what_its_parts_and_point_masses_do) {
  const auto scene = scene_of(testing::replaced(
      with("modes = 2", "modes = 2\npart = [{name = \"end\", density = 3600, min = [0, -1], max = [1, 1]}]"),
      "position = [1, 2]", "position = [1, 2]\npitch_deg = 90"));
  const auto properties = mass_properties<2>(scene.bodies.at(0));
  const double left = 1200 * 0.05, right = 3600 * 0.05, mass = left + right + 2;
  const double centre = (left * -0.25 + right * 0.25 + 2 * 0.4) / mass;
  EXPECT_NEAR(properties.mass, mass, 1e-10);
  EXPECT_LT((properties.centre - Vec<2>(centre, 0)).norm(), 1e-12);
  const auto about = [&](double m, double x, double own) { return m * ((x - centre) * (x - centre) + own); };
  const double own = (0.5 * 0.5 + 0.1 * 0.1) / 12;
  const double inertia = about(left, -0.25, own) + about(right, 0.25, own) + about(2, 0.4, 0);
  EXPECT_NEAR(properties.inertia(0, 0), inertia, 1e-10);
  const auto world = build_world<2>(scene);
  const auto& spec = world.solids->spec(0);
  EXPECT_EQ(spec.mass, properties.mass);
  EXPECT_EQ(spec.inertia, properties.inertia);
  EXPECT_LT((world.solids->state(0).pose.translation() - Vec<2>(1, 2 + centre)).norm(), 1e-12)
      << "turned by 90 degrees";
}

TEST(ElasticScene, tells_the_part_of_its_peak_stress) {
  const auto part_of = [](const std::string& region) {
    const auto world =
        build_world<2>(scene_of(with("modes = 2", "scheme = \"steady\"\npart = [{name = \"root\", " + region + "}]")));
    EXPECT_TRUE(world.stepper->attempt(0.01).ok());
    world.stepper->commit();
    return world.solids->deformation(0).part;
  };
  EXPECT_EQ(part_of("min = [-1, -1], max = [-0.2, 1]"), "root") << "the beam is bent most at its clamp";
  EXPECT_EQ(part_of("min = [0, -1], max = [1, 1]"), "");
}

TEST(ElasticScene, of_a_part_that_is_no_other_moves_bit_by_bit_as_without) {
  auto one = build_world<2>(scene_of(beam)), other = build_world<2>(scene_of(with("modes = 2", part_of_all + "}]")));
  for (int step = 0; step < 3; ++step) {
    for (auto* world : {&one, &other}) {
      ASSERT_TRUE(world->stepper->attempt(0.01).ok());
      world->stepper->commit();
    }
    const auto first = one.solids->deformed(0), second = other.solids->deformed(0);
    EXPECT_EQ(first.surface.vertices, second.surface.vertices);
    EXPECT_EQ(first.von_mises, second.von_mises);
  }
}

TEST(ElasticScene, tells_natural_frequencies_before_the_run) {
  const auto scene = scene_of(beam);
  for (const auto* kind : effect_kinds())
    if (kind->name() == "elastic") {
      const auto note = kind->note(scene, scales<2>(scene));
      ASSERT_TRUE(note);
      EXPECT_NE(note->reason.find("natural frequencies"), std::string::npos) << note->reason;
      EXPECT_FALSE(kind->note(scene_of(testing::wedge_drop), {}).has_value());
    }
}

TEST(ElasticScene, looks_at_rows_of_points_and_at_what_is_asked_for) {
  const auto world = build_world<2>(scene_of(with("point = [0.5, 0]}]",
                                                  "point = [0, 0], to = [0.5, 0], count = 3, signals = "
                                                  "[\"velocity\", \"strain\"]}]")));
  const auto signals = world.solids->signals();
  ASSERT_EQ(signals.size(), 15u);
  EXPECT_EQ(signals[0].first, "tip_1.vx");
  EXPECT_EQ(signals[3].first, "tip_1.exy");
  EXPECT_EQ(signals[14].first, "tip_3.eyy");
}

TEST(ElasticScene, begins_where_its_loads_hold_it) {
  const auto steady = build_world<2>(scene_of(with("modes = 2", "scheme = \"steady\"")));
  const auto moving = build_world<2>(scene_of(with("modes = 2", "start = \"equilibrium\"")));
  ASSERT_TRUE(steady.stepper->attempt(0.01).ok());
  steady.stepper->commit();
  EXPECT_NEAR(tip(moving) / tip(steady), 1, 1e-9);
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(moving.stepper->attempt(0.01).ok());
    moving.stepper->commit();
  }
  EXPECT_NEAR(tip(moving) / tip(steady), 1, 1e-6) << "and stays there";
}

TEST(ElasticScene, is_bent_by_a_traction_on_its_end_as_by_a_force_there) {
  // 300 Pa on a height of 0.1 m are 30 N/m; how they are spread there matters at a height's distance alone.
  const auto patch = build_world<2>(scene_of(with(
      "modes = 2", "scheme = \"steady\"\npatch = [{min = [0.5, -0.05], max = [0.5, 0.05], traction = [0, 300]}]")));
  const auto force = build_world<2>(
      scene_of(testing::replaced(with("modes = 2", "scheme = \"steady\""), "force = [0, 30]", "force = [0, 60]")));
  for (const auto* world : {&patch, &force}) {
    ASSERT_TRUE(world->stepper->attempt(0.01).ok());
    world->stepper->commit();
  }
  EXPECT_NEAR(tip(patch) / tip(force), 1, 0.02);
}

TEST(ElasticScene, parts_have_no_density_beside_a_mass) {
  const auto text = with("modes = 2", part_of_all + ", density = 100}]");
  testing::expect_refused(
      testing::replaced(text, "density = 1200", "mass = 120"),
      {"", "", "", 20, "body.beam.elastic.part.all.density = 100", "beside the mass of the whole body"});
}

class BadElasticScene : public ::testing::TestWithParam<Mistake> {};
TEST_P(BadElasticScene, is_refused_with_place_rule_and_cure) {
  const auto& bad = GetParam();
  testing::expect_refused(with(bad.from, bad.to), bad);
}

const std::vector<Mistake> mistakes = {
    {"goal_of_nothing", "modes = 2", "goal = [{direction = \"x\"}]", 19, "body.beam.elastic.goal[0]",
     "says not what is asked for"},
    {"goal_of_a_motion", "modes = 2", "goal = [{point = \"tip\"}]", 19, "body.beam.elastic.goal[0]",
     "is that of an equilibrium"},
    {"goal_of_no_point", "modes = 2", "goal = [{point = \"end\"}]\nscheme = \"steady\"", 19,
     "body.beam.elastic.goal[0].point", "there is no point 'end'"},
    {"refined_for_nothing", "modes = 2", "adapt = 2", 19, "body.beam.elastic.adapt", "there is no goal"},
    {"incompressible", "poisson_ratio = 0.3", "poisson_ratio = 0.5", 14, "body.beam.elastic.poisson_ratio = 0.5",
     "must be below 0.5"},
    {"ratio_beyond", "poisson_ratio = 0.3", "poisson_ratio = 0.6", 14, "body.beam.elastic.poisson_ratio = 0.6",
     "Use e.g."},
    {"negative_modulus", "young_modulus = 1e7", "young_modulus = -1", 13, "body.beam.elastic.young_modulus = -1",
     "must be positive (Pa)"},
    {"no_size", "size = 0.1\n", "", 12, "body.beam.elastic.size is missing", "half of the thinnest part"},
    {"too_coarse", "size = 0.1", "size = 3", 15, "body.beam.elastic.size = 3", "must not exceed the body's extent"},
    {"too_fine", "size = 0.1", "size = 1e-4", 15, "body.beam.elastic.size = 0.0001", "elements"},
    {"holds_nothing", "min = [-0.5, -0.05], max = [-0.5, 0.05]", "centre = [3, 3], radius = 0.1", 16,
     "body.beam.elastic.clamp[0]", "holds nothing"},
    {"holds_everything", "max = [-0.5, 0.05]", "max = [0.5, 0.05]", 16, "body.beam.elastic.clamp",
     "holds the whole body"},
    {"moves_in_no_fluid", "max = [-0.5, 0.05]", "max = [-0.5, 0.05], velocity = [0, 1]", 16,
     "body.beam.elastic.clamp[0].velocity", "meets no fluid"},
    {"holds_along_no_axis", "max = [-0.5, 0.05]", "max = [-0.5, 0.05], axes = [\"z\"]", 16,
     "body.beam.elastic.clamp[0].axes", "'y'"},
    {"slides_on_its_clamp", "max = [-0.5, 0.05]}]", "max = [-0.5, 0.05], axes = [\"x\"]}]\ncoordinates = \"modes\"", 16,
     "body.beam.elastic.clamp", "leaves 1 of 3 rigid motions"},
    {"half_a_clamp", "max = [-0.5, 0.05]", "radius = 1", 16, "body.beam.elastic.clamp[0]", "says not what is held"},
    {"modes_beyond_the_mesh", "modes = 2", "modes = 1000", 19, "body.beam.elastic.modes = 1000", "must be below"},
    {"point_outside", "point = [0.5, 0]}]", "point = [0.6, 0]}]", 17, "body.beam.elastic.point.tip",
     "is not in the body"},
    {"mass_outside", "point = [0.4, 0]", "point = [0.4, 1]", 18, "body.beam.elastic.point_mass[0].point",
     "is not in the body"},
    {"held_by_motion", "density = 1200", "density = 1200\nmotion = \"fixed\"", 10, "body.beam.motion = \"fixed\"",
     "use clamp"},
    {"in_a_fluid_on_a_grid", "[gravity]",
     "[fluid]\nformulation = \"vortex\"\ndensity = 1\nviscosity = {dynamic = 0.1}\ngrid = {min = [-9, -9], max = [9, "
     "9], "
     "size = 0.1}\n[gravity]",
     17, "body.beam.elastic", "presses on rigid bodies alone"},
    {"before_a_rigid_body", "force = [0, 30]\npoint = [0.5, 0]\n",
     "force = [0, 30]\npoint = [0.5, 0]\n[[body]]\nname = \"ball\"\nmass = 1\nposition = [9, 9]\n"
     "shape = {type = \"circle\", radius = 1}\n",
     12, "body.beam.elastic", "rigid bodies stand before elastic ones"},
    {"modes_without_any", "modes = 2", "modes = 0\ncoordinates = \"modes\"", 19, "body.beam.elastic.modes = 0",
     "must be 1 at least"},
    {"no_equilibrium", "clamp = [{min = [-0.5, -0.05], max = [-0.5, 0.05]}]", "scheme = \"steady\"", 16,
     "body.beam.elastic.scheme = \"steady\"", "has no equilibrium"},
    {"unknown_law", "size = 0.1", "size = 0.1\nlaw = \"ogden\"", 16, "body.beam.elastic.law = \"ogden\"",
     "neo_hookean"},
    {"radius_of_another_scheme", "size = 0.1", "size = 0.1\nscheme = \"midpoint\"\nspectral_radius = 0.5", 17,
     "body.beam.elastic.spectral_radius", "only scheme = \"generalised_alpha\" has one"},
    {"turning_force", "axes = \"world\"", "axes = \"body\"", 20, "body.beam.force", "do not turn with them"},
    {"patch_without_a_load", "modes = 2", "modes = 2\npatch = [{min = [-0.5, -0.05], max = [0.5, 0.05]}]", 20,
     "body.beam.elastic.patch[0]", "has no load"},
    {"patch_with_two_loads", "modes = 2",
     "modes = 2\npatch = [{min = [-0.5, -0.05], max = [0.5, 0.05], pressure = 1, traction = [1, 0]}]", 20,
     "body.beam.elastic.patch[0]", "has more than one load"},
    {"patch_nowhere", "modes = 2", "modes = 2\npatch = [{pressure = 1}]", 20, "body.beam.elastic.patch[0]",
     "says not what is loaded"},
    {"patch_beside_the_body", "modes = 2", "modes = 2\npatch = [{centre = [3, 3], radius = 0.1, pressure = 1}]", 20,
     "body.beam.elastic.patch[0]", "loads nothing"},
    {"piezo_between_corners", "modes = 2", "modes = 2\npatch = [{min = [-0.5, -0.05], max = [0.5, 0.05], stretch = 1}]",
     20, "body.beam.elastic.patch[0].stretch", "on the rim of a disc"},
    {"burst_without_a_frequency", "modes = 2",
     "modes = 2\npatch = [{centre = [0, 0.05], radius = 0.1, pressure = 1, burst = {cycles = 3}}]", 20,
     "body.beam.elastic.patch[0].burst.frequency", "is missing"},
    {"equilibrium_of_a_free_body", "clamp = [{min = [-0.5, -0.05], max = [-0.5, 0.05]}]", "start = \"equilibrium\"", 16,
     "body.beam.elastic.start = \"equilibrium\"", "has no equilibrium"},
    {"count_without_a_line", "point = [0.5, 0]}]", "point = [0.5, 0], count = 3}]", 17,
     "body.beam.elastic.point.tip.count", "one point is no line"},
    {"two_points_of_a_name", "point = [0.5, 0]}]", "point = [0.5, 0]}, {name = \"tip\", point = [0, 0]}]", 17,
     "body.beam.elastic.point[1]", "is taken by another point"},
    {"part_beyond_the_body", "modes = 2", "part = [{name = \"far\", centre = [9, 9], radius = 1}]", 19,
     "body.beam.elastic.part.far", "covers no element"},
    {"part_without_a_place", "modes = 2", "part = [{name = \"where\", density = 100}]", 19,
     "body.beam.elastic.part.where", "says not what is meant"},
    {"part_of_two_places", "modes = 2",
     "part = [{name = \"two\", centre = [0, 0], radius = 1, points = [[0, 0], [1, 0], [0, 1]]}]", 19,
     "body.beam.elastic.part.two", "more than one region"},
    {"part_incompressible", "modes = 2",
     "part = [{name = \"jelly\", poisson_ratio = 0.5, centre = [0, 0], radius = 1}]", 19,
     "body.beam.elastic.part.jelly.poisson_ratio = 0.5", "must be below 0.5"},
    {"ply_without_moduli", "modes = 2", "part = [{name = \"ply\", law = \"orthotropic\", centre = [0, 0], radius = 1}]",
     19, "body.beam.elastic.part.ply.ply is missing", ""},
    {"no_such_mesh", "size = 0.1", "mesh = {file = \"none.msh\"}", 15, "body.beam.elastic.mesh", "none.msh"},
};
INSTANTIATE_TEST_SUITE_P(Elastic, BadElasticScene, ::testing::ValuesIn(mistakes),
                         [](const auto& info) { return std::string(info.param.name); });

/// The beam above water.
const std::string wet = testing::replaced(testing::replaced(beam, "[gravity]", R"([tank]
min = [-9, -9]
max = [9, 9]
[fluid]
density = 1000
[fluid.size]
surface = 1
far = 1
[[fluid.region]]
shape = "box"
min = [-9, -9]
max = [9, 0]
[gravity])"),
                                          "position = [1, 2]", "position = [1, 2]\nsize = 0.1");
const std::string moves = "max = [-0.5, 0.05], velocity = [[0, 0, 0], [1, 0, -2]]";
std::string wet_with(const std::string& from, const std::string& to) { return testing::replaced(wet, from, to); }

TEST(ElasticScene, has_clamps_that_hold_along_axes_and_move) {
  const auto scene = scene_of(wet_with("max = [-0.5, 0.05]", moves + ", axes = [\"x\", \"y\"]"));
  const auto& clamp = scene.effects.find<ElasticTables>()->of_bodies.at(0).clamps.at(0);
  EXPECT_EQ(clamp.axes, (std::vector<std::string>{"x", "y"}));
  const auto specs = solid_specs<2>(scene);
  const auto& held = specs.at(0).solid->held();
  const elastic::Field drive = specs.at(0).drive(0.5);
  for (Eigen::Index k = 0; k < drive.size(); ++k)
    EXPECT_EQ(drive[k], held[static_cast<std::size_t>(k)] && k % 2 == 1 ? -1 : 0) << k;
  const auto roller = solid_specs<2>(scene_of(wet_with("max = [-0.5, 0.05]", "max = [-0.5, 0.05], axes = [\"y\"]")));
  for (std::size_t k = 0; k < held.size(); ++k) EXPECT_EQ(roller.at(0).solid->held()[k], held[k] && k % 2 == 1) << k;
  EXPECT_FALSE(roller.at(0).drive) << "it stays";
}

TEST(ElasticScene, asks_about_water_far_coarser_than_the_body) {
  std::vector<std::string> questions;
  const auto ask = [&](const std::string& text) {
    questions.clear();
    const auto scene = scene_of(text);
    ElasticKind().ask({.scene = scene, .level = {}}, questions);
    return questions.size();
  };
  EXPECT_EQ(ask(wet), 0u);
  EXPECT_EQ(ask(wet_with("position = [1, 2]\nsize = 0.1", "position = [1, 2]\nsize = 0.5")), 1u);
  EXPECT_TRUE(questions.at(0).starts_with("body.beam.size = 0.5 m")) << questions.at(0);
  EXPECT_EQ(ask(beam), 0u) << "there is no water";
}

/// A ball in space, meshed from its shape.
const std::string ball = R"(title = "ball"
dimension = 3
[time]
end = 0.1
dt_max = 0.01
[[body]]
name = "ball"
density = 1200
position = [1, 2, 3]
shape = { type = "sphere", radius = 0.5 }
[body.elastic]
young_modulus = 1e7
poisson_ratio = 0.3
size = 0.4
)";

TEST(ElasticScene, in_space_is_meshed_from_its_shape_and_keeps_its_mass) {
  const auto scene = scene_of(ball);
  const auto specs = solid_specs<3>(scene);
  const auto& solid = *specs.at(0).solid;
  EXPECT_NEAR(solid.total_mass() / (1200 * 4. / 3 * std::numbers::pi * 0.125), 1, 1e-12) << "chords enclose 9 % less";
  EXPECT_LT((solid.centre(elastic::Field::Zero(solid.size())) - Vec<3>(1, 2, 3)).norm(), 0.01);
  const auto note = ElasticKind().note(scene, {});
  ASSERT_TRUE(note);
  for (const char* word : {"elements", "nodes", "least quality", "meshed in"})
    EXPECT_NE(note->reason.find(word), std::string::npos) << note->reason;
}

TEST(ElasticScene, asks_about_elements_far_larger_than_a_body_in_space_is_thick) {
  const auto asked = [](const std::string& shape, const std::string& size) {
    std::vector<std::string> questions;
    auto text = testing::replaced(ball, "{ type = \"sphere\", radius = 0.5 }", shape);
    const auto scene = scene_of(testing::replaced(text, "size = 0.4", "size = " + size));
    ElasticKind().ask({.scene = scene, .level = {}}, questions);
    return questions;
  };
  const std::string plate = "{ type = \"box\", size = [1, 1, 0.05] }";
  EXPECT_TRUE(asked(plate, "0.1").empty());
  const auto questions = asked(plate, "0.5");
  ASSERT_EQ(questions.size(), 1u);
  EXPECT_TRUE(questions[0].starts_with("body.ball.elastic.size = 0.5 m is 10 times")) << questions[0];
  EXPECT_TRUE(asked("{ type = \"sphere\", radius = 0.5 }", "0.5").empty());
}

class BadElasticSceneInSpace : public ::testing::TestWithParam<Mistake> {};
TEST_P(BadElasticSceneInSpace, is_refused_with_place_rule_and_cure) {
  const auto& bad = GetParam();
  testing::expect_refused(testing::replaced(ball, bad.from, bad.to), bad);
}
const std::vector<Mistake> mistakes_in_space = {
    {"refined_for_goals", "size = 0.4", "size = 0.4\nadapt = 2", 15, "body.ball.elastic.adapt",
     "in space are not refined"},
    {"too_thin", "{ type = \"sphere\", radius = 0.5 }", "{ type = \"box\", size = [1, 1, 0.001] }", 14,
     "body.ball.elastic.size = 0.4", "Parts of 0.001 m get elements as small"},
    {"too_fine_in_space", "size = 0.4", "size = 0.004", 14, "body.ball.elastic.size = 0.004", "Use larger elements"},
    {"misses_its_shape", "{ type = \"sphere\", radius = 0.5 }",
     "{ type = \"revolved\", profile = [[0, 0], [0.015, 0.1], [0.015, 0.9], [0, 1]] }", 14,
     "body.ball.elastic.size = 0.4", "Use smaller elements"},
};
INSTANTIATE_TEST_SUITE_P(Elastic, BadElasticSceneInSpace, ::testing::ValuesIn(mistakes_in_space),
                         [](const auto& info) { return std::string(info.param.name); });

class BadWetElasticScene : public ::testing::TestWithParam<Mistake> {};
TEST_P(BadWetElasticScene, is_refused_with_place_rule_and_cure) {
  const auto& bad = GetParam();
  testing::expect_refused(wet_with(bad.from, bad.to), bad);
}
const std::vector<Mistake> wet_mistakes = {
    {"slips_along_its_motion", "max = [-0.5, 0.05]", "max = [-0.5, 0.05], velocity = [0, 1], axes = [\"x\"]", 29,
     "body.beam.elastic.clamp[0].velocity", "moves along y, along which"},
    {"is_torn", "max = [-0.5, 0.05]}", "max = [-0.5, 0.05]}, {centre = [-0.5, 0], radius = 0.01, velocity = [0, 1]}",
     29, "body.beam.elastic.clamp[1].velocity", "moves the same nodes differently"},
    {"modes_of_two_motions", "max = [-0.5, 0.05]}]",
     "max = [-0.5, 0.05]}, {centre = [0.5, 0], radius = 0.06, velocity = [0, 1]}]\ncoordinates = \"modes\"", 29,
     "body.beam.elastic.clamp[1].velocity", "modes know one motion"},
};
INSTANTIATE_TEST_SUITE_P(Elastic, BadWetElasticScene, ::testing::ValuesIn(wet_mistakes),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace splashdown::apps::scene_test
