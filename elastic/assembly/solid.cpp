#include "elastic/assembly/solid.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "core/geometry.hpp"

namespace splashdown::elastic {

namespace {

/// Each cell has the first material.
template <int d>
std::vector<int> of_one_part(const SolidMesh<d>& mesh) {
  return std::vector<int>(mesh.cells.size(), 0);
}

}  // namespace

template <int d>
Solid<d>::Solid(SolidMesh<d> mesh, std::shared_ptr<const Law<d>> law, double density)
    : Solid(mesh, std::vector<Material<d>>{{std::move(law), density}}, of_one_part(mesh)) {}

template <int d>
Solid<d>::Solid(SolidMesh<d> mesh, std::vector<Material<d>> materials, std::vector<int> part)
    : mesh_(std::move(mesh)), materials_(std::move(materials)), part_(std::move(part)), length_(extent(mesh_)) {
  for (const auto& material : materials_) {
    if (!(material.density > 0)) throw std::invalid_argument("density must be positive");
    linear_ &= material.law->linear();
  }
  for (const int number : part_)
    if (number < 0 || number >= static_cast<int>(materials_.size()))
      throw std::invalid_argument("a cell has no material");
  if (part_.size() != mesh_.cells.size()) throw std::invalid_argument("each cell has a material");
  held_.assign(static_cast<std::size_t>(d * mesh_.size()), false);
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
    for (const auto& point : rule<d>()) {
      double determinant = 0;
      const auto slopes = slopes_at(c, point.at, &determinant);
      points_.push_back({slopes, point.weight * determinant / factorial<d>});
    }
  make_pattern();
  assemble_mass();
  if (linear_)
    assemble_stiffness([&](std::size_t c, const Slopes&) { return law(c).tangent(Mat<d>::Identity()); }, constant_);
}

template <int d>
std::pair<Solid<d>, std::vector<typename SplitCells<d>::At>> Solid<d>::divided() const {
  auto parts = split<d>(mesh_.nodes, mesh_.cells);
  std::vector<int> part;
  for (const int number : part_) part.insert(part.end(), part_count<d>, number);
  Solid fine(solid_mesh<d>(parts.nodes, std::move(parts.cells)), materials_, std::move(part));
  for (int a = 0; a < fine.mesh().size(); ++a) {
    const auto& [cell, at] = parts.places[static_cast<std::size_t>(a)];
    const auto N = shapes<d>(at);
    for (int k = 0; k < d; ++k) {
      bool is_held = true;
      for (int b = 0; b < cell_nodes<d>; ++b)
        is_held &= N[b] == 0 || held_[static_cast<std::size_t>(d * mesh_.cells[static_cast<std::size_t>(cell)][b] + k)];
      if (is_held) fine.hold(d * a + k);
    }
  }
  for (const auto& [place, mass] : point_masses_) fine.add_point_mass(in_divided<d>(place), mass);
  return {std::move(fine), std::move(parts.places)};
}

template <int d>
typename Solid<d>::Slopes Solid<d>::slopes_at(std::size_t cell, const Barycentric<d>& at, double* determinant) const {
  const auto slopes = shape_slopes<d>(at);
  Mat<d> J = Mat<d>::Zero();
  for (int a = 0; a < cell_nodes<d>; ++a) J += mesh_.nodes.col(mesh_.cells[cell][a]) * slopes.col(a).transpose();
  if (determinant) *determinant = J.determinant();
  return J.transpose().inverse() * slopes;
}

template <int d>
Vec<d> Solid<d>::at_rest(std::size_t cell, const Barycentric<d>& at) const {
  const auto N = shapes<d>(at);
  Vec<d> X = Vec<d>::Zero();
  for (int a = 0; a < cell_nodes<d>; ++a) X += N[a] * mesh_.nodes.col(mesh_.cells[cell][a]);
  return X;
}

template <int d>
typename Solid<d>::Displacements Solid<d>::of_cell(const Field& u, std::size_t cell) const {
  Displacements all;
  for (int a = 0; a < cell_nodes<d>; ++a) all.col(a) = u.segment<d>(d * mesh_.cells[cell][a]);
  return all;
}

template <int d>
Mat<d> Solid<d>::gradient(const Field& u, std::size_t cell, const Slopes& slopes) const {
  return Mat<d>::Identity() + of_cell(u, cell) * slopes.transpose();
}

template <int d>
void Solid<d>::make_pattern() {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(mesh_.size()));
  for (const auto& cell : mesh_.cells)
    for (const int b : cell)
      for (const int a : cell) neighbours[static_cast<std::size_t>(b)].push_back(a);
  for (auto& list : neighbours) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  mass_.resize(d * mesh_.size(), d * mesh_.size());
  Eigen::VectorXi counts(d * mesh_.size());
  for (int b = 0; b < mesh_.size(); ++b)
    counts.segment<d>(d * b).setConstant(static_cast<int>(d * neighbours[static_cast<std::size_t>(b)].size()));
  mass_.reserve(counts);
  for (int b = 0; b < mesh_.size(); ++b)
    for (int k = 0; k < d; ++k)
      for (const int a : neighbours[static_cast<std::size_t>(b)])
        for (int i = 0; i < d; ++i) mass_.insert(d * a + i, d * b + k) = 0;
  mass_.makeCompressed();
  for (const auto& cell : mesh_.cells)
    for (const int b : cell)
      for (int k = 0; k < d; ++k)
        for (const int a : cell) {
          const auto& list = neighbours[static_cast<std::size_t>(b)];
          const auto place = std::ranges::lower_bound(list, a) - list.begin();
          first_.push_back(mass_.outerIndexPtr()[d * b + k] + static_cast<int>(d * place));
        }
}

/// `block(a, b)`: d x d, of nodes a and b of the cell.
template <int d>
template <class Add>
void Solid<d>::add_cell(std::size_t cell, Sparse& matrix, const Add& block) const {
  constexpr int n = cell_nodes<d>;
  const int* first = first_.data() + cell * n * n * d;
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a) {
      const Mat<d> values = block(a, b);
      for (int k = 0; k < d; ++k)
        for (int i = 0; i < d; ++i) matrix.valuePtr()[first[(b * d + k) * n + a] + i] += values(i, k);
    }
}

template <int d>
void Solid<d>::assemble_mass() {
  const auto& points = rule<d>();
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    Eigen::Matrix<double, cell_nodes<d>, cell_nodes<d>> m = decltype(m)::Zero();
    const double density = materials_[static_cast<std::size_t>(part_[c])].density;
    for (std::size_t q = 0; q < points.size(); ++q) {
      const auto N = shapes<d>(points[q].at);
      m += density * points_[c * points.size() + q].weight * N * N.transpose();
    }
    add_cell(c, mass_, [&](int a, int b) -> Mat<d> { return m(a, b) * Mat<d>::Identity(); });
  }
  sum_mass();
}

template <int d>
double Solid<d>::strain_energy(const Field& u) const {
  if (linear()) return 0.5 * u.dot(constant_ * u);
  double sum = 0;
  const std::size_t n = rule<d>().size();
  for (std::size_t p = 0; p < points_.size(); ++p)
    sum += points_[p].weight * law(p / n).energy(gradient(u, p / n, points_[p].slopes));
  return sum;
}

template <int d>
template <class Stress>
Field Solid<d>::force_of(const Stress& stress) const {
  Field f = Field::Zero(this->size());
  const std::size_t n = rule<d>().size();
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    Displacements force = Displacements::Zero();
    for (std::size_t p = c * n; p < (c + 1) * n; ++p)
      force += points_[p].weight * stress(c, points_[p].slopes) * points_[p].slopes;
    for (int a = 0; a < cell_nodes<d>; ++a) f.segment<d>(d * mesh_.cells[c][a]) += force.col(a);
  }
  return f;
}

template <int d>
Field Solid<d>::internal_force(const Field& u) const {
  if (linear()) return constant_ * u;
  return force_of([&](std::size_t c, const Slopes& slopes) -> Mat<d> { return law(c).stress(gradient(u, c, slopes)); });
}

template <int d>
Field Solid<d>::force_between(const Field& before, const Field& middle, double lead) const {
  if (linear()) return constant_ * (middle + 2 * lead * (middle - before));
  return force_of([&](std::size_t c, const Slopes& slopes) -> Mat<d> {
    const Mat<d> F_before = gradient(before, c, slopes), F = gradient(middle, c, slopes);
    Mat<d> S = law(c).stress_between(F_before, F);
    if (lead != 0) S += lead * law(c).stress_change(F_before, F);
    return F * S;
  });
}

template <int d>
Field Solid<d>::turned_change(const Field& before, const Field& middle) const {
  if (linear()) return Field::Zero(this->size());
  return force_of([&](std::size_t c, const Slopes& slopes) -> Mat<d> {
    const Mat<d> F_before = gradient(before, c, slopes), F = gradient(middle, c, slopes);
    return (F - F_before) * law(c).stress_change(F_before, F);
  });
}

template <int d>
Field Solid<d>::carried_force(const Field& before, const Field& middle, const Field& now) const {
  if (linear()) return constant_ * middle;
  return force_of([&](std::size_t c, const Slopes& slopes) -> Mat<d> {
    return gradient(now, c, slopes) * law(c).stress_between(gradient(before, c, slopes), gradient(middle, c, slopes));
  });
}

template <int d>
double Solid<d>::strain_energy_between(const Field& before, const Field& middle) const {
  if (linear()) return strain_energy(middle);
  double sum = 0;
  const std::size_t n = rule<d>().size();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const auto& [slopes, weight] = points_[p];
    const Mat<d> F_before = gradient(before, p / n, slopes), F = gradient(middle, p / n, slopes);
    const Mat<d> rate = F.transpose() * (F - F_before);
    sum += weight * (0.5 * (law(p / n).energy(F_before) + law(p / n).energy(2 * F - F_before)) -
                     0.25 * law(p / n).stress_change(F_before, F).cwiseProduct(rate).sum());
  }
  return sum;
}

template <int d>
void Solid<d>::stiffness(const Field& u, Sparse& K) const {
  if (linear())
    K = constant_;
  else
    assemble_stiffness([&](std::size_t c, const Slopes& slopes) { return law(c).tangent(gradient(u, c, slopes)); }, K);
}

template <int d>
void Solid<d>::stiffness_between(const Field& before, const Field& middle, double lead, Sparse& K) const {
  const double more = 1 + 2 * lead;  // dS doubles what the middle does
  if (linear()) {
    K = more * constant_;
    return;
  }
  const auto tangent = [&](std::size_t c, const Slopes& slopes) {
    const Mat<d> F_before = gradient(before, c, slopes), F = gradient(middle, c, slopes);
    const Mat<d> S = law(c).stress_between(F_before, F) + lead * law(c).stress_change(F_before, F);
    const Mat<d> by_stress = S - more * law(c).second_piola(F);
    Tangent<d> A = more * law(c).tangent(F);
    for (int J = 0; J < d; ++J)
      for (int L = 0; L < d; ++L)
        A.template block<d, d>(d * J, d * L).diagonal().array() += 0.5 * (by_stress(J, L) + by_stress(L, J));
    return A;
  };
  assemble_stiffness(tangent, K);
}

template <int d>
template <class TangentAt>
void Solid<d>::assemble_stiffness(const TangentAt& tangent, Sparse& K) const {
  if (K.nonZeros() != mass_.nonZeros()) K = mass_;
  K.coeffs().setZero();
  constexpr int n = cell_nodes<d>;
  const std::size_t count = rule<d>().size();
  Eigen::Matrix<double, d * n, d * n> k;
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    k.setZero();
    for (std::size_t p = c * count; p < (c + 1) * count; ++p) {
      const auto& G = points_[p].slopes;
      const Tangent<d> A = points_[p].weight * tangent(c, G);
      for (int a = 0; a < n; ++a) {
        Eigen::Matrix<double, d, d* d> of_a = decltype(of_a)::Zero();
        for (int J = 0; J < d; ++J) of_a += G(J, a) * A.template middleRows<d>(d * J);
        for (int b = 0; b < n; ++b)
          for (int L = 0; L < d; ++L)
            k.template block<d, d>(d * a, d * b) += G(L, b) * of_a.template middleCols<d>(d * L);
      }
    }
    add_cell(c, K, [&](int a, int b) -> Mat<d> { return k.template block<d, d>(d * a, d * b); });
  }
}

template <int d>
int Solid<d>::clamp(const std::function<bool(const Vec<d>&)>& inside) {
  int count = 0;
  for (int a = 0; a < mesh_.size(); ++a) {
    if (!inside(mesh_.nodes.col(a))) continue;
    ++count;
    for (int k = 0; k < d; ++k) hold(d * a + k);
  }
  return count;
}

template <int d>
void Solid<d>::add_point_mass(const Place<d>& place, double mass) {
  point_masses_.emplace_back(place, mass);
  const auto N = shapes<d>(place.at);
  add_cell(static_cast<std::size_t>(place.cell), mass_,
           [&](int a, int b) -> Mat<d> { return mass * N[a] * N[b] * Mat<d>::Identity(); });
  sum_mass();
}

template <int d>
void Solid<d>::sum_mass() {
  of_node_ = Field(mass_ * uniform(Vec<d>::UnitX())).reshaped(d, mesh_.size()).row(0).transpose();
}

template <int d>
Field Solid<d>::uniform(const Vec<d>& vector) const {
  return vector.replicate(mesh_.size(), 1);
}

template <int d>
Field Solid<d>::point_force(const Place<d>& place, const Vec<d>& force) const {
  Field F = Field::Zero(this->size());
  const auto N = shapes<d>(place.at);
  const auto& cell = mesh_.cells[static_cast<std::size_t>(place.cell)];
  for (int a = 0; a < cell_nodes<d>; ++a) F.segment<d>(d * cell[a]) += N[a] * force;
  return F;
}

template <int d>
Field Solid<d>::body_force(const std::function<Vec<d>(const Vec<d>&)>& density) const {
  Field F = Field::Zero(this->size());
  const auto& points = rule<d>();
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
    for (std::size_t q = 0; q < points.size(); ++q) {
      const auto N = shapes<d>(points[q].at);
      const Vec<d> force = points_[c * points.size() + q].weight * density(at_rest(c, points[q].at));
      for (int a = 0; a < cell_nodes<d>; ++a) F.segment<d>(d * mesh_.cells[c][a]) += N[a] * force;
    }
  return F;
}

namespace {

/// Area vector of a curved facet at a point, per unit of the straight simplex.
inline Vec<2> normal_of(const Eigen::Matrix<double, 2, 1>& along) { return {along.y(), -along.x()}; }
inline Vec<3> normal_of(const Eigen::Matrix<double, 3, 2>& along) { return 0.5 * along.col(0).cross(along.col(1)); }

}  // namespace

template <int d>
Field Solid<d>::traction(const std::function<Vec<d>(const Vec<d>&, const Vec<d>&)>& stress) const {
  Field F = Field::Zero(this->size());
  for (const auto& facet : mesh_.facets)
    for (const auto& point : rule<d - 1>()) {
      const auto N = shapes<d - 1>(point.at);
      const auto slopes = shape_slopes<d - 1>(point.at);
      Vec<d> X = Vec<d>::Zero();
      Eigen::Matrix<double, d, d - 1> along = decltype(along)::Zero();
      for (int a = 0; a < facet_nodes<d>; ++a) {
        X += N[a] * mesh_.nodes.col(facet[a]);
        along += mesh_.nodes.col(facet[a]) * slopes.col(a).transpose();
      }
      const Vec<d> area = normal_of(along);
      const Vec<d> force = point.weight * area.norm() * stress(X, area.normalized());
      for (int a = 0; a < facet_nodes<d>; ++a) F.segment<d>(d * facet[a]) += N[a] * force;
    }
  return F;
}

template <int d>
Vec<d> Solid<d>::value(const Field& field, const Place<d>& place) const {
  return of_cell(field, static_cast<std::size_t>(place.cell)) * shapes<d>(place.at);
}

template <int d>
Momenta<d> Solid<d>::momenta(const Field& u, const Field& v) const {
  const Field p = mass_ * v;
  Momenta<d> sum{Vec<d>::Zero(), decltype(Momenta<d>::angular)::Zero()};
  for (int a = 0; a < mesh_.size(); ++a) {
    const Vec<d> x = mesh_.nodes.col(a) + u.segment<d>(d * a), own = p.segment<d>(d * a);
    sum.linear += own;
    if constexpr (d == 2)
      sum.angular[0] += x.x() * own.y() - x.y() * own.x();
    else
      sum.angular += x.cross(own);
  }
  return sum;
}

template <int d>
double Solid<d>::total_mass() const {
  return of_node_.sum();
}

template <int d>
Vec<d> Solid<d>::centre(const Field& u) const {
  return (mesh_.nodes + u.reshaped(d, mesh_.size())) * of_node_ / total_mass();
}

template <int d>
Mat<d> Solid<d>::second_moments() const {
  Points<d> x = mesh_.nodes;
  x.colwise() -= centre(Field::Zero(this->size()));
  const Field p = mass_ * x.reshaped();
  return x * p.reshaped(d, mesh_.size()).transpose();
}

template <int d>
StressPeak<d> Solid<d>::peak(const Field& u) const {
  StressPeak<d> most;
  const auto& points = rule<d>();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const double value = von_mises(law(p / points.size()).cauchy(gradient(u, p / points.size(), points_[p].slopes)));
    if (!(value > most.value)) continue;
    most.value = value;
    most.cell = p / points.size();
    most.in_cell = points[p % points.size()].at;
  }
  most.at = at_rest(most.cell, most.in_cell);
  return most;
}

template <int d>
Mat<3> Solid<d>::stress_at_node(const Field& u, std::size_t cell, int k) const {
  return law(cell).cauchy(gradient(u, cell, slopes_at(cell, node_place<d>(k))));
}

template <int d>
double Solid<d>::stress_error(const Field& u, const StressPeak<d>& peak) const {
  const auto& own = mesh_.cells[peak.cell];
  std::array<Mat<3>, cell_nodes<d>> sums;
  sums.fill(Mat<3>::Zero());
  std::array<int, cell_nodes<d>> counts{};
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
    for (int k = 0; k < cell_nodes<d> && part_[c] == part_[peak.cell]; ++k) {
      const auto found = std::ranges::find(own, mesh_.cells[c][static_cast<std::size_t>(k)]);
      if (found == own.end()) continue;
      const auto node = static_cast<std::size_t>(found - own.begin());
      sums[node] += stress_at_node(u, c, k);
      ++counts[node];
    }
  const auto N = shapes<d>(peak.in_cell);
  Mat<3> difference = -law(peak.cell).cauchy(gradient(u, peak.cell, slopes_at(peak.cell, peak.in_cell)));
  for (std::size_t node = 0; node < own.size(); ++node)
    difference += N[static_cast<Eigen::Index>(node)] / counts[node] * sums[node];
  return von_mises(difference);
}

template <int d>
std::vector<Mat<3>> Solid<d>::nodal_stress(const Field& u) const {
  const auto nodes = static_cast<std::size_t>(mesh_.size());
  std::vector<Mat<3>> all(nodes, Mat<3>::Zero());
  for (int material = 0; material < static_cast<int>(materials_.size()); ++material) {
    std::vector<Mat<3>> sums(nodes, Mat<3>::Zero());
    std::vector<int> counts(nodes, 0);
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (int k = 0; k < cell_nodes<d> && part_[c] == material; ++k) {
        const auto a = static_cast<std::size_t>(mesh_.cells[c][static_cast<std::size_t>(k)]);
        sums[a] += stress_at_node(u, c, k);
        ++counts[a];
      }
    for (std::size_t a = 0; a < nodes; ++a)
      if (counts[a] > 0 && von_mises(sums[a] / counts[a]) >= von_mises(all[a])) all[a] = sums[a] / counts[a];
  }
  return all;
}

template <int d>
double Solid<d>::least_volume_ratio(const Field& u) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < points_.size(); ++p)
    least = std::min(least, gradient(u, p / rule<d>().size(), points_[p].slopes).determinant());
  return least;
}

template <int d>
Mat<d> Solid<d>::strain(const Field& u, const Place<d>& place) const {
  const auto cell = static_cast<std::size_t>(place.cell);
  const Mat<d> F = gradient(u, cell, slopes_at(cell, place.at));
  return 0.5 * (F.transpose() * F - Mat<d>::Identity());
}

template <int d>
Mat<3> Solid<d>::stress(const Field& u, const Place<d>& place) const {
  const auto cell = static_cast<std::size_t>(place.cell);
  return law(cell).cauchy(gradient(u, cell, slopes_at(cell, place.at)));
}

template <int d>
double Solid<d>::squared_difference(const Field& u, const std::function<Vec<d>(const Vec<d>&)>& exact) const {
  double sum = 0;
  const auto& points = rule<d>();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const std::size_t c = p / points.size();
    const auto& at = points[p % points.size()].at;
    sum += points_[p].weight * (of_cell(u, c) * shapes<d>(at) - exact(at_rest(c, at))).squaredNorm();
  }
  return sum;
}

template class Solid<2>;
template class Solid<3>;

}  // namespace splashdown::elastic
