#include "fluid/mesh/parts.hpp"

#include <algorithm>
#include <numeric>

namespace splashdown::fluid {

template <int d>
std::vector<int> parts_of(const Mesh<d>& mesh, std::size_t nodes) {
  std::vector<int> first(nodes);
  std::iota(first.begin(), first.end(), 0);
  auto find = [&](int n) {
    while (first[n] != n) n = first[n] = first[first[n]];
    return n;
  };
  for (const auto& cell : mesh.cells) {
    int a = find(cell[0]);
    for (int k = 1; k <= d; ++k) {
      const int b = find(cell[k]);
      first[std::max(a, b)] = std::min(a, b);
      a = std::min(a, b);
    }
  }
  for (int& n : first) n = first[n];  // of lower nodes they are known
  return first;
}

template std::vector<int> parts_of(const Mesh<2>&, std::size_t);
template std::vector<int> parts_of(const Mesh<3>&, std::size_t);

}  // namespace splashdown::fluid
