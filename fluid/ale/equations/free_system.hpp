// The equations of a step with what is given left out: their slope, its factor, and what both are of.
#pragma once

#include <vector>

#include "fluid/ale/equations/flow_equations.hpp"
#include "fluid/ale/linear/direct_solver.hpp"

namespace splashdown::ale {

/// Unknowns that are given, and the numbers of the others.
class GivenUnknowns {
 public:
  /// `is_given`: of all unknowns.
  explicit GivenUnknowns(std::vector<char> is_given);
  /// Whether an unknown is given.
  bool operator[](Eigen::Index unknown) const { return numbers_[static_cast<std::size_t>(unknown)] < 0; }
  Eigen::Index free() const { return free_; }  ///< how many are not given
  /// How many of the first so many unknowns are not given.
  Eigen::Index free_among(Eigen::Index first) const;
  /// What belongs to those that are not given.
  Eigen::VectorXd gather(const Eigen::VectorXd& all) const;
  /// Adds to them.
  void add(const Eigen::VectorXd& change, Eigen::VectorXd& all) const;
  /// Rows and columns of those that are not given.
  Eigen::SparseMatrix<double> inner(const Eigen::SparseMatrix<double>& all) const;

 private:
  std::vector<int> numbers_;  // -1: given
  Eigen::Index free_ = 0;
};

/// The slope of a step at a place, factored.
class FactoredSlope {
 public:
  /// At these unknowns. False where it is singular.
  bool make(const FlowEquations& equations, const GivenUnknowns& given, const StepFields& fields, const Unknowns& at,
            double& assembly_seconds, double& factor_seconds);
  /// Whether there is a factor.
  bool is_ready() const { return solver_.is_ready(); }
  /// Forgets the factor.
  void drop() { solver_ = {}; }
  /// A number that tells factors apart.
  long number() const { return number_; }
  /// Gives it one.
  void number(long n) { number_ = n; }
  /// Whether it is of steps as long as this one, and of the same scheme.
  bool suits(const StepFields& fields) const;
  /// Change of what is not given that takes this away from its residuals.
  Eigen::VectorXd correction(const Eigen::VectorXd& residual) const { return solver_.solve(-residual); }
  /// Change of all residuals by a change of all unknowns.
  Eigen::VectorXd times(const Eigen::VectorXd& change) const { return slope_ * change; }
  const StepFields& fields() const { return fields_; }  ///< that it is of
  const Unknowns& at() const { return at_; }            ///< that it is of
  double fill() const { return solver_.fill(); }        ///< numbers in the factors

 private:
  StepFields fields_;
  Unknowns at_;
  Eigen::SparseMatrix<double> slope_;
  DirectSolver solver_;
  long number_ = 0;
};

}  // namespace splashdown::ale
