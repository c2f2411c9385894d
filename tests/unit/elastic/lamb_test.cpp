// Tone bursts that run along plates: phase and group velocities against the equations of Rayleigh and Lamb, for plates of any
// thickness, stiffness, density and Poisson's ratio; what a tension does to them.
#include "lamb.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "apps/quantity/signals.hpp"
#include "elastic/loads/patch.hpp"
#include "solids.hpp"

namespace splashdown::elastic::lamb_test {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

/// A plate, a tone, and how finely both are cut.
struct Tone {
  bool symmetric = false;  // S0, else A0
  double fd = 0.2;         // frequency times thickness over the speed of shear waves
  double thickness = 1, shear_modulus = 1, density = 1, poisson_ratio = 0.33;
  double elements = 10;  // a wavelength, by the mean edge
  double steps = 40;     // a period
  double cycles = 5;
  bool squares = false;  // a mesh of halved squares in place of an irregular one
};

/// Measured and by theory.
struct Speeds {
  double phase = 0, group = 0, phase_theory = 0, group_theory = 0;
  double phase_error() const { return phase / phase_theory - 1; }
  double group_error() const { return group / group_theory - 1; }
};

Plate plate_of(const Tone& tone) {
  const double shear = std::sqrt(tone.shear_modulus / tone.density), nu = tone.poisson_ratio;
  return {shear, shear * std::sqrt(2 * (1 - nu) / (1 - 2 * nu)), tone.thickness};
}

/// Two places that a packet passes before its echo comes back to the further one.
struct Line {
  double f, length, near, far, end;
  Line(const Tone& tone, const Plate& plate) : f(tone.fd * plate.shear / plate.thickness) {
    double slow = 1e300, fast = 0;
    for (const double part : {1 - 2 / tone.cycles, 1 - 1 / tone.cycles, 1., 1 + 1 / tone.cycles, 1 + 2 / tone.cycles}) {
      const double speed = group_velocity(plate, tone.symmetric, whole_turn * f * part);
      slow = std::min(slow, speed);
      fast = std::max(fast, speed);
    }
    const double wave = phase_velocity(plate, tone.symmetric, whole_turn * f) / f;
    near = 3 * wave;
    far = 8 * wave;
    end = (tone.cycles + 4) / f + far / slow;  // four periods for the tail: cut off it would leak into the tone
    length = 0.5 * (fast * end + far);
  }
};

/// Velocities at both places, the component that the mode has in the middle of the plate: displacements of a free plate keep an
/// offset, whose end in the record would look like a late part of all tones.
struct Record {
  std::vector<double> t, near, far;
};

Record run(const Tone& tone, const Line& line, const Solid<2>& solid, Dynamics dynamics, SolidState motion) {
  const int steps = static_cast<int>(std::ceil(line.end * line.f * tone.steps));
  const auto scheme = newmark(std::move(dynamics));
  EXPECT_TRUE(scheme->accelerate(motion).ok());
  const double middle = tone.thickness / 2;
  const auto near = *locate<2>(solid.mesh(), {line.near, middle}, 1e-6 * line.length),
             far = *locate<2>(solid.mesh(), {line.far, middle}, 1e-6 * line.length);
  const int axis = tone.symmetric ? 0 : 1;
  Record all;
  SolidState next;
  for (int k = 0; k <= steps; ++k) {
    all.t.push_back(motion.t);
    all.near.push_back(solid.value(motion.v, near)[axis]);
    all.far.push_back(solid.value(motion.v, far)[axis]);
    const auto status = scheme->step(motion, line.end / steps, next);
    EXPECT_TRUE(status.ok()) << status.cause;
    std::swap(motion, next);
  }
  return all;
}

Speeds speeds_of(const Record& all, const Line& line, double phase_theory, double group_theory) {
  const double w = whole_turn * line.f, way = line.far - line.near;
  const double late = quantity::lag(all.far, all.t, line.f) - quantity::lag(all.near, all.t, line.f);
  const double more = std::remainder(late - w * way / phase_theory, whole_turn);
  return {.phase = w * way / (w * way / phase_theory + more),
          .group = way / (quantity::delay(all.far, all.t, line.f) - quantity::delay(all.near, all.t, line.f)),
          .phase_theory = phase_theory,
          .group_theory = group_theory};
}

SolidMesh<2> plate_mesh(const Tone& tone, const Line& line) {
  const double size = phase_velocity(plate_of(tone), tone.symmetric, whole_turn * line.f) / line.f / tone.elements;
  constexpr double longest = 1.5;  // edge of a refined mesh, over the mean
  if (!tone.squares)
    return outline_mesh(polygon({{0, 0}, {line.length, 0}, {line.length, tone.thickness}, {0, tone.thickness}}),
                        longest * size);
  const auto parts = [&](double length) { return std::max(1, static_cast<int>(std::lround(length / size))); };
  return box_mesh<2>({line.length, tone.thickness}, {parts(line.length), parts(tone.thickness)});
}

/// On the whole left end: across the plate A0, along it S0.
Dynamics driven(const Solid<2>& solid, const Tone& tone, const Line& line, double traction) {
  const Vec<2> along = tone.symmetric ? Vec<2>::UnitX() : Vec<2>::UnitY();
  const Field force = patch_force<2>(
      solid.mesh(), [&](const Vec<2>& X) { return X.x() < 1e-9 * line.length; },
      [&](const Vec<2>&, const Vec<2>&) -> Vec<2> { return traction * along; });
  const ToneBurst burst{line.f, tone.cycles, 0};
  return {.system = &solid, .load = [force, burst](double t) -> Field { return burst.at(t) * force; }};
}

Speeds measured(const Tone& tone) {
  const auto plate = plate_of(tone);
  const Line line(tone, plate);
  const Isotropic moduli{2 * tone.shear_modulus * (1 + tone.poisson_ratio), tone.poisson_ratio};
  const Solid<2> solid(plate_mesh(tone, line), small_strain<2>(moduli), tone.density);
  const auto all = run(tone, line, solid, driven(solid, tone, line, 1e-3 * tone.shear_modulus), at_rest(solid));
  const double w = whole_turn * line.f;
  return speeds_of(all, line, phase_velocity(plate, tone.symmetric, w), group_velocity(plate, tone.symmetric, w));
}

TEST(Lamb, theory_is_that_of_the_published_table) {
  // Rayleigh-Lamb for nu = 0.33, solved to 1e-10: fd/cT, phase and group velocity of A0 and S0 over cT.
  const double table[][5] = {{0.05, 0.374563, 0.677224, 1.727158, 1.725996},
                             {0.2, 0.648983, 0.964100, 1.717996, 1.697693},
                             {0.4, 0.786143, 1.010795, 1.681070, 1.570709},
                             {0.6, 0.848580, 1.004177, 1.570714, 1.143209},
                             {0.7, 0.867444, 0.997656, 1.428200, 0.733034}};
  const auto plate = plate_of({});
  for (const auto& row : table)
    for (const bool symmetric : {false, true}) {
      const double w = whole_turn * row[0];
      EXPECT_NEAR(phase_velocity(plate, symmetric, w), row[symmetric ? 3 : 1], 2e-6);
      EXPECT_NEAR(group_velocity(plate, symmetric, w), row[symmetric ? 4 : 2], 2e-5);
    }
}

/// A fifth below the cut-off of A1 at 0.5, from where on the drive's near field reaches the first place. Any plate: thickness from 0.1 mm to 0.1 m, rubber to steel.
Tone member(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  Tone tone;
  tone.symmetric = seed % 2 == 0;
  tone.fd = tone.symmetric ? between(0.1, 0.6) : between(0.05, 0.4);
  tone.thickness = std::pow(10, between(-4, -1));
  tone.shear_modulus = std::pow(10, between(6, 11));
  tone.density = between(900, 8000);
  tone.poisson_ratio = between(0.1, 0.4);
  tone.cycles = 8;
  return tone;
}

/// A step errs by (w dt)^2/12 of the frequency, which a packet makes d ln(speed)/d ln(w) times as much: sixty steps keep both
/// below half a per cent for these.
void expect_theory(Tone tone) {
  tone.steps = 60;
  const auto speeds = measured(tone);
  SCOPED_TRACE(testing::Message() << (tone.symmetric ? "S0" : "A0") << " at fd/cT = " << tone.fd
                                  << ", nu = " << tone.poisson_ratio << ", thickness " << tone.thickness);
  EXPECT_LT(std::abs(speeds.phase_error()), 0.01);
  EXPECT_LT(std::abs(speeds.group_error()), 0.01);
}

class LambMember : public testing::TestWithParam<unsigned> {};
TEST_P(LambMember, runs_at_the_speeds_of_theory_with_ten_elements_a_wavelength) { expect_theory(member(GetParam())); }
INSTANTIATE_TEST_SUITE_P(Lamb, LambMember, testing::Range(1u, 5u));
INSTANTIATE_TEST_SUITE_P(LambNightly, LambMember, testing::Range(5u, 41u));

TEST(Lamb, errors_fall_with_the_fourth_power_of_elements_and_the_square_of_steps) {
  Tone tone{.squares = true};
  const auto error = [&](double elements, double steps) {
    tone.elements = elements;
    tone.steps = steps;
    return measured(tone).phase_error();
  };
  // Quadratic elements err by h^4 in the frequency; what a sensor adds within an element is h^3 of an amplitude.
  const double fine = error(10, 160);
  const double coarse = error(3, 160) - fine, middle = error(5, 160) - fine;
  EXPECT_GT(std::log(coarse / middle) / std::log(5. / 3), 3);
  EXPECT_NEAR(std::log2((error(10, 20) - fine) / (error(10, 40) - fine)), 2, 0.25);
}

/// A long wave of flexure in a plate that a tension T per width pulls: w^2 = (D k^4 + T k^2)/(rho d).
TEST(Lamb, a_tension_hastens_flexure_as_a_string_does) {
  Tone tone{.fd = 0.012, .shear_modulus = 1e9, .density = 1000, .steps = 60};
  const Line line(tone, plate_of(tone));
  const Isotropic moduli{2 * tone.shear_modulus * (1 + tone.poisson_ratio), tone.poisson_ratio};
  const double strain = 2e-3, stiff = moduli.young_modulus / (1 - std::pow(tone.poisson_ratio, 2));
  std::vector<double> speeds;
  const double w = whole_turn * line.f;
  const auto solve = [&](double tension) {  // k of D k^4 + T k^2 = rho d w^2, d = 1
    const double D = stiff / 12, q = tension / (2 * D);
    return std::sqrt(std::sqrt(q * q + tone.density * w * w / D) - q);
  };
  for (const double part : {0., 1.}) {
    Solid<2> solid(box_mesh<2>({line.length, 1}, {static_cast<int>(line.length / 1.5), 1}),
                   st_venant_kirchhoff<2>(moduli), tone.density);
    solid.clamp([&](const Vec<2>& X) { return X.x() > line.length * (1 - 1e-9); });
    const Field pull = patch_force<2>(
        solid.mesh(), [&](const Vec<2>& X) { return X.x() < 1e-9 * line.length; },
        [&](const Vec<2>&, const Vec<2>& normal) -> Vec<2> { return part * strain * stiff * normal; });
    auto dynamics = driven(solid, tone, line, 1e-7 * tone.shear_modulus);
    dynamics.load = [pull, burst = dynamics.load](double t) -> Field { return pull + burst(t); };
    auto start = at_rest(solid);
    start.u = equilibrium(solid, pull);
    const auto all = run(tone, line, solid, dynamics, start);
    speeds.push_back(speeds_of(all, line, w / solve(part * strain * stiff), 1).phase);
  }
  const double shift = speeds[1] / speeds[0] - 1, theory = solve(0) / solve(strain * stiff) - 1;
  EXPECT_GT(theory, 0.02);
  EXPECT_NEAR(shift / theory, 1, 0.1) << "theory " << theory;
}

TEST(Patch, pushes_with_its_traction_times_its_area_wherever_it_ends) {
  const auto mesh = box_mesh<2>({4, 1}, {4, 1});
  const auto on = [](const Vec<2>& X) { return X.y() > 1 - 1e-9 && X.x() > 0.7 && X.x() < 2.9; };
  EXPECT_NEAR(patch_area<2>(mesh, on), 2.2, 1. / 16) << "within half a part at either end";
  const auto force = patch_force<2>(mesh, on, [](const Vec<2>&, const Vec<2>& n) -> Vec<2> { return 3 * n; });
  const Vec<2> sum = force.reshaped(2, mesh.size()).rowwise().sum();
  EXPECT_NEAR(sum.x(), 0, 1e-12);
  EXPECT_NEAR(sum.y(), 3 * patch_area<2>(mesh, on), 1e-12);
}

template <int d>
void expect_balanced(const SolidMesh<d>& mesh, const Vec<d>& centre, double radius, double edge) {
  const Field force = stretch_force<d>(mesh, centre, radius);
  const auto nodes = force.reshaped(d, mesh.size());
  EXPECT_LT(nodes.rowwise().sum().norm(), 0.05 * edge) << "it pushes against itself";
  double outward = 0;
  for (int a = 0; a < mesh.size(); ++a) outward += nodes.col(a).dot(mesh.nodes.col(a) - centre);
  for (int a = 0; a < mesh.size(); ++a)
    if (mesh.nodes(d - 1, a) < centre[d - 1] - 1e-9) {
      EXPECT_EQ(nodes.col(a).norm(), 0) << "on its own side alone";
    }
  EXPECT_NEAR(outward / (edge * radius), 0.95, 0.05) << "a unit along the rim, over its outer tenth";
  EXPECT_LT(nodes.row(d - 1).norm(), 1e-12) << "along the boundary";
}

TEST(Patch, of_a_piezo_stretches_what_it_is_bonded_to) {
  expect_balanced<2>(box_mesh<2>({4, 1}, {8, 2}), {2, 1}, 1, 2);
  expect_balanced<2>(box_mesh<2>({4, 0.4}, {16, 1}), {2, 0.4}, 1, 2);  // its circle reaches the other face
  expect_balanced<3>(box_mesh<3>({4, 4, 1}, {8, 8, 1}), {2, 2, 1}, 1, whole_turn);
}

TEST(ToneBurst, is_n_cycles_in_hanns_window) {
  const ToneBurst burst{2, 5, 1};
  EXPECT_EQ(burst.at(0.99), 0);
  EXPECT_EQ(burst.at(3.51), 0);
  EXPECT_NEAR(burst.at(1 + 1.125), 0.5 * (1 - std::cos(whole_turn * 1.125 / 2.5)), 1e-12) << "a crest";
}

/// Linear solids keep their factor: the same motion as one that is assembled and factored anew in each step.
TEST(Steps, of_linear_solids_solve_the_equations_with_the_factor_that_is_kept) {
  const Tone tone{.elements = 4, .steps = 20};
  const Line line(tone, plate_of(tone));
  const Isotropic moduli{2.66, 0.33};
  const Solid<2> solid(plate_mesh(tone, line), small_strain<2>(moduli), 1);
  const auto scheme = generalised_alpha(driven(solid, tone, line, 1), 0.8);
  SolidState now = at_rest(solid), next;
  for (int k = 0; k < 40; ++k) {
    const double dt = (k % 3 == 0 ? 0.5 : 1) / (20 * line.f);  // also where steps change
    ASSERT_TRUE(scheme->step(now, dt, next).ok());
    std::swap(now, next);
  }
  // What generalised-alpha asks for at the end of its last step.
  const double af = 0.8 / 1.8, am = 0.6 / 1.8;
  const Field a = (1 - am) * now.a + am * next.a, u = (1 - af) * now.u + af * next.u;
  const auto load = scheme->dynamics().load;
  const Field left = solid.mass() * a + solid.internal_force(u), right = (1 - af) * load(now.t) + af * load(next.t);
  EXPECT_LT((left - right).norm(), 1e-9 * (solid.mass() * a).norm());
}

}  // namespace
}  // namespace splashdown::elastic::lamb_test
