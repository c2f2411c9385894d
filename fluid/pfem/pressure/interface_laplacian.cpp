#include "fluid/pfem/pressure/interface_laplacian.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>

namespace splashdown::fluid {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Measure of a facet's border: 1 for a point, the length of an edge.
double border_measure(const std::array<Vec<2>, 1>&) { return 1; }
double border_measure(const std::array<Vec<3>, 2>& at) { return (at[1] - at[0]).norm(); }

/// The wetted facets of one wall and which of them share a border.
template <int d>
struct Hull {
  struct Border {
    int a, b;  // facets; b = -1: a contact line
    double measure;
    Vec<d> centre;
  };
  struct Neighbour {
    int facet;
    double distance;
  };
  std::vector<const Facet<d>*> facets;
  std::vector<Vec<d>> centre;
  std::vector<Vec<d>> area;  // vectors, out of the fluid
  std::vector<double> measure;
  std::vector<Border> borders;
  std::vector<std::vector<Neighbour>> neighbours;

  Hull(const Mesh<d>& mesh, const std::vector<Vec<d>>& x, int wall) {
    std::map<std::array<int, d - 1>, int> open;  // borders seen once, and their position in `borders`
    for (const auto& f : mesh.boundary) {
      if (f.wall != wall) continue;
      const int index = static_cast<int>(facets.size());
      facets.push_back(&f);
      area.push_back(area_vector_of<d>(f, x));
      measure.push_back(area.back().norm());
      centre.push_back(Vec<d>::Zero());
      for (int n : f.nodes) centre.back() += x[n] / d;
      for (int k = 0; k < d; ++k) {
        std::array<int, d - 1> nodes;
        std::copy(f.nodes.begin(), f.nodes.begin() + k, nodes.begin());
        std::copy(f.nodes.begin() + k + 1, f.nodes.end(), nodes.begin() + k);
        std::sort(nodes.begin(), nodes.end());
        const auto [it, fresh] = open.try_emplace(nodes, static_cast<int>(borders.size()));
        if (!fresh) {
          borders[it->second].b = index;
          continue;
        }
        std::array<Vec<d>, d - 1> at;
        Vec<d> middle = Vec<d>::Zero();
        for (int j = 0; j + 1 < d; ++j) at[j] = x[nodes[j]], middle += at[j] / (d - 1);
        borders.push_back({index, -1, border_measure(at), middle});
      }
    }
    neighbours.resize(facets.size());
    for (const auto& border : borders) {
      if (border.b < 0) continue;
      const double distance = (centre[border.a] - border.centre).norm() + (centre[border.b] - border.centre).norm();
      neighbours[border.a].push_back({border.b, distance});
      neighbours[border.b].push_back({border.a, distance});
    }
  }

  /// Distances of all facets from one, along the hull (Dijkstra 1959).
  std::vector<double> distances(int from) const {
    std::vector<double> distance(facets.size(), infinite);
    using Reached = std::pair<double, int>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    distance[from] = 0;
    front.push({0.0, from});
    while (!front.empty()) {
      const auto [far, f] = front.top();
      front.pop();
      if (far > distance[f]) continue;
      for (const auto& next : neighbours[f])
        if (far + next.distance < distance[next.facet]) {
          distance[next.facet] = far + next.distance;
          front.push({distance[next.facet], next.facet});
        }
    }
    return distance;
  }
};

/// Where a facet lies between the two seeds nearest to it: pieces overlap, in 2D like linear shape functions.
struct Place {
  int piece = -1, next = -1;
  double nearest = infinite, second = infinite;
  double share() const { return next < 0 || nearest == 0 ? 1.0 : second / (nearest + second); }

  void offer(int seed, double distance) {
    if (distance < nearest) {
      next = piece, second = nearest;
      piece = seed, nearest = distance;
    } else if (distance < second) {
      next = seed, second = distance;
    }
  }
};

/// How far each facet's part of the hull reaches from the first facet of it: parts hang together by borders.
template <int d>
std::vector<double> reaches(const Hull<d>& hull) {
  std::vector<double> reach(hull.facets.size(), -1);
  for (std::size_t first = 0; first < reach.size(); ++first) {
    if (reach[first] >= 0) continue;
    const auto distance = hull.distances(static_cast<int>(first));
    double far = 0;
    for (double r : distance) far = r < infinite ? std::max(far, r) : far;
    for (std::size_t f = 0; f < reach.size(); ++f)
      if (distance[f] < infinite) reach[f] = far;
  }
  return reach;
}

/// Seeds as far from each other as possible (Gonzalez 1985), at most `count`; the place of each facet. A part without a
/// seed is as far from them as it reaches: what a jet wets beside the hull's face is not worth one.
template <int d>
std::vector<Place> farthest_point_seeds(const Hull<d>& hull, int count) {
  std::vector<Place> places(hull.facets.size());
  const auto reach = reaches(hull);
  const auto from_seeds = [&](std::size_t f) { return places[f].piece < 0 ? reach[f] : places[f].nearest; };
  for (int k = 0; k < count && !places.empty(); ++k) {
    std::size_t far = 0;
    for (std::size_t f = 1; f < places.size(); ++f)
      if (from_seeds(f) > from_seeds(far)) far = f;
    if (k > 0 && from_seeds(far) == 0) break;
    const auto distance = hull.distances(static_cast<int>(far));
    for (std::size_t f = 0; f < places.size(); ++f)
      if (distance[f] < infinite) places[f].offer(k, distance[f]);
  }
  return places;
}

}  // namespace

template <int d>
void InterfaceLaplacian<d>::cut_wall(const Nodes<d>& nodes, const Mesh<d>& mesh, const std::vector<int>& unknown,
                                     int wall, const InterfaceOperator& interface_operator) {
  const Hull<d> hull(mesh, nodes.x, wall);
  auto places = farthest_point_seeds(hull, 2 * freedoms<d>);
  const std::size_t first = pieces_.size();
  int count = 0;
  for (const auto& place : places) count = std::max(count, place.piece + 1);
  const int rest = count;  // parts without a seed are one piece together
  for (std::size_t f = 0; f < places.size(); ++f)
    if (places[f].piece < 0 && hull.measure[f] > 0) places[f].piece = rest, count = rest + 1;
  pieces_.resize(first + count, {static_cast<std::size_t>(wall), 0.0});
  rows_.resize(first + count);
  std::vector<Vec<d>> centre(count, Vec<d>::Zero()), normal = centre;  // means
  Mat<d> exact = Mat<d>::Zero();                                       // int n n^T
  const auto give = [&](int k, std::size_t f, double share) {
    const double measure = share * hull.measure[f];
    pieces_[first + k].measure += measure;
    centre[k] += measure * hull.centre[f];
    normal[k] += share * hull.area[f];
    for (int n : hull.facets[f]->nodes)
      if (unknown[n] >= 0) rows_[first + k].push_back({unknown[n], measure / d});
  };
  for (std::size_t f = 0; f < places.size(); ++f) {
    const auto& place = places[f];
    if (place.piece < 0 || hull.measure[f] == 0) continue;
    give(place.piece, f, place.share());
    if (place.next >= 0) give(place.next, f, 1 - place.share());
    exact += hull.area[f] * hull.area[f].transpose() / hull.measure[f];
  }
  for (int k = 0; k < count; ++k) {
    const double measure = pieces_[first + k].measure;
    centre[k] /= measure;
    normal[k] /= measure;
    for (auto& share : rows_[first + k]) share.weight /= measure;
    std::erase_if(rows_[first + k], [](const Share& share) { return share.weight == 0; });
  }
  std::vector<Link> links;  // of one operator
  double energy = 0;        // of phi ~ n under them
  const auto link = [&](int a, int b, double weight) {
    const int offset = static_cast<int>(first);
    links.push_back({offset + a, b < 0 ? -1 : offset + b, weight});
    energy += weight * (normal[a] - (b < 0 ? Vec<d>::Zero().eval() : normal[b])).squaredNorm();
  };
  // lambda or alpha: translations get the energy that they have under the exact answer.
  const auto scale = [&](double inverse_mass) {
    if (energy > 0)
      for (const auto& l : links) links_.push_back({l.a, l.b, inverse_mass * exact.squaredNorm() / energy * l.weight});
    links.clear(), energy = 0;
  };
  if (interface_operator.laplacian != 0) {
    for (const auto& border : hull.borders) {
      const int a = places[border.a].piece, b = border.b < 0 ? -1 : places[border.b].piece;
      if (a < 0 || a == b || a == rest) continue;
      const double distance = (centre[a] - border.centre).norm() + (b < 0 ? 0.0 : (centre[b] - border.centre).norm());
      if (distance > 0) link(a, b, border.measure / distance);
    }
    if (count > rest) {
      double stiffness = 0, measure = 0;
      for (const auto& l : links) stiffness += l.weight;
      for (int k = 0; k < rest; ++k) measure += pieces_[first + k].measure;
      link(rest, -1, stiffness / measure * pieces_[first + rest].measure);
    }
    scale(interface_operator.laplacian);
  }
  if (interface_operator.robin != 0) {
    for (int k = 0; k < count; ++k) link(k, -1, pieces_[first + k].measure);
    scale(interface_operator.robin);
  }
}

template <int d>
void InterfaceLaplacian<d>::build(const Nodes<d>& nodes, const Mesh<d>& mesh, const std::vector<int>& unknown,
                                  std::span<const InterfaceOperator> interface_operators) {
  pieces_.clear();
  rows_.clear();
  links_.clear();
  for (std::size_t w = 0; w < interface_operators.size(); ++w)
    if (interface_operators[w].laplacian != 0 || interface_operators[w].robin != 0)
      cut_wall(nodes, mesh, unknown, static_cast<int>(w), interface_operators[w]);
}

template <int d>
void InterfaceLaplacian<d>::add_to(SymmetricMatrix& matrix) const {
  if (links_.empty()) return;
  std::map<std::pair<int, int>, double> extra;  // by column, then row
  for (const auto& link : links_) {
    std::vector<Share> difference = rows_[link.a];  // mean_a - mean_b
    if (link.b >= 0)
      for (const auto& share : rows_[link.b]) difference.push_back({share.unknown, -share.weight});
    for (const auto& i : difference)
      for (const auto& j : difference)
        if (i.unknown >= j.unknown) extra[{j.unknown, i.unknown}] += link.weight * i.weight * j.weight;
  }
  SymmetricMatrix sum;
  sum.column_start.push_back(0);
  auto next = extra.begin();
  for (int j = 0; j < matrix.size(); ++j) {
    const auto put = [&](int row, double value) { sum.row.push_back(row), sum.value.push_back(value); };
    for (int k = matrix.column_start[j]; k < matrix.column_start[j + 1]; ++k) {
      for (; next != extra.end() && next->first < std::pair(j, matrix.row[k]); ++next)
        put(next->first.second, next->second);
      const bool same = next != extra.end() && next->first == std::pair(j, matrix.row[k]);
      put(matrix.row[k], matrix.value[k] + (same ? next->second : 0.0));
      if (same) ++next;
    }
    for (; next != extra.end() && next->first.first == j; ++next) put(next->first.second, next->second);
    sum.column_start.push_back(static_cast<int>(sum.row.size()));
  }
  matrix = std::move(sum);
}

template <int d>
std::vector<double> InterfaceLaplacian<d>::means(std::span<const double> phi) const {
  std::vector<double> out;
  for (const auto& row : rows_) {
    double mean = 0;
    for (const auto& share : row) mean += share.weight * phi[share.unknown];
    out.push_back(mean);
  }
  return out;
}

template <int d>
void InterfaceLaplacian<d>::add(std::span<const double> means, std::vector<double>& r) const {
  std::vector<double> flux(means.size(), 0.0);  // L means
  for (const auto& link : links_) {
    const double f = link.weight * (means[link.a] - (link.b < 0 ? 0.0 : means[link.b]));
    flux[link.a] += f;
    if (link.b >= 0) flux[link.b] -= f;
  }
  for (std::size_t k = 0; k < rows_.size(); ++k)
    for (const auto& share : rows_[k]) r[share.unknown] += share.weight * flux[k];
}

template class InterfaceLaplacian<2>;
template class InterfaceLaplacian<3>;

}  // namespace splashdown::fluid
