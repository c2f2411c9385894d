#include "fluid/pfem/pressure/interface_laplacian.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "fluid/pfem/geometry.hpp"

namespace splashdown::fluid::interface_laplacian_test {
namespace {

constexpr double eps = 1e-12;

/// A wetted wall: strips of it that hang together nowhere, of squares (lines in the plane); nodes on their rims are contact lines.
template <int d>
struct Strips {
  Nodes<d> nodes;
  Mesh<d> mesh;
  std::vector<int> unknown;
  std::vector<std::size_t> first_unknown;  // of each strip
  double measure = 0;

  int unknowns = 0;

  int node(const Vec<d>& x, bool rim) {
    nodes.x.push_back(x);
    unknown.push_back(rim ? -1 : unknowns++);
    return static_cast<int>(nodes.x.size()) - 1;
  }

  void add(double from, int count, double h) {
    first_unknown.push_back(static_cast<std::size_t>(unknowns));
    const auto facet = [&](const std::array<int, d>& corners) {
      mesh.boundary.push_back({corners, 0});
      measure += area_vector_of<d>(mesh.boundary.back(), nodes.x).norm();
    };
    if constexpr (d == 2) {
      for (int i = 0; i <= count; ++i) {
        const int n = node({from + i * h, 0}, i == 0 || i == count);
        if (i > 0) facet({n - 1, n});
      }
    } else {
      const int wide = 2;
      for (int i = 0; i <= count; ++i)
        for (int j = 0; j <= wide; ++j) node({from + i * h, j * h, 0}, i == 0 || i == count || j == 0 || j == wide);
      const int base = static_cast<int>(nodes.x.size()) - (count + 1) * (wide + 1);
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < wide; ++j) {
          const int a = base + i * (wide + 1) + j, b = a + wide + 1;
          facet({a, b, b + 1});
          facet({a, b + 1, a + 1});
        }
    }
  }

  InterfaceLaplacian<d> laplacian() const {
    InterfaceLaplacian<d> out;
    out.build(nodes, mesh, unknown, std::vector<InterfaceOperator>{{.laplacian = 1, .robin = 0}});
    return out;
  }
};

double sum_of_measures(std::span<const InterfacePiece> pieces) {
  return std::accumulate(pieces.begin(), pieces.end(), 0.0, [](double sum, const auto& p) { return sum + p.measure; });
}

template <class Dimension>
class InterfacePieces : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(InterfacePieces, Dimensions);

TYPED_TEST(InterfacePieces, share_the_wetted_hull) {
  constexpr int d = TypeParam::value;
  Strips<d> hull;
  hull.add(0, 60, 0.01);
  const auto pieces = hull.laplacian();
  EXPECT_EQ(pieces.pieces().size(), 2u * freedoms<d>);
  EXPECT_NEAR(sum_of_measures(pieces.pieces()), hull.measure, eps);
}

// By the Laplacian alone a strip of length l would be as stiff as 1/l^2 a measure, and the water behind it answers the less the
// shorter it is: hundreds of passes.
TYPED_TEST(InterfacePieces, what_a_jet_wets_beside_is_one_more_and_no_stiffer_the_smaller_it_is) {
  constexpr int d = TypeParam::value;
  Strips<d> alone;
  alone.add(0, 60, 0.01);
  const auto as_if = alone.laplacian();
  const std::size_t count = as_if.pieces().size();
  std::vector<double> stiffness;  // phi^T K phi over measure and mean^2, of an impulse on the small strips alone
  for (const double h : {1e-3, 1e-4}) {
    Strips<d> hull = alone;
    hull.add(0.7, 2, h);
    hull.add(0.8, 2, h);
    const auto pieces = hull.laplacian();
    ASSERT_EQ(pieces.pieces().size(), count + 1);
    for (std::size_t k = 0; k < count; ++k) EXPECT_NEAR(pieces.pieces()[k].measure, as_if.pieces()[k].measure, eps);
    EXPECT_NEAR(sum_of_measures(pieces.pieces()), hull.measure, eps);
    std::vector<double> phi(hull.nodes.x.size(), 0.0), r = phi;
    for (std::size_t u = hull.first_unknown[1]; u < phi.size(); ++u) phi[u] = 1;
    const auto means = pieces.means(phi);
    pieces.add(means, r);
    stiffness.push_back(std::inner_product(phi.begin(), phi.end(), r.begin(), 0.0) /
                        (pieces.pieces()[count].measure * means[count] * means[count]));
  }
  const double share =
      (d == 2 ? 4 * 1e-3 : 8 * 1e-6) / alone.measure;  // of the hull; scales K by (1 + s)^2 / (1 + c s)
  EXPECT_GT(stiffness[0], 0);
  EXPECT_NEAR(stiffness[1] / stiffness[0], 1, 3 * share);
}

TYPED_TEST(InterfacePieces, fall_to_parts_by_their_length_in_whatever_order_they_come) {
  constexpr int d = TypeParam::value;
  for (const bool short_one_first : {false, true}) {
    Strips<d> hull;
    hull.add(0, short_one_first ? 2 : 40, 0.01);
    hull.add(1, 40, 0.01);
    hull.add(2, short_one_first ? 40 : 2, 0.01);
    const auto pieces = hull.laplacian();
    ASSERT_EQ(pieces.pieces().size(), 2u * freedoms<d> + 1) << "and one for what is short";
    std::vector<double> ones(hull.nodes.x.size(), 0.0);
    const std::size_t part = short_one_first ? 1 : 0;
    for (std::size_t u = hull.first_unknown[part]; u < hull.first_unknown[part + 1]; ++u) ones[u] = 1;
    const auto means = pieces.means(ones);
    EXPECT_EQ(std::count_if(means.begin(), means.end(), [](double m) { return m > 0; }), freedoms<d>) << "half of them";
  }
}

}  // namespace
}  // namespace splashdown::fluid::interface_laplacian_test
