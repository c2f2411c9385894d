#include "fluid/ale/equations/free_system.hpp"

#include <cmath>

#include "core/stopwatch.hpp"

namespace splashdown::ale {

GivenUnknowns::GivenUnknowns(std::vector<char> is_given) : numbers_(is_given.size(), -1) {
  for (std::size_t i = 0; i < is_given.size(); ++i)
    if (!is_given[i]) numbers_[i] = static_cast<int>(free_++);
}

Eigen::Index GivenUnknowns::free_among(Eigen::Index first) const {
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < first; ++i) count += (*this)[i] ? 0 : 1;
  return count;
}

Eigen::VectorXd GivenUnknowns::gather(const Eigen::VectorXd& all) const {
  Eigen::VectorXd out(free_);
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    if (numbers_[i] >= 0) out[numbers_[i]] = all[static_cast<Eigen::Index>(i)];
  return out;
}

void GivenUnknowns::add(const Eigen::VectorXd& change, Eigen::VectorXd& all) const {
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    if (numbers_[i] >= 0) all[static_cast<Eigen::Index>(i)] += change[numbers_[i]];
}

Eigen::SparseMatrix<double> GivenUnknowns::inner(const Eigen::SparseMatrix<double>& all) const {
  Eigen::SparseMatrix<double> out(free_, free_);
  out.reserve(all.nonZeros());
  for (Eigen::Index column = 0; column < all.outerSize(); ++column) {
    const int to = numbers_[static_cast<std::size_t>(column)];
    if (to < 0) continue;
    out.startVec(to);
    for (Eigen::SparseMatrix<double>::InnerIterator entry(all, column); entry; ++entry)
      if (const int row = numbers_[static_cast<std::size_t>(entry.row())]; row >= 0)
        out.insertBack(row, to) = entry.value();
  }
  out.finalize();
  return out;
}

bool FactoredSlope::make(const FlowEquations& equations, const GivenUnknowns& given, const StepFields& fields,
                         const Unknowns& at, double& assembly_seconds, double& factor_seconds) {
  fields_ = fields;
  at_ = at;
  Eigen::SparseMatrix<double> inner;
  {
    const Stopwatch watch(assembly_seconds);
    equations.linearise(fields, at, slope_);
    inner = given.inner(slope_);
  }
  const Stopwatch watch(factor_seconds);
  return solver_.factor(inner);
}

bool FactoredSlope::suits(const StepFields& fields) const {
  constexpr double near = 0.05;  // of the rate: a factor that is off by so much still leads to the solution
  return solver_.is_ready() && fields.theta == fields_.theta &&
         std::abs(fields.rate - fields_.rate) <= near * fields.rate;
}

}  // namespace splashdown::ale
