// Every bad scene is refused with file:line, key, value, rule and cure.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "apps/scene/read/read.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::bad_scene_test {
namespace {

using testing::messages_of;
using testing::Mistake;

class BadSceneIsRefused : public ::testing::TestWithParam<Mistake> {};

TEST_P(BadSceneIsRefused, with_place_key_and_rule) {
  const auto& bad = GetParam();
  testing::expect_refused(testing::wedge_drop_with(bad.from, bad.to), bad);
}

const std::vector<Mistake> scenes = {
    {"syntax", "density = 1000", "density = = 1000", 10, "not TOML", "toml.io"},
    {"twice_the_same_key", "mass = 241", "mass = 241\nmass = 3", 21, "not TOML", "toml.io"},
    {"unfinished_string", "\"wedge\"\nmass", "\"wedge\nmass", 19, "not TOML", "toml.io"},
    {"unknown_root_key", "title", "tilte", 1, "tilte = \"wedge\": unknown key", "Did you mean 'title'?"},
    {"unknown_key", "density = 1000", "density = 1000\ndensty = 1", 11, "fluid.densty = 1: unknown key",
     "Did you mean 'density'?"},
    {"unknown_key_far_from_any", "surface = 0.01", "surface = 0.01\nqqqqqqqq = 1", 13,
     "fluid.size.qqqqqqqq = 1: unknown key", "'growth'"},
    {"unknown_table", "[output]", "[outptu]", 26, "outptu: unknown key", "Did you mean 'output'?"},
    {"unknown_body_key", "mass = 241", "mass = 241\nrestitution = 0.5", 21, "body.wedge.restitution = 0.5: unknown key",
     "Valid here"},
    {"unknown_shape_key", "breadth = 0.5", "breadth = 0.5, widht = 1", 25, "body.wedge.shape.widht = 1: unknown key",
     "Valid here"},
    {"enable_keys_do_not_exist", "density = 1000", "density = 1000\n[fluid.viscosity]\nenable = true", 12,
     "fluid.viscosity.enable = true: unknown key", "Valid here"},
    {"negative_density", "density = 1000", "density = -3", 10, "fluid.density = -3",
     "must be positive (kg/m^3). Use e.g. 1000"},
    {"density_as_string", "density = 1000", "density = \"heavy\"", 10, "fluid.density = \"heavy\"",
     "must be a number (kg/m^3), not a string"},
    {"density_beyond_exact_integers", "density = 1000", "density = 9007199254740993", 10,
     "fluid.density = 9007199254740993", "whole numbers beyond 2^53 are not kept exactly. Write it with a point"},
    {"passes_beyond_exact_integers", "[output]", "[coupling]\nmax_passes = 9007199254740993\n[output]", 27,
     "coupling.max_passes = 9007199254740993", "beyond 2^53"},
    {"decimal_comma", "density = 1000", "density = 1000,5  # g", 10, "not TOML: 1000,5 has a comma",
     "Numbers have a point: did you mean 1000.5?"},
    {"length_beyond_any_tank", "max = [2, 1]", "max = [2e9, 1]", 8, "tank.max = [2000000000, 1]",
     "must not be beyond 1e+06 m. Scenes are in metres"},
    {"length_below_any_element", "surface = 0.01", "surface = 1e-308", 12, "fluid.size.surface = 1e-308",
     "must not be below 1e-09 m"},
    {"density_not_finite", "density = 1000", "density = nan", 10, "fluid.density = nan", "must be finite"},
    {"density_infinite", "density = 1000", "density = inf", 10, "fluid.density = inf", "must be finite"},
    {"density_missing", "density = 1000\n", "", 9, "fluid.density is missing", "Use e.g. 1000"},
    {"end_missing", "end = 0.02\n", "", 2, "time.end is missing", "a number (s)"},
    {"end_zero", "end = 0.02", "end = 0", 3, "time.end = 0", "must be positive (s)"},
    {"end_as_date", "end = 0.02", "end = 2020-01-01", 3, "time.end = 2020-01-01", "not a date"},
    {"cfl_zero", "end = 0.02", "end = 0.02\ncfl = 0", 4, "time.cfl = 0", "must lie in (0, 1]"},
    {"cfl_above_one", "end = 0.02", "end = 0.02\ncfl = 1.5", 4, "time.cfl = 1.5", "must lie in (0, 1]"},
    {"dt_max_zero", "end = 0.02", "end = 0.02\ndt_max = 0", 4, "time.dt_max = 0", "must be positive (s)"},
    {"table_as_number", "[gravity]\nacceleration = [0, -9.81]", "[[gravity]]", 4, "gravity",
     "must be a table, not an array of tables"},
    {"gravity_too_long", "[0, -9.81]", "[0, 0, -9.81]", 5, "gravity.acceleration = [0, 0, -9.81]",
     "must be a list of 2 numbers (m/s^2), not 3"},
    {"gravity_as_number", "[0, -9.81]", "-9.81", 5, "gravity.acceleration = -9.81",
     "must be a list of 2 numbers (m/s^2), not a number"},
    {"gravity_holds_text", "[0, -9.81]", "[0, \"g\"]", 5, "gravity.acceleration",
     "must be a number (m/s^2), not a string"},
    {"tank_upside_down", "max = [2, 1]", "max = [2, -1]", 8, "tank.max = [2, -1]", "must lie above tank.min"},
    {"tank_corner_missing", "max = [2, 1]\n", "", 6, "tank.max is missing", "list of 2 numbers"},
    {"tank_size_too_large", "max = [2, 1]", "max = [2, 1]\nsize = 3", 9, "tank.size = 3",
     "must not exceed the tank's smallest side, 2 m"},
    {"surface_size_zero", "surface = 0.01", "surface = 0", 12, "fluid.size.surface = 0", "must be positive (m)"},
    {"surface_size_beyond_region", "surface = 0.01\nfar = 0.2", "surface = 1.5\nfar = 2", 12,
     "fluid.size.surface = 1.5", "smallest extent of fluid.region[0], 1 m"},
    {"far_below_surface", "far = 0.2", "far = 0.001", 13, "fluid.size.far = 0.001",
     "must not be below fluid.size.surface"},
    {"growth_above_one", "far = 0.2", "far = 0.2\ngrowth = 2", 14, "fluid.size.growth = 2", "must lie in (0, 1]"},
    {"growth_zero", "far = 0.2", "far = 0.2\ngrowth = 0", 14, "fluid.size.growth = 0", "must lie in (0, 1]"},
    {"wetted_fraction_negative", "far = 0.2", "far = 0.2\nwetted_fraction = -1", 14, "fluid.size.wetted_fraction = -1",
     "must lie in [0, 0.5]"},
    {"hollow_without_a_least_size", "far = 0.2", "far = 0.2\nhollow = 0.2", 11, "fluid.size.hollow_min is missing",
     "a number (m)"},
    {"refine_out_of_range", "far = 0.2", "far = 0.2\nrefine = 1000", 14,
     "fluid.size.refine = 1000: must lie in [0.01, 100]", "Use e.g. 2"},
    {"refine_misspelt", "far = 0.2", "far = 0.2\nrefine = \"drafft\"", 14,
     "fluid.size.refine = \"drafft\": must be a number or", "Did you mean 'draft'?"},
    {"refine_leaves_no_share", "far = 0.2", "far = 0.2\nrefine = 0.5\nwetted_fraction = 0.3", 15,
     "fluid.size.wetted_fraction = 0.3: must lie in [0, 0.5]", "so must what fluid.size.refine = 0.5 makes of it, 0.6"},
    {"curvature_zero", "far = 0.2", "far = 0.2\ncurvature = 0", 14, "fluid.size.curvature = 0", "must be positive"},
    {"corner_larger_than_the_hull", "far = 0.2", "far = 0.2\ncorner = 2", 14, "fluid.size.corner = 2",
     "0.25 where the pressure"},
    {"no_region", "[[fluid.region]]\nshape = \"box\"\nmin = [-2, -1]\nmax = [2, 0]\n", "", 9, "fluid.region is missing",
     "[[fluid.region]]"},
    {"region_as_table", "[[fluid.region]]", "[fluid.region]", 14, "fluid.region",
     "must be an array of tables, not a table"},
    {"region_shape_unknown", "shape = \"box\"", "shape = \"boks\"", 15, "fluid.region[0].shape = \"boks\"",
     "Did you mean 'box'?"},
    {"region_turned_over", "max = [2, 0]", "max = [2, -3]", 17, "fluid.region[0].max = [2, -3]", "must lie above min"},
    {"region_outside_tank", "min = [-2, -1]\nmax = [2, 0]", "min = [5, -1]\nmax = [6, 0]", 14, "fluid.region[0]",
     "lies outside the tank"},
    {"wave_without_length", "max = [2, 0]", "max = [2, 0]\nsurface_amplitude = 0.1", 14,
     "fluid.region[0].surface_wavelength is missing", "sloshing"},
    {"wave_deeper_than_water", "max = [2, 0]", "max = [2, 0]\nsurface_amplitude = 1.1\nsurface_wavelength = 2", 18,
     "fluid.region[0].surface_amplitude = 1.1", "must stay below the depth"},
    {"regions_overlap", "[[body]]", "[[fluid.region]]\nshape = \"circle\"\ncentre = [0, -0.5]\nradius = 0.1\n[[body]]",
     18, "fluid.region[1]", "overlaps fluid.region[0]"},
    {"gradient_makes_volume", "max = [2, 0]", "max = [2, 0]\nvelocity_gradient = [[1, 0], [0, 1]]", 18,
     "fluid.region[0].velocity_gradient", "zero trace, not 2"},
    {"gradient_not_square", "max = [2, 0]", "max = [2, 0]\nvelocity_gradient = [[1, 0]]", 18,
     "fluid.region[0].velocity_gradient", "must have 2 rows, not 1"},
    {"region_polygon_crosses_itself", "shape = \"box\"\nmin = [-2, -1]\nmax = [2, 0]",
     "shape = \"polygon\"\npoints = [[-1, -1], [1, 0], [1, -1], [-1, -0.2]]", 16, "fluid.region[0].points",
     "touch or cross"},
    {"union_without_parts", "shape = \"box\"\nmin = [-2, -1]\nmax = [2, 0]", "shape = \"union\"", 14,
     "fluid.region[0].part", "a union has parts"},
    {"union_in_a_union", "shape = \"box\"\nmin = [-2, -1]\nmax = [2, 0]",
     "shape = \"union\"\n[[fluid.region.part]]\nshape = \"union\"", 17, "fluid.region[0].part[0].shape = \"union\"",
     "must be 'box'"},
    {"viscosity_zero", "[tank]", "[fluid.viscosity]\ndynamic = 0\n[tank]", 7, "fluid.viscosity.dynamic = 0",
     "must be positive (Pa s)"},
    {"viscous_wall_unknown", "[tank]", "[fluid.viscosity]\nwalls = \"no-slip\"\n[tank]", 7,
     "fluid.viscosity.walls = \"no-slip\"", "Did you mean 'no_slip'?"},
    {"absorber_longer_than_tank", "[tank]", "[fluid.absorber]\nwidth = 3\nrate = 1\n[tank]", 7,
     "fluid.absorber.width = 3", "half the tank's length"},
    {"friction_line_unknown", "[tank]", "[fluid.skin_friction]\nline = \"ittc57\"\n[tank]", 7,
     "fluid.skin_friction.line = \"ittc57\"", "Did you mean 'ittc1957'?"},
    {"friction_without_viscosity", "[tank]", "[fluid.skin_friction]\ndynamic_viscosity = 0\n[tank]", 7,
     "fluid.skin_friction.dynamic_viscosity = 0", "must be positive (Pa s)"},
    {"friction_counted_twice", "[tank]", "[fluid.viscosity]\nwalls = \"no_slip\"\n[fluid.skin_friction]\n[tank]", 8,
     "fluid.skin_friction", "twice"},
    {"form_drag_of_nobody", "[tank]", "[fluid.form_drag]\ncoefficients = {wegde = 1}\n[tank]", 7,
     "fluid.form_drag.coefficients.wegde", "wedge"},
    {"form_drag_negative", "[tank]", "[fluid.form_drag]\ncoefficients = {wedge = -1}\n[tank]", 7,
     "fluid.form_drag.coefficients.wedge = -1", "must be from 0 to 20"},
    {"form_drag_is_no_number", "[tank]", "[fluid.form_drag]\ncoefficients = {wedge = \"flat\"}\n[tank]", 7,
     "fluid.form_drag.coefficients.wedge", "must be a number"},
    {"body_as_table", "[[body]]", "[body]", 18, "body", "must be an array of tables, not a table"},
    {"body_name_missing", "name = \"wedge\"\n", "", 18, "body[0].name is missing", "a string"},
    {"body_name_is_a_number", "\"wedge\"\nmass", "\"12\"\nmass", 19, "body.12.name = \"12\"", "not of digits alone"},
    {"mass_negative", "mass = 241", "mass = -1", 20, "body.wedge.mass = -1",
     "must not be below 0 (kg/m). Use motion = \"fixed\""},
    {"joint_of_no_type", "[[record]]", "[[joint]]\ntype = \"hing\"\n[[record]]", 29, "joint[0].type = \"hing\"",
     "Did you mean 'hinge'?"},
    {"joint_of_no_body", "[[record]]", "[[joint]]\ntype = \"hinge\"\nbody = \"wegde\"\npoint = [0, 0]\n[[record]]", 30,
     "joint[0].body = \"wegde\"", "Did you mean 'wedge'?"},
    {"hinge_of_no_place", "[[record]]", "[[joint]]\ntype = \"hinge\"\nbody = \"wedge\"\n[[record]]", 28,
     "joint[0].point is missing", "Use the place of the hinge"},
    {"joint_to_itself", "[[record]]", "[[joint]]\ntype = \"weld\"\nbody = \"wedge\"\nother = \"wedge\"\n[[record]]", 31,
     "joint[0].other = \"wedge\"", "cannot be tied to itself"},
    {"slider_without_direction", "[[record]]",
     "[[joint]]\ntype = \"slider\"\nbody = \"wedge\"\naxis = [0, 0]\n[[record]]", 31, "joint[0].axis = [0, 0]",
     "must have a direction"},
    {"weld_with_a_point", "[[record]]", "[[joint]]\ntype = \"weld\"\nbody = \"wedge\"\npoint = [0, 0]\n[[record]]", 31,
     "joint[0].point = [0, 0]", "unknown key"},
    {"weld_with_a_spring", "[[record]]", "[[joint]]\ntype = \"weld\"\nbody = \"wedge\"\nstiffness = 3\n[[record]]", 31,
     "joint[0].stiffness = 3", "unknown key"},
    {"hinge_limits_beside_its_place", "[[record]]",
     "[[joint]]\ntype = \"hinge\"\nbody = \"wedge\"\npoint = [0, 0]\nlimits_deg = [10, 20]\n[[record]]", 32,
     "joint[0].limits_deg = [10, 20]", "must be two numbers around 0, the place at t = 0. Use e.g. [-30.0, 45.0]."},
    {"slider_limits_in_degrees", "[[record]]",
     "[[joint]]\ntype = \"slider\"\nbody = \"wedge\"\naxis = [0, 1]\nlimits_deg = [-1, 1]\n[[record]]", 32,
     "joint[0].limits_deg = [-1, 1]: unknown key", "Did you mean 'limits'?"},
    {"rest_of_no_spring", "[[record]]",
     "[[joint]]\ntype = \"slider\"\nbody = \"wedge\"\naxis = [0, 1]\nrest = 0.1\n[[record]]", 32, "joint[0].rest = 0.1",
     "there is no spring that could be relaxed. Add a stiffness, or remove it."},
    {"contact_with_an_unknown_key", "[[record]]", "[contact]\nfrction = 0.3\n[[record]]", 29, "contact.frction = 0.3",
     "Did you mean 'friction'?"},
    {"contact_that_gives_energy", "[[record]]", "[contact]\nrestitution = 1.2\n[[record]]", 29,
     "contact.restitution = 1.2", "must lie in [0, 1]"},
    {"mass_missing", "mass = 241\n", "", 18, "body.wedge.mass is missing", "mass (kg/m) or mean density"},
    {"mass_and_density", "mass = 241", "mass = 241\ndensity = 500", 21, "body.wedge.density = 500",
     "exclude each other"},
    {"inertia_negative", "mass = 241", "mass = 241\ninertia = -1", 21, "body.wedge.inertia = -1",
     "must be positive (kg m)"},
    {"motion_unknown", "mass = 241", "mass = 241\nmotion = \"frozen\"", 21, "body.wedge.motion = \"frozen\"",
     "must be 'free', 'fixed' or 'prescribed'"},
    {"freedom_unknown", "free = [\"y\"]", "free = [\"z\"]", 23, "body.wedge.free = [\"z\"]",
     "must be a list of 'x', 'y' or 'rotation'"},
    {"freedom_none", "free = [\"y\"]", "free = []", 23, "body.wedge.free = []", "must name at least one"},
    {"fixed_body_with_velocity", "mass = 241\nposition = [0, 0.01]\nvelocity = [0, -6.15]\nfree = [\"y\"]",
     "motion = \"fixed\"\nposition = [0, 0.01]\nvelocity = [0, -6.15]", 22, "body.wedge.velocity",
     "a fixed body does not move"},
    {"path_of_a_free_body", "mass = 241", "mass = 241\npath = [[0, 0, 1, 0], [1, 0, 0, 0]]", 21, "body.wedge.path",
     "only a body with motion = \"prescribed\""},
    {"path_runs_backwards", "mass = 241\nposition = [0, 0.01]\nvelocity = [0, -6.15]\nfree = [\"y\"]",
     "motion = \"prescribed\"\npath = [[0, 0, 0.1, 0], [0.2, 0, 0.1, 0], [0.1, 0, 0.1, 0]]", 21, "body.wedge.path",
     "times must increase"},
    {"path_row_too_short", "mass = 241\nposition = [0, 0.01]\nvelocity = [0, -6.15]\nfree = [\"y\"]",
     "motion = \"prescribed\"\npath = [[0, 0, 0.1]]", 21, "body.wedge.path", "must be a list of 4 numbers"},
    {"path_leaves_the_tank", "mass = 241\nposition = [0, 0.01]\nvelocity = [0, -6.15]\nfree = [\"y\"]",
     "motion = \"prescribed\"\npath = [[0, 0, 0.1, 0], [0.2, 0, -1.1, 0]]", 21, "body.wedge.path", "leaves the tank"},
    {"pitch_beyond_a_turn", "mass = 241", "mass = 241\npitch_deg = 400", 21, "body.wedge.pitch_deg = 400",
     "must lie in [-360, 360] (deg)"},
    {"position_outside_tank", "position = [0, 0.01]", "position = [1.9, 0.01]", 21, "body.wedge.position = [1.9, 0.01]",
     "leaves the tank"},
    {"body_size_zero", "size = 0.005", "size = 0", 24, "body.wedge.size = 0", "must be positive (m)"},
    {"body_size_beyond_body", "size = 0.005", "size = 5", 24, "body.wedge.size = 5",
     "must not exceed the body's extent"},
    {"shape_missing", "shape = { type = \"wedge\", deadrise_deg = 30, breadth = 0.5 }\n", "", 18,
     "body.wedge.shape is missing", "a table"},
    {"shape_unknown", "type = \"wedge\"", "type = \"cone\"", 25, "body.wedge.shape.type = \"cone\"",
     "must be 'polygon', 'wedge'"},
    {"deadrise_zero", "deadrise_deg = 30", "deadrise_deg = 0", 25, "body.wedge.shape.deadrise_deg = 0",
     "must lie in (0, 89] (deg)"},
    {"breadth_negative", "breadth = 0.5", "breadth = -0.5", 25, "body.wedge.shape.breadth = -0.5",
     "must be positive (m)"},
    {"wedge_too_low", "breadth = 0.5", "breadth = 0.5, height = 0.1", 25, "body.wedge.shape.height = 0.1",
     "must not be below that of the faces"},
    {"outline_crosses_itself", "{ type = \"wedge\", deadrise_deg = 30, breadth = 0.5 }",
     "{ type = \"polygon\", points = [[0, 0], [1, 1], [1, 0], [0, 0.7]] }", 25, "body.wedge.shape.points",
     "touch or cross"},
    {"outline_of_two_points", "{ type = \"wedge\", deadrise_deg = 30, breadth = 0.5 }",
     "{ type = \"polygon\", points = [[0, 0], [1, 1]] }", 25, "body.wedge.shape.points", "at least 3"},
    {"spline_of_two_points", "{ type = \"wedge\", deadrise_deg = 30, breadth = 0.5 }",
     "{ type = \"spline\", points = [[0, 0], [1, 1]] }", 25, "body.wedge.shape.points", "needs at least 4"},
    {"spline_crosses_itself", "{ type = \"wedge\", deadrise_deg = 30, breadth = 0.5 }",
     "{ type = \"spline\", points = [[0, 0], [3, 1], [-2, 1], [1, 0]] }", 25, "body.wedge.shape.points",
     "touch or cross"},
    {"bodies_with_the_same_name", "[output]",
     "[[body]]\nname = \"wedge\"\nmotion = \"fixed\"\nposition = [1, 0.5]\nshape = { type = \"circle\", "
     "radius = 0.1 }\n[output]",
     27, "body[1].name = \"wedge\"", "is taken by another body"},
    {"bodies_overlap", "[output]",
     "[[body]]\nname = \"rock\"\nmotion = \"fixed\"\nposition = [0.1, 0.1]\nshape = { type = \"circle\", "
     "radius = 0.1 }\n[output]",
     29, "body.rock.position = [0.1, 0.1]", "overlaps body.wedge"},
    {"scheme_unknown", "[output]", "[coupling]\nscheme = \"iterate\"\n[output]", 27, "coupling.scheme = \"iterate\"",
     "Did you mean 'iterated'?"},
    {"formulation_unknown", "density = 1000", "density = 1000\nformulation = \"euler\"", 11,
     "fluid.formulation = \"euler\"", "'fractional', 'monolithic', 'vortex' or 'ale'"},
    {"monolithic_scheme_unknown", "density = 1000",
     "density = 1000\nformulation = \"monolithic\"\nmonolithic = {scheme = \"bdf2\"}", 12,
     "fluid.monolithic.scheme = \"bdf2\"", "'midpoint' or 'implicit_euler'"},
    {"sound_slower_than_the_fall", "[tank]", "[fluid.compressibility]\nspeed_of_sound = 5\n[tank]", 7,
     "fluid.compressibility.speed_of_sound = 5", "must be faster than what moves, 6.15 m/s"},
    {"soft_water_is_slower", "[tank]", "[fluid.compressibility]\nbulk_modulus = 1000\n[tank]", 7,
     "fluid.compressibility.bulk_modulus = 1000", "sound runs at 1 m/s"},
    {"sound_given_twice", "[tank]", "[fluid.compressibility]\nspeed_of_sound = 1480\nbulk_modulus = 2e9\n[tank]", 8,
     "fluid.compressibility.bulk_modulus", "Give one of the two"},
    {"all_gas", "[tank]", "[fluid.compressibility]\ngas_content = 1\n[tank]", 7,
     "fluid.compressibility.gas_content = 1", "[0, 0.9]"},
    {"table_of_another_formulation", "[fluid.size]", "[fluid.monolithic]\ntolerance = 1e-8\n[fluid.size]", 11,
     "fluid.monolithic", "belongs to formulation = \"monolithic\""},
    {"grid_of_another_formulation", "[fluid.size]", "[fluid.grid]\nsize = 0.01\n[fluid.size]", 11, "fluid.grid",
     "belongs to formulation = \"vortex\""},
    {"convective_without_speed", "density = 1000",
     "density = 1000\nformulation = \"monolithic\"\nmonolithic = {stabilisation = \"convective\"}", 12,
     "fluid.monolithic.speed", "e.g. 100"},
    {"interface_term_unknown", "[output]", "[coupling]\ninterface_term = \"exact\"\n[output]", 27,
     "coupling.interface_term = \"exact\"", "'rigid', 'laplacian', 'robin' or 'none'"},
    {"accelerator_unknown", "[output]", "[coupling]\naccelerator = \"newton\"\n[output]", 27,
     "coupling.accelerator = \"newton\"", "'constant', 'aitken', 'anderson', 'broyden', 'iqn_ils' or 'probe'"},
    {"depth_zero", "[output]", "[coupling]\ndepth = 0\n[output]", 27, "coupling.depth = 0", "must lie in [1, 10000]"},
    {"reuse_negative", "[output]", "[coupling]\nreuse = -1\n[output]", 27, "coupling.reuse = -1",
     "must lie in [0, 100]"},
    {"relaxation_zero", "[output]", "[coupling]\nrelaxation = 0\n[output]", 27, "coupling.relaxation = 0",
     "must lie in (0, 1]"},
    {"passes_not_whole", "[output]", "[coupling]\nmax_passes = 2.5\n[output]", 27, "coupling.max_passes = 2.5",
     "must be a whole number"},
    {"interval_negative", "interval = 0.001", "interval = -1", 27, "output.interval = -1", "must not be below 0 (s)"},
    {"interval_beyond_end", "interval = 0.001", "interval = 1", 27, "output.interval = 1", "must not exceed time.end"},
    {"record_kind_unknown", "kind = \"pressure\"", "kind = \"presure\"", 29, "record.keel.kind = \"presure\"",
     "Did you mean 'pressure'?"},
    {"probe_on_unknown_body", "body = \"wedge\"", "body = \"wegde\"", 31, "record.keel.body = \"wegde\"",
     "Did you mean 'wedge'?"},
    {"probe_outside_tank", "body = \"wedge\"\npoint = [0, 0]", "point = [3, 0]", 31, "record.keel.point = [3, 0]",
     "lies outside the tank"},
    {"probe_inside_its_body", "point = [0, 0]", "point = [0, 0.1]", 32, "record.keel.point = [0, 0.1]",
     "inside the body 'wedge'"},
    {"gauge_outside_tank", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"surface_elevation\"\nname = \"g\"\nx = 9", 31, "record.g.x = 9", "lies outside the tank"},
    {"records_with_the_same_name", "[[record]]",
     "[[record]]\nkind = \"surface_elevation\"\nname = \"keel\"\nx = 0\n[[record]]", 34, "record[1].name = \"keel\"",
     "is taken by another record"},
    {"added_mass_of_an_unknown_body", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"added_mass\"\nbody = \"wegde\"", 30, "record[0].body = \"wegde\"", "Did you mean 'wedge'?"},
    {"added_mass_of_no_body", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"added_mass\"", 28, "record[0].body", "missing"},
    {"added_mass_at_a_point", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"added_mass\"\nbody = \"wedge\"\npoint = [0, 0]", 31, "record[0].point = [0, 0]: unknown key",
     "Valid here"},
    {"added_mass_when", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"added_mass\"\nbody = \"wedge\"\ninterval = 0\ntimes = [0]", 32, "record[0].times = [0]",
     "exclude each other"},
    {"added_mass_after_the_end", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"added_mass\"\nbody = \"wedge\"\ntimes = [1]", 31, "record[0].times = [1]", "must not exceed time.end"},
    {"added_mass_twice", "[[record]]",
     "[[record]]\nkind = \"added_mass\"\nbody = \"wedge\"\n[[record]]\nkind = \"added_mass\"\nbody = "
     "\"wedge\"\n[[record]]",
     33, "record[1].body = \"wedge\"", "has an added_mass record already"},
    {"patch_beside_the_hull", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"pressure_patch\"\nname = \"n\"\nbody = \"wedge\"\ncentre = [2, 0]\nradius = 0.1", 32,
     "record.n.centre = [2, 0]", "no part of the hull"},
    {"patch_inside_the_hull", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"pressure_patch\"\nname = \"n\"\nbody = \"wedge\"\nmin = [-0.01, 0.07]\nmax = [0.01, 0.09]", 32,
     "record.n.min = [-0.01, 0.07]", "no part of the hull"},
    {"patch_upside_down", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"pressure_patch\"\nname = \"n\"\nbody = \"wedge\"\nmin = [0.1, 0.1]\nmax = [-0.1, 0.2]", 33,
     "record.n.max = [-0.1, 0.2]", "must be greater than min"},
    {"patch_that_is_both", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"pressure_patch\"\nname = \"n\"\nbody = \"wedge\"\ncentre = [0, 0]\nradius = 0.1\nmin = [0, 0]", 32,
     "record.n.centre = [0, 0]", "is a disc (centre and radius) or a box (min and max)"},
    {"patch_without_radius", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"pressure_patch\"\nname = \"n\"\nbody = \"wedge\"\ncentre = [0, 0]", 32, "record.n.centre = [0, 0]",
     "is a disc (centre and radius) or a box (min and max)"},
    {"maximum_pressure_of_the_tank", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"maximum_pressure\"\nbody = \"tank\"", 30, "record[0].body = \"tank\"", "wedge"},
    {"maximum_pressure_without_distance", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]",
     "kind = \"maximum_pressure\"\nbody = \"wedge\"\nsize = 0", 31, "record[0].size = 0", "must be positive"},
    {"maximum_pressure_twice", "[[record]]",
     "[[record]]\nkind = \"maximum_pressure\"\nbody = \"wedge\"\n[[record]]\nkind = \"maximum_pressure\"\nbody = "
     "\"wedge\"\n[[record]]",
     33, "record[1].body = \"wedge\"", "has a maximum_pressure record already"},
    {"four_dimensions", "title", "dimension = 4\ntitle", 1, "dimension = 4", "must lie in [2, 3]"},
    {"dimension_as_text", "title", "dimension = \"2\"\ntitle", 1, "dimension = \"2\"",
     "must be a whole number, not a string"},
};

INSTANTIATE_TEST_SUITE_P(table, BadSceneIsRefused, ::testing::ValuesIn(scenes),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(BadScene, an_empty_file_lacks_an_end_time_and_content) {
  const auto messages = messages_of("");
  ASSERT_EQ(messages.size(), 2u) << ::testing::PrintToString(messages);
  EXPECT_NE(messages[0].find("time.end is missing"), std::string::npos) << messages[0];
  EXPECT_NE(messages[1].find("neither [fluid] nor [[body]]"), std::string::npos) << messages[1];
}

TEST(BadScene, all_problems_are_told_at_once_in_the_order_of_the_file) {
  auto text = testing::wedge_drop_with("density = 1000", "density = -1");
  text = testing::replaced(text, "end = 0.02", "end = -1");
  text = testing::replaced(text, "mass = 241", "mas = 241 ");
  const auto messages = messages_of(text);
  ASSERT_EQ(messages.size(), 4u) << ::testing::PrintToString(messages);
  EXPECT_TRUE(messages[0].starts_with("scene.toml:3: time.end = -1"));
  EXPECT_TRUE(messages[1].starts_with("scene.toml:10: fluid.density = -1"));
  EXPECT_TRUE(messages[2].starts_with("scene.toml:18: body.wedge.mass is missing"));
  EXPECT_TRUE(messages[3].starts_with("scene.toml:20: body.wedge.mas = 241: unknown key. Did you mean 'mass'?"));
}

TEST(BadScene, a_missing_file_is_named_with_the_cause) {
  const auto messages = testing::refusal_of([] { read_scene("/no/such/scene.toml"); });
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages[0].find("/no/such/scene.toml: cannot be read: No such file"), std::string::npos) << messages[0];
  EXPECT_THROW(read_scene("/"), SceneError);
}

TEST(BadScene, a_body_without_mass_must_be_solved_with_the_pressure) {
  auto text = testing::wedge_drop_with("mass = 241", "mass = 0");
  text = testing::replaced(text, "position = [0, 0.01]", "position = [0, -0.5]");
  text = testing::replaced(text, "[output]", "[coupling]\ninterface_term = \"none\"\n[output]");
  const auto messages = messages_of(text);
  ASSERT_EQ(messages.size(), 1u) << ::testing::PrintToString(messages);
  EXPECT_TRUE(
      messages[0].starts_with("scene.toml:20: body.wedge.mass = 0: a free body without mass needs "
                              "coupling.interface_term = \"rigid\""))
      << messages[0];
}

/// Seconds that an attempt takes.
template <class Work>
double seconds_of(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(BadScene, keys_of_endless_depth_are_refused_before_anything_follows_them) {
  std::string deep = "a";
  for (int i = 0; i < 50'000; ++i) deep += ".a";
  auto messages = messages_of(testing::wedge_drop + deep + " = 1\n");
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_TRUE(messages[0].starts_with("scene.toml:33: a key has more than 16 words between dots")) << messages[0];
  messages = messages_of(testing::wedge_drop, {deep + "=1"});
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_TRUE(messages[0].ends_with(": the key has 50001 words. Those of scenes have four at most.")) << messages[0];
}

TEST(BadScene, dots_in_texts_and_comments_are_no_keys) {
  const std::string dots(60'000, '.');
  const auto text = testing::wedge_drop_with("title = \"wedge\"", "title = \"a " + dots + " \\\" b\"  # " + dots);
  EXPECT_TRUE(messages_of(text).empty()) << ::testing::PrintToString(messages_of(text));
  EXPECT_TRUE(
      messages_of(testing::wedge_drop_with("title = \"wedge\"", "title = \"\"\"\n" + dots + "\n\"\"\"")).empty());
}

TEST(BadScene, an_outline_of_too_many_points_is_refused_at_once) {
  std::string points;
  for (int i = 0; i < 200'000; ++i)
    points += (i ? ", [" : "[") + std::to_string(0.2 * std::cos(i * 3.14159e-5)) + ", " +
              std::to_string(0.2 * std::sin(i * 3.14159e-5)) + "]";
  const auto text = testing::wedge_drop_with("{ type = \"wedge\", deadrise_deg = 30, breadth = 0.5 }",
                                             "{ type = \"polygon\", points = [" + points + "] }");
  std::vector<std::string> messages;
  EXPECT_LT(seconds_of([&] { messages = messages_of(text); }), 20);  // twenty times what an idle machine takes
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("must have 10000 rows at most, not 200000. Leave out points that are nearer to each other "
                             "than an element."),
            std::string::npos)
      << messages[0];
}

TEST(BadScene, devices_are_no_scenes) {
  const auto messages = testing::refusal_of([] { read_scene("/dev/zero"); });
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_TRUE(messages[0].starts_with("/dev/zero: cannot be read: it is a device.")) << messages[0];
}

const std::vector<Mistake> limits = {
    {"a_limit_as_a_number", "point = [0, 0]\n", "point = [0, 0]\nlimit = 20000\n", 33, "record.keel.limit = 20000",
     "must be a table, not a number. Write limit = {above = 20000} or limit = {below = 20000}."},
    {"a_limit_with_its_unit", "point = [0, 0]\n", "point = [0, 0]\nlimit = {above = \"20 kPa\"}\n", 33,
     "record.keel.limit.above = \"20 kPa\"", "must be a number (Pa), not a string"},
    {"a_limit_on_both_sides", "point = [0, 0]\n", "point = [0, 0]\nlimit = {above = 2, below = 1}\n", 33,
     "record.keel.limit.below = 1", "exclude each other"},
    {"a_limit_without_a_side", "point = [0, 0]\n", "point = [0, 0]\nlimit = {}\n", 33,
     "record.keel.limit.above is missing", "e.g. above = 20000"},
    {"a_limit_on_another_key", "point = [0, 0]\n", "point = [0, 0]\nlimit = {abvoe = 2, below = 1}\n", 33,
     "record.keel.limit.abvoe = 2: unknown key", "Did you mean 'above'?"},
    {"a_limit_of_a_curve", "kind = \"pressure\"\nname = \"keel\"\nbody = \"wedge\"\npoint = [0, 0]\n",
     "kind = \"surface_pressure\"\nwall = \"wedge\"\nlimit = {above = 1}\n", 31, "record[0].limit",
     "has no single number. Use it on a pressure"},
    {"a_limit_of_a_number_that_is_none", "[output]",
     "[[limit]]\nname = \"g\"\nquantity = \"wedge.g_cfc60\"\nabove = 12\n[output]", 28,
     "limit.g.quantity = \"wedge.g_cfc60\"", "is called 'wedge.g_cfc60'. Did you mean 'wedge.peak_g_cfc60'?"},
    {"a_limit_of_nobody", "[output]",
     "[[limit]]\nname = \"g\"\nquantity = \"payload_bay.peak_g\"\nabove = 12\n[output]", 28, "limit.g.quantity",
     "NAME is 'wedge' or 'keel'."},
    {"a_limit_of_a_number_in_another_unit", "[output]",
     "[[limit]]\nname = \"g\"\nquantity = \"wedge.peak_g\"\nunit = \"m/s^2\"\nabove = 12\n[output]", 29,
     "limit.g.unit = \"m/s^2\"", "wedge.peak_g is in g"},
    {"a_limit_of_no_expression", "[output]",
     "[[limit]]\nname = \"g\"\nquantity = \"wedge.peak_g +\"\nabove = 12\n[output]", 28, "limit.g.quantity",
     "Use the name of a number"},
    {"a_limit_of_a_constant", "[output]", "[[limit]]\nname = \"g\"\nquantity = \"2*3\"\nabove = 12\n[output]", 28,
     "limit.g.quantity", "holds no number of the run"},
    {"two_limits_of_one_name", "point = [0, 0]\n",
     "point = [0, 0]\nlimit = {above = 1}\n[[limit]]\nname = \"keel\"\nquantity = \"wedge.peak_g\"\nbelow = 12\n", 35,
     "limit.keel.name = \"keel\"", "there is a limit of this name already"},
};
INSTANTIATE_TEST_SUITE_P(Limits, BadSceneIsRefused, ::testing::ValuesIn(limits),
                         [](const auto& test) { return test.param.name; });

TEST(BadScene, a_word_without_its_unit_means_the_key_with_it) {
  const auto messages = messages_of(testing::wedge_drop_with("size = 0.005", "size = 0.005\npitch = 5"));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0], "scene.toml:25: body.wedge.pitch = 5: unknown key. Did you mean 'pitch_deg'?");
}

TEST(BadScene, an_absorber_needs_a_tank) {
  const auto messages = messages_of(
      testing::wedge_drop_with("[tank]\nmin = [-2, -1]\nmax = [2, 1]\n", "[fluid.absorber]\nwidth = 1\nrate = 1\n"));
  ASSERT_EQ(messages.size(), 1u) << ::testing::PrintToString(messages);
  EXPECT_TRUE(messages[0].starts_with("scene.toml:6: fluid.absorber: needs a [tank]")) << messages[0];
}

}  // namespace
}  // namespace splashdown::apps::bad_scene_test
