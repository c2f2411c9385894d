#include "elastic/modes/modes.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace splashdown::elastic {
namespace {

/// Rows and columns of the free unknowns.
Sparse freed(const Sparse& matrix, const std::vector<Eigen::Index>& number, Eigen::Index count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      const auto i = number[static_cast<std::size_t>(entry.row())], k = number[static_cast<std::size_t>(column)];
      if (i >= 0 && k >= 0) entries.emplace_back(i, k, entry.value());
    }
  Sparse part(count, count);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

/// (K - shift M)^-1, as Spectra asks for it.
class ShiftedInverse {
 public:
  using Scalar = double;
  ShiftedInverse(const Sparse& K, const Sparse& M) : K_(K), M_(M) {}
  Eigen::Index rows() const { return K_.rows(); }
  Eigen::Index cols() const { return K_.cols(); }
  void set_shift(double shift) { factor_.compute(K_ - shift * M_); }
  bool ok() const { return factor_.info() == Eigen::Success; }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Field>(y, rows()) = factor_.solve(Eigen::Map<const Field>(x, rows()));
  }

 private:
  const Sparse &K_, &M_;
  Eigen::SimplicialLDLT<Sparse> factor_;
};

class Product {
 public:
  using Scalar = double;
  explicit Product(const Sparse& M) : M_(M) {}
  Eigen::Index rows() const { return M_.rows(); }
  Eigen::Index cols() const { return M_.cols(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Field>(y, rows()) = M_ * Eigen::Map<const Field>(x, rows());
  }

 private:
  const Sparse& M_;
};

}  // namespace

Modes lowest_modes(const System& system, int count, const Field& u) {
  std::vector<Eigen::Index> number;
  Eigen::Index free = 0;
  for (const bool held : system.held()) number.push_back(held ? -1 : free++);
  if (count < 1 || count >= free)
    throw std::invalid_argument("modes must be from 1 to " + std::to_string(free - 1) + ", which the mesh has");
  Sparse all;
  system.stiffness(u, all);
  const Sparse K = freed(all, number, free), M = freed(system.mass(), number, free);
  // Near the lowest frequencies of slender bodies: small against the highest, large against roundoff.
  const double shift = -1e-10 * K.diagonal().cwiseQuotient(M.diagonal()).maxCoeff();
  ShiftedInverse inverse(K, M);
  Product product(M);
  const auto vectors = static_cast<int>(std::min<Eigen::Index>(free, std::max(20, 3 * count)));
  Spectra::SymGEigsShiftSolver<ShiftedInverse, Product, Spectra::GEigsMode::ShiftInvert> solver(inverse, product, count,
                                                                                                vectors, shift);
  Modes modes;
  if (!inverse.ok()) {
    modes.status = {"the solid's stiffness cannot be factored: it is beyond buckling"};
    return modes;
  }
  solver.init();
  constexpr int most = 1000;
  const auto found = solver.compute(Spectra::SortRule::LargestMagn, most, 1e-10);
  if (found < count) modes.status = {"only " + std::to_string(found) + " of its modes converged"};
  const auto values = solver.eigenvalues();
  const auto vectors_of = solver.eigenvectors();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Eigen::Index>(k);
  std::ranges::sort(order, {}, [&](Eigen::Index k) { return values[k]; });
  modes.angular_frequencies.resize(values.size());
  modes.shapes.setZero(system.size(), values.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    modes.angular_frequencies[column] = std::sqrt(std::max(0., values[order[k]]));
    const Field x = vectors_of.col(order[k]);
    const double norm = std::sqrt(x.dot(M * x));
    for (std::size_t i = 0; i < number.size(); ++i)
      if (number[i] >= 0) modes.shapes(static_cast<Eigen::Index>(i), column) = x[number[i]] / norm;
  }
  return modes;
}

}  // namespace splashdown::elastic
