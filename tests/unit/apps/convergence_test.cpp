// Laws of bands: fits and odds of manufactured series.
#include "apps/price/convergence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

namespace splashdown::apps::convergence_test {
namespace {

const std::vector<double> usual = {2, std::sqrt(2.), 1, std::sqrt(0.5)};  // element sizes of the usual ladder

template <class Value>
std::vector<MeshValue> series(const Value& value, const std::vector<double>& sizes = usual) {
  std::vector<MeshValue> values;
  for (const double h : sizes) values.push_back({h, value(h)});
  return values;
}

Convergence fit(std::span<const MeshValue> values) { return Convergence::of(values).value(); }

class Order : public ::testing::TestWithParam<double> {};

TEST_P(Order, of_an_exact_series_is_found_with_its_limit_and_the_band_is_a_quarter_wider_than_the_error) {
  const double p = GetParam();
  const auto values = series([p](double h) { return 7 - 0.3 * std::pow(h, p); });
  const auto found = fit(values);
  ASSERT_TRUE(found.order()) << found.refusal();
  const double digits = 1e-6;  // a search to 1e-9 in p, through the condition of the fit, about 1e2 here
  EXPECT_NEAR(*found.order(), p, digits);
  EXPECT_NEAR(found.extrapolated(), 7, digits);
  EXPECT_NEAR(found.band(values.back()), 1.25 * 0.3 * std::pow(values.back().h, p), digits);
}
INSTANTIATE_TEST_SUITE_P(orders, Order, ::testing::Values(0.6, 1., 1.5, 2.));

TEST(Convergence, of_a_higher_order_is_refused_and_bounded_by_one_that_the_method_has) {
  const auto values = series([](double h) { return 1 + 0.1 * h * h * h; });
  const auto found = fit(values);
  EXPECT_FALSE(found.order());
  EXPECT_NE(found.refusal().find("faster than with order 2.1"), std::string::npos) << found.refusal();
  EXPECT_EQ(found.form(), Form::second_order);
  EXPECT_GE(found.band(values.back()), std::abs(values.back().value - 1));
}

TEST(Convergence, of_a_low_order_is_refused_and_said) {
  const auto found = fit(series([](double h) { return 1 + 0.1 * std::log(h); }));
  EXPECT_FALSE(found.order());
  EXPECT_NE(found.refusal().find("below 0.5"), std::string::npos) << found.refusal();
}

TEST(Convergence, of_an_oscillating_series_has_a_band_that_holds_all_of_it) {
  int k = 0;
  const auto values = series([&](double) { return 5 + (k++ % 2 == 0 ? 0.2 : -0.2); });
  const auto found = fit(values);
  EXPECT_TRUE(found.scattered());
  for (const auto& value : values) EXPECT_GE(found.band(value), 0.2);
}

TEST(Convergence, of_a_constant_has_no_band) {
  const auto found = fit(series([](double) { return 4.; }));
  EXPECT_FALSE(found.order());
  EXPECT_EQ(found.band(1), 0);
  EXPECT_NEAR(found.extrapolated(), 4, 1e-12);  // round-off
}

TEST(Convergence, of_three_meshes_has_a_band_and_no_order) {
  const auto values = series([](double h) { return 1 + h; }, {2, 1, 0.5});
  const auto found = fit(values);
  EXPECT_FALSE(found.order());
  const double roundoff = 1e-12;
  EXPECT_NEAR(found.band(values.back()), 3 * 0.5, roundoff);
}

TEST(Convergence, needs_three_sizes_and_numbers) {
  const auto line = [](double h) { return 1 + h; };
  EXPECT_FALSE(Convergence::of(series(line, {2, 1})));
  EXPECT_FALSE(Convergence::of(series(line, {2, 1, 1.02, 0.98})));  // replicates are one
  EXPECT_FALSE(Convergence::of(series([](double h) { return h < 1 ? NAN : h; })));
}

TEST(Convergence, promises_no_less_on_coarser_meshes) {
  for (const double bend : {-0.3, -0.1, 0.1, 0.3}) {
    const auto found = fit(series([=](double h) { return 2 + 0.4 * h + bend * h * h; }));
    for (double h = 0.1; h < 4; h *= 1.1) EXPECT_LE(found.band(h), found.band(1.1 * h) * (1 + 1e-12)) << bend;
  }
}

/// Meshes sqrt(2) apart with two replicates beside the last but one.
std::vector<double> ladder(int meshes) {
  std::vector<double> sizes;
  for (int k = 0; k < meshes; ++k) sizes.push_back(std::pow(0.5, 0.5 * k));
  const double replicated = sizes[sizes.size() - 2];
  sizes.insert(sizes.end() - 1, {replicated / 0.98, replicated / 1.02});
  return sizes;
}

/// Bands of series with noise, on such ladders; the truth is 1.
struct NoisyBands {
  int within = 0;
  std::vector<double> bands;

  /// Noise is that of the finest mesh and grows with a power of the size.
  template <class Error>
  NoisyBands(const Error& error, double noise, int meshes, int tries, double growth = 0) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, noise);
    const auto sizes = ladder(meshes);
    const auto noise_at = [&](double h) { return std::pow(h / sizes.back(), growth) * normal(random); };
    for (int i = 0; i < tries; ++i) {
      const auto values = series([&](double h) { return 1 + error(h) + noise_at(h); }, sizes);
      bands.push_back(fit(values).band(values.back()));
      within += std::abs(values.back().value - 1) <= bands.back() ? 1 : 0;
    }
  }
  double share() const { return within / static_cast<double>(bands.size()); }
  double median() {
    const auto middle = bands.begin() + static_cast<std::ptrdiff_t>(bands.size() / 2);
    std::ranges::nth_element(bands, middle);
    return *middle;
  }
};

TEST(Convergence, of_noisy_series_holds_the_true_value_in_nineteen_of_twenty) {
  for (const double p : {0.8, 1., 2.})
    for (const int meshes : {4, 8})
      for (const double noise : {0.05, 0.3, 1., 3.}) {  // of the finest mesh's error
        const auto power = [p](double h) { return std::pow(h, p); };
        const double finest = power(std::pow(0.5, 0.5 * (meshes - 1)));
        EXPECT_GE(NoisyBands(power, noise * finest, meshes, 100).share(), 0.95) << p << ' ' << noise << ' ' << meshes;
      }
}

TEST(Convergence, of_mere_noise_holds_it_too_and_more_meshes_do_not_widen_the_band) {
  double before = std::numeric_limits<double>::infinity();
  for (const int meshes : {4, 6, 9}) {
    NoisyBands noise([](double) { return 0.; }, 1, meshes, 100);
    EXPECT_GE(noise.share(), 0.95) << meshes;
    const double median = noise.median();
    EXPECT_LT(median, before) << meshes;
    before = median;
  }
}

TEST(Convergence, of_noise_that_grows_with_the_elements_holds_it_too) {
  for (const double p : {1., 2.})
    for (const double noise : {0.05, 0.3, 1.}) {
      const auto power = [p](double h) { return std::pow(h, p); };
      const double finest = ladder(8).back();
      EXPECT_GE(NoisyBands(power, noise * power(finest), 8, 100, 1).share(), 0.95) << p << ' ' << noise;
    }
}

// A payload's peak on seven meshes, of which the coarse ones have a few elements across the hull: they may be far off, and the limit
// is where the fine ones go.
TEST(Convergence, coarse_meshes_that_are_far_off_do_not_rule_the_band) {
  const std::vector<MeshValue> peaks{{1 / 0.1768, 8.072}, {1 / 0.25, 9.584}, {1 / 0.3536, 12.033}, {1 / 0.5, 6.567},
                                     {1 / 0.7071, 5.124}, {1., 4.693},       {1 / 1.806, 4.340}};
  const std::span<const MeshValue> all(peaks);
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t meshes = 4; meshes <= peaks.size(); ++meshes) {
    const double band = fit(all.first(meshes)).band(peaks[meshes - 1]) / peaks[meshes - 1].value;
    EXPECT_LT(band, 0.8 * before) << meshes;
    before = band;
  }
}

TEST(Convergence, far_too_coarse_meshes_change_nothing) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 0.01);
  const auto fine = series([&](double h) { return 1 + 0.1 * h + normal(random); });
  auto all = fine;
  for (const double h : {6., 9., 12.}) all.push_back({h, 17 + h * h});  // more than eight times the finest, 0.71
  EXPECT_EQ(fit(all).band(fine.back()), fit(fine).band(fine.back()));
  EXPECT_EQ(fit(all).extrapolated(), fit(fine).extrapolated());
}

TEST(Convergence, scatter_that_hides_the_order_is_a_band_of_its_own_size) {
  // Peak accelerations of one scene, refined five times; the limit is near the last ones.
  const std::vector<MeshValue> values = {
      {1 / 0.707, 23.7}, {1, 23.7}, {1 / 1.41, 23.0}, {1. / 2, 22.2}, {1 / 2.5, 22.3}};
  const auto found = fit(values);
  EXPECT_GT(found.band(values.back()), 23.7 - 22.3);  // what they differ by
  EXPECT_LT(found.band(values.back()), 2 * (23.7 - 22.3));
}

/// Runs on each size whose means go by `mean`, with this noise.
template <class Mean>
std::vector<MeshValue> repeated(const Mean& mean, const std::vector<double>& sizes, int runs, double noise) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, noise);
  std::vector<MeshValue> values;
  for (const double h : sizes)
    for (int k = 0; k < runs; ++k) {
      const double own = h * (1 + 0.06 * (k + 0.5) / runs - 0.03);  // the sizes of replicates
      values.push_back({own, mean(h) + normal(random)});
    }
  return values;
}

TEST(Convergence, sizes_that_repeated_runs_show_to_follow_no_order_do_not_count) {
  const auto law = [](double h) { return h > 2.5 ? 2. : 1 + 0.1 * h; };
  const auto fine = fit(repeated(law, usual, 6, 0.005));
  const auto all = fit(repeated(law, {4, 2 * std::sqrt(2.), 2, std::sqrt(2.), 1, std::sqrt(0.5)}, 6, 0.005));
  const MeshValue finest{usual.back(), law(usual.back())};
  // Other draws of the same noise, whose standard deviation six runs on four sizes know to a sixth.
  EXPECT_NEAR(all.band(finest) / fine.band(finest), 1, 0.5);
}

TEST(Convergence, of_means_that_follow_no_order_is_not_narrowed_by_further_runs) {
  const auto zigzag = [](double h) { return h > 1.2 && h < 1.8 ? 1.05 : 1.; };
  const MeshValue finest{usual.back(), 1};
  const auto few = fit(repeated(zigzag, usual, 4, 0.003)), many = fit(repeated(zigzag, usual, 40, 0.003));
  EXPECT_GT(few.band(finest), 0.05);
  EXPECT_GT(many.band(finest), 0.05);
  const std::vector<RunsOfSize> more = {{2, 40}, {1, 40}};
  EXPECT_FALSE(many.band_of_mean(more, 1)) << "no number of runs is a plan";
}

TEST(Convergence, of_means_narrows_with_the_root_of_the_runs) {
  const auto law = [](double h) { return 1 + 0.02 * h; };
  const MeshValue finest{usual.back(), law(usual.back())};
  const double few = fit(repeated(law, usual, 8, 0.05)).band(finest),
               many = fit(repeated(law, usual, 72, 0.05)).band(finest);
  EXPECT_LT(many, few / 1.5);  // a third, but for the bias that both contain
}

TEST(BayesianExtrapolation, of_one_order_are_those_of_the_straight_line) {
  // Sizes so near each other that both laws of noise are one, to 0.2 %; a straight line's value at 0 lies within
  // t s sqrt(1/n + mean^2/sum (h - mean)^2) of its least-squares value, t Student's with two degrees of freedom.
  const std::vector<MeshValue> values = {{1, 2.1}, {1.001, 2.9}, {1.002, 4.2}, {1.003, 4.8}};
  const double at_zero = 3.5 - 940 * 1.0015, s = std::sqrt(0.082 / 2), spread = 5e-6;
  const double error = s * std::sqrt(0.25 + 1.0015 * 1.0015 / spread);
  const BayesianExtrapolation odds(values, 1, 1);
  EXPECT_NEAR(odds.within(at_zero, 0.95) / (4.3027 * error), 1, 0.01);
  EXPECT_NEAR(odds.within(at_zero, 0.5) / (0.8165 * error), 1, 0.01);
}

TEST(BayesianExtrapolation, of_a_value_still_to_be_measured_never_narrow_on_coarser_meshes) {
  const BayesianExtrapolation odds(series([](double h) { return 1 + 0.1 * h + 0.02 * std::sin(40 * h); }, ladder(5)),
                                   0.5, 2);
  for (double h = 0.1; h < 4; h *= 1.1)
    EXPECT_LE(odds.within_of_one_at(h, 0.95), odds.within_of_one_at(1.1 * h, 0.95) * (1 + 1e-5));  // of the root search
}

}  // namespace
}  // namespace splashdown::apps::convergence_test
