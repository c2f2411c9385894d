// Laws that every accelerator obeys, and the passes it takes on one table of maps.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <sstream>

#include "coupling/accelerators/quasi_newton.hpp"
#include "tests/unit/coupling/maps.hpp"

namespace splashdown::coupling::accelerator_test {
namespace {

using namespace maps;

struct Scheme {
  const char* name;
  std::function<std::unique_ptr<Accelerator>()> make;
};
void PrintTo(const Scheme& scheme, std::ostream* out) { *out << scheme.name; }

class Accelerators : public testing::TestWithParam<Scheme> {};

const Scheme schemes[] = {{"constant", [] { return std::make_unique<ConstantRelaxation>(0.5); }},
                          {"aitken", [] { return std::make_unique<Aitken>(0.5); }},
                          {"anderson", [] { return std::make_unique<Anderson>(0.5); }},
                          {"broyden", [] { return std::make_unique<Broyden>(0.5); }},
                          {"iqn_ils", [] { return std::make_unique<IqnIls>(0.5); }},
                          {"iqn_ils", [] { return std::make_unique<IqnIls>(0.5, 3); }},
                          {"probe", [] { return std::make_unique<Probe>(0.5); }}};

INSTANTIATE_TEST_SUITE_P(All, Accelerators, testing::ValuesIn(schemes));

TEST_P(Accelerators, have_the_name_a_scene_gives_them) { EXPECT_EQ(GetParam().make()->name(), GetParam().name); }

TEST_P(Accelerators, give_the_same_bits_twice) {
  for (const auto& map : maps::all()) {
    Vector once, twice;
    const auto a = GetParam().make(), b = GetParam().make();
    EXPECT_EQ(passes(*a, map, &once), passes(*b, map, &twice)) << map.name;
    EXPECT_EQ(once, twice) << map.name;
  }
}

TEST_P(Accelerators, an_attempt_that_is_not_committed_leaves_no_trace) {
  // Neither its stale residuals, nor values that are not finite.
  const auto map = affine("", Eigen::Vector3d(0.5, 3, 20), modes(3, true));
  const auto fresh = GetParam().make(), used = GetParam().make();
  passes(*used, map);
  used->begin_step();
  used->next(Vector::Zero(3), Vector::Constant(3, nan));
  used->next(Vector::Zero(3), Vector::Ones(3));
  Vector a, b;
  EXPECT_EQ(passes(*used, map, &a), passes(*fresh, map, &b));
  EXPECT_EQ(a, b);
}

TEST_P(Accelerators, leave_a_solution_alone_from_the_first_step_on) {
  const auto scheme = GetParam().make();
  for (int step = 0; step < 2; ++step) {
    scheme->begin_step();
    for (int k = 0; k < 3; ++k) EXPECT_EQ(scheme->next(Vector::Ones(2), Vector::Ones(2)), Vector(Vector::Ones(2)));
    scheme->commit_step();
  }
}

TEST_P(Accelerators, equal_residuals_and_equal_iterates_fall_back_on_relaxation) {
  const auto scheme = GetParam().make();
  scheme->begin_step();
  Vector x = Vector::Zero(2);
  for (int k = 0; k < 4; ++k) x = scheme->next(x, x + Vector::Ones(2));
  EXPECT_EQ(x, Vector(Vector::Constant(2, 4 * 0.5))) << "no slope to learn: four steps of the factor";
  scheme->begin_step();
  for (int k = 0; k < 4; ++k) x = scheme->next(Vector::Zero(2), Vector::Ones(2));
  EXPECT_EQ(x, Vector(Vector::Constant(2, 0.5)));
}

TEST_P(Accelerators, recover_from_a_pass_that_was_not_finite_or_too_large_to_square) {
  for (double wild : {nan, std::numeric_limits<double>::infinity(), 1e200}) {
    const auto scheme = GetParam().make();
    scheme->begin_step();
    scheme->next(Vector::Zero(2), Vector::Constant(2, wild));
    EXPECT_TRUE(scheme->next(Vector::Zero(2), Vector::Ones(2)).allFinite()) << wild;
    EXPECT_TRUE(scheme->next(Vector::Constant(2, 0.5), Vector::Constant(2, 0.7)).allFinite()) << wild;
  }
}

TEST_P(Accelerators, checkpoints_continue_bit_for_bit) {
  const auto map = affine("", Eigen::Vector3d(0.5, 3, 20), modes(3, false));
  const auto straight = GetParam().make(), resumed = GetParam().make();
  passes(*straight, map);
  straight->commit_step();
  std::stringstream file;
  straight->save(file);
  resumed->load(file);
  Vector a, b;
  EXPECT_EQ(passes(*straight, map, &a, 0.3), passes(*resumed, map, &b, 0.3));
  EXPECT_EQ(a, b);
}

// Least and most passes that theory gives on a map of the table.
//
// At least n + 1 (n <= 3 modes; three of them if there are more): x_k lies in the Krylov space of k - 1 passes, and the
// residual is a polynomial of that degree in the slopes, all of which differ.
struct Bounds {
  int least, most;
};
using Theory = std::function<Bounds(const Map&)>;

/// The factor that suits the extreme modes best, and the error it leaves a pass.
double best_factor(const Map& map) { return 2 / (2 + map.mu.minCoeff() + map.mu.maxCoeff()); }
double left_by_best_factor(const Map& map) {
  const double left = (map.mu.maxCoeff() - map.mu.minCoeff()) / (2 + map.mu.minCoeff() + map.mu.maxCoeff());
  return left + best_factor(map) * map.bend;
}
int passes_of_best_factor(const Map& map) {
  if (map.size() == 1) return 2;
  return 1 + static_cast<int>(std::ceil(std::log(1e-9 / map.condition) / std::log(left_by_best_factor(map))));
}
int least(const Map& map) { return std::min(map.size(), 3) + 1; }

// Least squares: a pass to begin, n differences to know the slope, one pass to confirm. Bent, each further pass gains
// about the two digits by which the slope is wrong, of nine.
Bounds least_squares(const Map& map) {
  const int most = map.size() + 2;
  return map.affine() ? Bounds{map.size() <= 3 ? most : least(map), most} : Bounds{most + 1, most + 5};
}

TEST(Passes, are_those_of_theory) {
  for (const auto& map : maps::all()) {
    const int n = map.size();
    ConstantRelaxation constant(best_factor(map));
    Aitken aitken(0.5);
    Anderson anderson(0.5);
    Broyden broyden(0.5);
    IqnIls iqn_ils(0.5);
    Probe probe(1);
    const auto within = [&](Accelerator& scheme, const Bounds& bounds) {
      const int count = passes(scheme, map);
      EXPECT_GE(count, bounds.least) << scheme.name() << ", " << map.name;
      EXPECT_LE(count, bounds.most) << scheme.name() << ", " << map.name;
    };
    within(constant, {n == 1 ? 2 : least(map), passes_of_best_factor(map)});
    // One slope: two residuals know it, the third pass is exact. More: it is the method of Barzilai and Borwein (1988),
    // which converges on symmetric maps (Dai, Liao 2002) without a bound; worth having if it beats the best factor.
    within(aitken, n == 1 ? Bounds{3, 3} : Bounds{least(map), passes_of_best_factor(map)});
    within(anderson, least_squares(map));
    within(iqn_ils, least_squares(map));
    // It knows the slope: exact in the second pass; bent, each one leaves bend / (1 + least mu) of the error, of 1e-9.
    const double left = map.bend / (1 + map.mu.minCoeff());
    const auto further = [&] { return static_cast<int>(std::ceil(std::log(1e-9) / std::log(left))); };
    within(probe, map.affine() ? Bounds{2, 2} : Bounds{3, 2 + further()});
    // Gay 1979: 2 n steps and a pass to confirm, the first of which has none behind it.
    within(broyden, n == 1 ? Bounds{3, 3} : Bounds{least(map), 2 * n + 1 + (map.affine() ? 0 : 5)});
  }
}

TEST_P(Accelerators, a_residual_that_never_shrinks_gives_finite_iterates) {
  const auto scheme = GetParam().make();
  scheme->begin_step();
  Vector x = Vector::Zero(2);
  for (int k = 0; k < 200; ++k) {
    x = scheme->next(x, x + Eigen::Vector2d(std::cos(k), std::sin(k)));
    ASSERT_TRUE(x.allFinite()) << k;
  }
}

}  // namespace
}  // namespace splashdown::coupling::accelerator_test
