#include "fluid/pfem/mesh/parts.hpp"

#include <algorithm>

namespace splashdown::fluid {

template <int d>
std::vector<int> parts_of(const Mesh<d>& mesh, const std::vector<char>& among) {
  std::vector<int> first(among.size(), -1);
  for (std::size_t i = 0; i < first.size(); ++i)
    if (among[i]) first[i] = static_cast<int>(i);
  auto find = [&](int n) {
    while (first[n] != n) n = first[n] = first[first[n]];
    return n;
  };
  for (const auto& cell : mesh.cells) {
    int a = -1;
    for (int n : cell) {
      if (!among[n]) continue;
      const int b = find(n);
      if (a < 0) a = b;
      first[std::max(a, b)] = std::min(a, b);
      a = std::min(a, b);
    }
  }
  for (int& n : first)
    if (n >= 0) n = first[n];  // of lower nodes they are known
  return first;
}

template <int d>
std::vector<int> parts_of(const Mesh<d>& mesh, std::size_t nodes) {
  return parts_of(mesh, std::vector<char>(nodes, 1));
}

template std::vector<int> parts_of(const Mesh<2>&, std::size_t);
template std::vector<int> parts_of(const Mesh<3>&, std::size_t);
template std::vector<int> parts_of(const Mesh<2>&, const std::vector<char>&);
template std::vector<int> parts_of(const Mesh<3>&, const std::vector<char>&);

}  // namespace splashdown::fluid
