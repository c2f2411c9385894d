#include "rigid/forces/curve.hpp"

#include <algorithm>

namespace splashdown::rigid {

template <int values>
Eigen::Matrix<double, values, 1> Curve<values>::at(double x) const {
  if (rows_.empty()) return Eigen::Matrix<double, values, 1>::Zero();
  const auto next = std::ranges::find_if(rows_, [&](const Row& row) { return row.at > x; });
  if (next == rows_.begin()) return rows_.front().value;
  if (next == rows_.end()) return rows_.back().value;
  const Row& before = *(next - 1);
  return before.value + (x - before.at) / (next->at - before.at) * (next->value - before.value);
}

template <int values>
double Curve<values>::largest() const {
  double most = 0;
  for (const Row& row : rows_) most = std::max(most, row.value.norm());
  return most;
}

template <int values>
double Curve<values>::steepest() const {
  double most = 0;
  for (std::size_t i = 1; i < rows_.size(); ++i)
    most = std::max(most, (rows_[i].value - rows_[i - 1].value).norm() / (rows_[i].at - rows_[i - 1].at));
  return most;
}

template class Curve<1>;
template class Curve<2>;
template class Curve<3>;

}  // namespace splashdown::rigid
