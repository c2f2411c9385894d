#include "apps/report/curves/style.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::apps {

Values scaled(const Values& values, double scale, double offset) {
  Values result(values);
  for (double& v : result) v = (v - offset) * scale;
  return result;
}

double largest(const Values& values) {
  double top = 0;
  for (const double v : values)
    if (std::isfinite(v)) top = std::max(top, std::abs(v));
  return top;
}

std::vector<std::size_t> present(const std::vector<Values>& group) {
  double top = 0;
  for (const auto& values : group) top = std::max(top, largest(values));
  std::vector<std::size_t> indices;
  for (std::size_t k = 0; k < group.size(); ++k)
    if (largest(group[k]) > 1e-6 * top && top > 1e-12) indices.push_back(k);
  return indices;
}

}  // namespace splashdown::apps
