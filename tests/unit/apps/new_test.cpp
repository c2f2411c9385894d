// Scenes that are written for hulls: they are read, start dry, meet the water in time, and stay in their tanks.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "apps/check/questions.hpp"
#include "apps/new/hull.hpp"
#include "apps/new/plan.hpp"
#include "apps/new/text.hpp"
#include "apps/new/units.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/outlook/outlook.hpp"
#include "apps/scene/read/read.hpp"
#include "core/surface/repair.hpp"
#include "core/surface/surface_file.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/hulls.hpp"

namespace splashdown::apps::new_test {
namespace {

using testing::ball;
using testing::block;
using testing::catamaran;
using testing::chine_float;
using testing::joined;
using testing::turned_over;
using testing::winged;
using testing::without_facets;

Surface<3> scaled(Surface<3> s, double factor) {
  s.vertices *= factor;
  return s;
}

double volume(const Surface<3>& s) { return rigid::mass_properties<3>(s).mass; }

bool says(const std::vector<Assumption>& told, const std::string& about, const std::string& part) {
  return std::ranges::any_of(
      told, [&](const Assumption& a) { return a.about == about && a.text.find(part) != std::string::npos; });
}

class NewScene : public ::testing::Test, protected ScratchFolder {
 protected:
  struct Made {
    NewHull hull;
    LandingPlan plan;
    std::string text;
    SceneFile file;
  };
  std::string file_of(const Surface<3>& hull, const std::string& name = "hull.stl") const {
    write_stl(path() / name, hull);
    return (path() / name).string();
  }
  template <int d = 3>
  Made made(const NewOptions& options) const {
    check_numbers(options);
    Made m{new_hull(options), {}, {}, {}};
    m.plan = landing_plan<d>(options, m.hull);
    std::string file;
    if (!options.hull.empty()) file = m.hull.write ? "written.stl" : options.hull;
    if (m.hull.write) write_stl(path() / file, *m.hull.write);
    m.text = scene_text<d>(options, m.hull, m.plan, file);
    m.file = read_scene_text(m.text, (path() / "scene.toml").string());
    return m;
  }
  std::string refusal(const NewOptions& options) const {
    try {
      options.plane ? (void)made<2>(options) : (void)made<3>(options);
    } catch (const NewError& error) {
      return error.what();
    }
    return "";
  }
  NewOptions of(const Surface<3>& hull, double mass, double sink) const {
    NewOptions options;
    options.hull = file_of(hull);
    options.mass = mass;
    options.sink = sink;
    return options;
  }
};

bool refuses(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// What each scene has to keep, whatever the hull.
template <int d>
void expect_a_landing(const SceneFile& file, const std::string& what) {
  SCOPED_TRACE(what);
  const auto& scene = file.scene;
  const auto& body = scene.bodies.front();
  const auto box = extents<d>(outline<d>(body)), tank = extents<d>(*scene.tank);
  const double length = box.sizes().maxCoeff(), lowest = box.min()[d - 1];
  EXPECT_GT(lowest, 0) << "starts dry";
  EXPECT_LE(lowest, 0.021 * length) << "and near the water, two digits of a fiftieth";
  EXPECT_TRUE(tank.contains(box));
  auto last = box;
  last.translate(scene.time.end * body.velocity[0] * rigid::Vec<d>::Unit(0));
  for (int k = 0; k < d - 1; ++k) {
    EXPECT_GT(last.min()[k], tank.min()[k]) << "stays inside at full speed";
    EXPECT_LT(last.max()[k], tank.max()[k]);
  }
  const auto look = outlook<d>(scene);
  ASSERT_TRUE(look.entry.has_value());
  EXPECT_LT(look.entry->time + look.entry->peak_time(), scene.time.end) << "the peak is in it";
  const auto asked = questions<d>(scene, predicted_cost<d>(scene));
  EXPECT_TRUE(asked.empty()) << ::testing::PrintToString(asked);
  EXPECT_EQ(scene.records.size(), 5u) << "a point, the map, three panels";
}

TEST_F(NewScene, random_hulls_in_random_units_become_scenes_without_questions) {
  std::mt19937 random(20261128);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  const auto one_of = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  for (int i = 0; i < 24; ++i) {
    const double length = std::exp(between(std::log(0.3), std::log(20.))), breadth = between(0.2, 0.6) * length,
                 height = between(0.12, 0.3) * length;
    const Surface<3> hulls[] = {
        winged(length, between(0.8, 1.6) * length, height), chine_float(length, breadth, height, between(5, 30)),
        catamaran(length, breadth, height, between(10, 30)), ball(length), block({length, breadth, height})};
    const int kind = one_of(5);
    const auto& hull = hulls[kind];
    const double unit = length_units()[static_cast<std::size_t>(one_of(5))].metres,
                 mass = between(60, 700) * volume(hull);
    const Vec<3> away(between(-9, 9), between(-9, 9), between(-9, 9));  // wherever the drawing's origin is
    auto options =
        of(scaled(testing::moved(hull, length * away), 1 / unit), mass, between(0.2, 1.2) * std::sqrt(9.81 * length));
    options.scale = unit;
    options.forward = one_of(2) * between(0, 2.5) * std::sqrt(9.81 * length);
    options.pitch = between(-5, 15);
    const auto m = made(options);
    expect_a_landing<3>(m.file, "member " + std::to_string(i) + " of kind " + std::to_string(kind) + "\n" + m.text);
    EXPECT_TRUE(m.plan.symmetric) << "hulls are drawn symmetric, member " << i;
  }
}

TEST_F(NewScene, shapes_become_scenes) {
  struct Row {
    const char* shape;
    bool plane;
  };
  for (const auto& [shape, plane] : std::initializer_list<Row>{{"capsule", false},
                                                               {"sphere", false},
                                                               {"box", false},
                                                               {"cone", false},
                                                               {"wedge", true},
                                                               {"circle", true},
                                                               {"box", true},
                                                               {"capsule", true}}) {
    NewOptions options;
    options.shape = shape;
    options.plane = plane;
    options.radius = 0.3;
    options.length = 0.5;
    options.breadth = 0.6;
    options.deadrise = 25;
    options.size = plane ? "0.8,0.3" : "0.8,0.4,0.3";
    options.mass = plane ? 40 : 10;
    options.sink = 3;
    options.pitch = 4;
    if (plane)
      expect_a_landing<2>(made<2>(options).file, shape);
    else
      expect_a_landing<3>(made<3>(options).file, shape);
  }
}

TEST_F(NewScene, a_unit_is_the_one_that_extent_and_mass_allow) {
  std::mt19937 random(7);
  for (const auto& unit : length_units()) {
    if (!unit.guessed) continue;
    for (int i = 0; i < 50; ++i) {
      const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
      const double length = std::exp(between(std::log(0.1), std::log(50.))),
                   volume = between(0.02, 0.5) * std::pow(length, 3);
      const auto guess =
          guessed_unit(length / unit.metres, volume / std::pow(unit.metres, 3), between(30, 1500) * volume);
      const auto& told = guess.told.front().text;
      const bool certain = told.find("NOT CERTAIN") == std::string::npos;
      if (certain)
        EXPECT_EQ(guess.scale, unit.metres) << told;
      else
        EXPECT_NE(told.find(unit.words), std::string::npos) << "all that are possible are named: " << told;
    }
  }
}

TEST_F(NewScene, where_a_file_has_its_origin_makes_no_difference) {
  const auto hull = chine_float(2, 0.6, 0.3, 20);
  const auto near = made(of(hull, 40, 2)), far = made(of(testing::moved(hull, {30, -7, -50}), 40, 2));
  EXPECT_EQ(near.file.scene.time.end, far.file.scene.time.end);
  const auto a = extents<3>(outline<3>(near.file.scene.bodies[0])),
             b = extents<3>(outline<3>(far.file.scene.bodies[0]));
  // Positions have five digits of the length.
  EXPECT_LT((a.min() - b.min()).norm(), 4e-5 * 2);
  EXPECT_TRUE(far.plan.symmetric);
}

TEST_F(NewScene, axes_of_the_file_are_turned) {
  const auto hull = chine_float(2, 0.6, 0.3, 20);
  auto drawn = hull;  // nose along -z, y up
  drawn.vertices.row(0) = -hull.vertices.row(1);
  drawn.vertices.row(1) = hull.vertices.row(2);
  drawn.vertices.row(2) = -hull.vertices.row(0);
  auto options = of(drawn, 40, 2);
  options.nose = "-z";
  options.up = "y";
  const auto turned = made(options), straight = made(of(hull, 40, 2));
  const auto a = outline<3>(turned.file.scene.bodies[0]), b = outline<3>(straight.file.scene.bodies[0]);
  EXPECT_LT((extents<3>(a).min() - extents<3>(b).min()).norm(), 1e-4);
  EXPECT_NEAR(mass_properties<3>(turned.file.scene.bodies[0]).centre.x(),
              mass_properties<3>(straight.file.scene.bodies[0]).centre.x(), 1e-9);
  EXPECT_TRUE(says(made(of(drawn, 40, 2)).plan.told, "axes", "QUESTION"));
}

TEST_F(NewScene, half_of_the_water_only_where_hull_mass_and_motion_are_symmetric) {
  const auto hull = chine_float(2, 0.6, 0.3, 20);
  EXPECT_TRUE(made(of(hull, 40, 2)).plan.symmetric);
  auto rolled = of(hull, 40, 2), heavy = of(hull, 40, 2);
  rolled.roll = 5;
  EXPECT_FALSE(made(rolled).plan.symmetric);
  heavy.centre = "0,0.05,0.1";
  const auto m = made(heavy);
  EXPECT_FALSE(m.plan.symmetric);
  EXPECT_TRUE(says(m.plan.told, "symmetry", "centre of mass")) << "and why";
  auto lopsided = hull;
  lopsided.vertices.col(2 * 5 + 1).y() += 0.05;
  EXPECT_FALSE(made(of(lopsided, 40, 2)).plan.symmetric);
}

TEST_F(NewScene, walls_follow_the_accuracy_that_is_asked) {
  auto rough = of(ball(0.5), 20, 3);
  rough.accuracy = 16;
  auto fine = rough;
  fine.accuracy = 2;
  const double far = made(fine).file.scene.tank->max.y(), near = made(rough).file.scene.tank->max.y();
  EXPECT_NEAR(far / near, 2, 0.1) << "images act with the cube of their distance; two digits";
}

TEST_F(NewScene, limits_and_points_are_records) {
  auto options = of(chine_float(2, 0.6, 0.3, 20), 40, 2);
  options.points = {"autopilot=0.4,0,0.1", "engine=-0.8,0,0.1"};
  options.limit_g = 12;
  options.limit_pressure = 20e3;
  const auto scene = made(options).file.scene;
  EXPECT_EQ(scene.limits.size(), 2u + 3u);
}

TEST_F(NewScene, mistakes_are_refused_with_a_cure) {
  const auto hull = chine_float(2, 0.6, 0.3, 20);
  const auto good = of(hull, 40, 2);
  const auto told = [&](const std::function<void(NewOptions&)>& spoil) {
    auto options = good;
    spoil(options);
    return refusal(options);
  };
  EXPECT_EQ(told([](auto&) {}), "");
  EXPECT_TRUE(refuses(told([](auto& o) { o.mass.reset(); }), "--mass is missing"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.mass = -1; }), "must be positive"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.mass = 1e9; }), "with no unit of the file"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.sink.reset(); }), "--sink is missing"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.sink = -3; }), "--sink 3"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.pitch = 120; }), "--pitch 120"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.units = "yd"; }), "mm, cm, in, ft or m"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.units = "mm", o.scale = 1; }), "same thing"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.up = "w"; }), "--up w"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.up = "x"; }), "along one axis"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.centre = "0,1"; }), "--centre 0,1: must be 3 numbers"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.points = {"0,0,0"}; }), "NAME=x,y,z"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.points = {"nose=0,0,0"}; }), "a panel has this name"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.points = {"a=0,0,0", "a=0,0,0"}; }), "another point has this name"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.end = 1e-4; }), "nothing is wetted before"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.plane = true; }), "hulls in space"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.shape = "sphere"; }), "there is one hull"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.hull.clear(); }), "there is no hull"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.hull.clear(), o.shape = "disc"; }), "capsule, sphere, box, cone"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.hull.clear(), o.shape = "cone", o.radius = 1; }), "needs --deadrise"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.radius = 1; }), "--radius: is for shapes"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.hull.clear(), o.shape = "sphere", o.radius = 1, o.units = "mm"; }),
                      "--units: is for hulls from files"));
  EXPECT_TRUE(refuses(told([](auto& o) { o.hull = "nowhere.stl"; }), "nowhere.stl"));
  EXPECT_TRUE(says(made(of(hull, 1.5e3 * volume(hull), 2)).plan.told, "mass", "heavier than the water"));
}

class Repair : public NewScene {
 protected:
  RepairedSurface mended(const Surface<3>& hull) const {
    auto repaired = repaired_surface(file_of(hull));
    write_stl(path() / "mended.stl", repaired.surface);
    const auto read = read_surface_file(path() / "mended.stl").surface;  // the judge
    EXPECT_NEAR(volume(read), volume(repaired.surface), 1e-9 * volume(read));
    return repaired;
  }
};

TEST_F(Repair, leaves_a_good_hull_alone) { EXPECT_TRUE(mended(winged(1.2, 1.6, 0.15)).done.empty()); }

TEST_F(Repair, is_named_where_it_cures) {
  const auto hull = chine_float(2, 0.6, 0.3, 20);
  for (const auto& bad :
       {turned_over(hull), without_facets(hull, 3, 1), joined(hull, block({0.2, 2, 0.1}, {0, 0, 0.2}))}) {
    auto options = of(bad, 40, 2);
    EXPECT_TRUE(refuses(refusal(options), "--repair"));
    options.repair = true;
    const auto m = made(options);
    EXPECT_TRUE(m.hull.write.has_value());
    EXPECT_TRUE(says(m.plan.told, "repair", "")) << "never silent";
    expect_a_landing<3>(m.file, m.text);
  }
}

TEST_F(Repair, turns_a_hull_the_right_way_out) {
  const auto hull = winged(1.2, 1.6, 0.15);
  EXPECT_NEAR(volume(mended(turned_over(hull)).surface), volume(hull), 1e-9 * volume(hull));
}

/// A tube that turns back over itself: its rim crosses its own walls.
TEST_F(Repair, wraps_a_part_that_crosses_itself) {
  const auto square = [](double half) {
    return testing::Section{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  };
  auto tube = testing::loft({0, 1, 0.4}, {square(0.1), square(0.1), square(0.2)});
  const auto wrap = mended(tube);
  EXPECT_TRUE(wrap.done.front().starts_with("wrapped it")) << wrap.done.front();
  // The tube as far as the lid at 0.4 m, and the frustum around what is left of it, which is open at its end.
  const double inside = 0.4 * 0.2 * 0.2 + 0.6 * ((0.2 * 0.2 + 0.4 * 0.4 + 0.2 * 0.4) / 3 - 0.2 * 0.2);
  EXPECT_GT(volume(wrap.surface), inside) << "it lies outside";
  EXPECT_LT(volume(wrap.surface), 1.05 * inside);
}

TEST_F(Repair, puts_flat_lids_where_they_were) {
  const Vec<3> size(1, 0.5, 0.2);
  for (int f = 0; f < 16; f += 2) {
    const auto closed = mended(without_facets(block(size), f, 2));
    EXPECT_NEAR(volume(closed.surface), size.prod(), 1e-9 * size.prod()) << "facets " << f;
    EXPECT_EQ(closed.done.size(), f % 4 == 0 ? 1u : 2u) << "a side, or a triangle of both ends";
  }
}

TEST_F(Repair, holes_of_random_hulls_are_filled_within_their_reach) {
  std::mt19937 random(3);
  const auto hull = winged(1.2, 1.6, 0.15);
  for (int i = 0; i < 20; ++i) {
    const int count = std::uniform_int_distribution<int>(1, 6)(random);
    const int first = std::uniform_int_distribution<int>(0, static_cast<int>(hull.facets.cols()) - count)(random);
    const auto closed = mended(without_facets(hull, first, count));
    EXPECT_NEAR(volume(closed.surface), volume(hull), 0.02 * volume(hull)) << "six of 840 facets";
  }
}

TEST_F(Repair, unites_parts_that_cross_and_drops_what_is_inside) {
  const auto a = block({1, 0.4, 0.2}), b = block({0.2, 1, 0.1}), inner = block({0.1, 0.1, 0.02}, {0.3, 0, 0});
  const double shared = 0.2 * 0.4 * 0.1, whole = 1 * 0.4 * 0.2 + 0.2 * 1 * 0.1 - shared;
  const auto one = mended(joined(joined(a, b), inner));
  EXPECT_NEAR(volume(one.surface), whole, 1e-9 * whole);
  EXPECT_EQ(one.done.size(), 2u) << ::testing::PrintToString(one.done);
  // A bridge between two that do not meet.
  const auto left = block({1, 0.2, 0.2}, {0, -0.4, 0}), right = block({1, 0.2, 0.2}, {0, 0.4, 0}),
             deck = block({0.4, 0.9, 0.1});
  const auto cat = mended(joined(joined(left, right), deck));
  const double sum = 2 * 0.04 + 0.4 * 0.9 * 0.1 - 2 * 0.4 * 0.15 * 0.1;
  EXPECT_NEAR(volume(cat.surface), sum, 1e-9 * sum);
}

TEST_F(Repair, refuses_what_has_no_thickness) {
  auto plate = block({1, 0.5, 0.2});
  plate.vertices.row(2).setZero();
  auto options = of(plate, 4, 2);
  EXPECT_FALSE(refusal(options).empty());
  options.repair = true;
  EXPECT_TRUE(refuses(refusal(options), "thickness")) << refusal(options);
}

}  // namespace
}  // namespace splashdown::apps::new_test
