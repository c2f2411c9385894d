#include "fluid/pfem/mesh/conservation/displaced_volume.hpp"

namespace splashdown::fluid {

template <int d>
std::vector<DisplacedVolume<d>> displaced_volumes(const Mesh<d>& mesh, const std::vector<Vec<d>>& x, std::size_t walls,
                                                  const std::optional<Mirror>& mirror) {
  constexpr int none = -2, several = -3;
  std::vector<int> wall_at(x.size(), none);
  for (const auto& facet : mesh.boundary) {
    if (mirror && lies_in(*mirror, facet, x)) continue;
    for (const int n : facet.nodes) {
      int& wall = wall_at[n];
      if (wall == none)
        wall = facet.wall;
      else if (wall != facet.wall)
        wall = several;
    }
  }
  std::vector<char> is_closed(walls, 1);
  std::vector<DisplacedVolume<d>> found(walls);
  std::vector<Vec<d>> origin(walls);  // one of the nodes: little is lost to roundoff
  std::vector<char> is_met(walls, 0);
  for (const auto& facet : mesh.boundary) {
    if (facet.wall < 0) continue;
    const auto w = static_cast<std::size_t>(facet.wall);
    for (const int n : facet.nodes) is_closed[w] &= wall_at[n] == facet.wall;
    if (!is_closed[w]) continue;
    if (!is_met[w]) origin[w] = x[facet.nodes[0]], is_met[w] = 1;
    if (mirror) origin[w] = mirror->onto<d>(origin[w]);  // what closes it there adds nothing
    Vec<d> sum = Vec<d>::Zero();
    for (const int n : facet.nodes) sum += x[n] - origin[w];
    // The water's facets look into the hull.
    const double volume = -(x[facet.nodes[0]] - origin[w]).dot(area_vector_of<d>(facet, x)) / d;
    found[w].volume += volume;
    found[w].centre += volume / (d + 1) * sum;
  }
  for (std::size_t w = 0; w < walls; ++w) {
    if (is_closed[w] && is_met[w] && found[w].volume > 0)
      found[w].centre = origin[w] + found[w].centre / found[w].volume;
    else
      found[w] = {};
  }
  return found;
}

template std::vector<DisplacedVolume<2>> displaced_volumes(const Mesh<2>&, const std::vector<Vec<2>>&, std::size_t,
                                                           const std::optional<Mirror>&);
template std::vector<DisplacedVolume<3>> displaced_volumes(const Mesh<3>&, const std::vector<Vec<3>>&, std::size_t,
                                                           const std::optional<Mirror>&);

}  // namespace splashdown::fluid
