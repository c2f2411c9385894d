// Forces at points and tractions on patches of an elastic body, as functions of time.
#include "apps/effects/elastic/solid.hpp"
#include "apps/effects/force/force.hpp"
#include "apps/scene/geometry.hpp"
#include "elastic/loads/patch.hpp"
#include "rigid/forces/curve.hpp"

namespace splashdown::apps {
namespace {

using elastic::Field;
using elastic::ToneBurst;

/// A sum of fields, each with a factor that goes in time.
struct Push {
  std::vector<Field> nodes;  // of a unit along each component
  std::function<Eigen::VectorXd(double)> factors;
};

template <int values>
std::function<Eigen::VectorXd(double)> factors_of(const std::vector<std::vector<double>>& rows,
                                                  const std::optional<ToneBurst>& burst = {}) {
  std::vector<typename rigid::Curve<values>::Row> all;
  for (const auto& row : rows)
    all.push_back({row[0], Eigen::Map<const Eigen::Matrix<double, values, 1>>(row.data() + 1)});
  return [curve = rigid::Curve<values>(std::move(all)), burst](double t) -> Eigen::VectorXd {
    return (burst ? burst->at(t) : 1) * curve.at(t);
  };
}

template <int d>
elastic::OnPatch<d> on_patch(const ElasticRegion& region, const elastic::SolidMesh<d>& mesh) {
  return [region, roundoff = 1e-9 * elastic::extent(mesh)](const Vec<d>& X) {
    return covers(region, in_space<d>(X), roundoff);
  };
}

/// In the shape's frame, then turned into the world's.
template <int d>
Push push_of(const ElasticPatch& patch, const Body& body, const elastic::SolidMesh<d>& mesh) {
  const auto on = on_patch<d>(patch.region, mesh);
  const Mat<d> turn = shape_pose<d>(body).linear();
  Push push;
  const auto add = [&](const Field& force) {
    const Eigen::MatrixXd turned = turn * force.reshaped(d, mesh.size());
    push.nodes.emplace_back(turned.reshaped());
  };
  std::optional<ToneBurst> burst;
  if (patch.frequency) burst = ToneBurst{*patch.frequency, patch.cycles, patch.start};
  if (!patch.traction.empty()) {
    for (int k = 0; k < d; ++k)
      add(elastic::patch_force<d>(mesh, on, [k](const Vec<d>&, const Vec<d>&) -> Vec<d> { return Vec<d>::Unit(k); }));
    push.factors = factors_of<d>(patch.traction, burst);
  } else if (!patch.pressure.empty()) {
    add(elastic::patch_force<d>(mesh, on, [](const Vec<d>&, const Vec<d>& normal) -> Vec<d> { return -normal; }));
    push.factors = factors_of<1>(patch.pressure, burst);
  } else {
    add(elastic::stretch_force<d>(mesh, vec<d>(*patch.region.centre), *patch.region.radius));
    push.factors = factors_of<1>(patch.stretch, burst);
  }
  return push;
}

}  // namespace

template <int d>
bool meets_boundary(const ElasticPatch& patch, const elastic::SolidMesh<d>& mesh) {
  if (!patch.stretch.empty())
    return elastic::stretch_force<d>(mesh, vec<d>(*patch.region.centre), *patch.region.radius).squaredNorm() > 0;
  return elastic::patch_area<d>(mesh, on_patch<d>(patch.region, mesh)) > 0;
}

template <int d>
std::function<Field(double)> solid_loads(const Scene& scene, const ElasticTable& table, const elastic::Solid<d>& solid,
                                         const elastic::SolidMesh<d>& mesh) {
  std::vector<Push> pushes;
  if (const auto* tables = scene.effects.find<ForceTables>())
    for (const auto& force : tables->all) {
      if (force.body != table.body) continue;
      auto& push = pushes.emplace_back(Push{{}, factors_of<d>(force.force)});
      const auto place = place_in<d>(mesh, *force.point);
      for (int k = 0; k < d; ++k) push.nodes.push_back(solid.point_force(*place, Vec<d>::Unit(k)));
    }
  for (const auto& patch : table.patches) pushes.push_back(push_of<d>(patch, scene.bodies[table.body], mesh));
  if (pushes.empty()) return {};
  return [pushes, size = solid.size()](double t) {
    Field all = Field::Zero(size);
    for (const auto& push : pushes) {
      const auto factors = push.factors(t);
      for (std::size_t k = 0; k < push.nodes.size(); ++k)
        if (const double factor = factors[static_cast<Eigen::Index>(k)]; factor != 0) all += factor * push.nodes[k];
    }
    return all;
  };
}

template bool meets_boundary<2>(const ElasticPatch&, const elastic::SolidMesh<2>&);
template bool meets_boundary<3>(const ElasticPatch&, const elastic::SolidMesh<3>&);
template std::function<Field(double)> solid_loads<2>(const Scene&, const ElasticTable&, const elastic::Solid<2>&,
                                                     const elastic::SolidMesh<2>&);
template std::function<Field(double)> solid_loads<3>(const Scene&, const ElasticTable&, const elastic::Solid<3>&,
                                                     const elastic::SolidMesh<3>&);

}  // namespace splashdown::apps
