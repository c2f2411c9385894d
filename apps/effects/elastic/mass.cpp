// What elastic bodies weigh: their parts and point masses count.
#include "apps/effects/elastic/elastic.hpp"
#include "apps/effects/elastic/solid.hpp"
#include "apps/scene/geometry.hpp"

namespace splashdown::apps {
namespace {

/// Of the solid that is stepped.
template <int d>
WholeMass whole_mass(const Body& body, const ElasticTable& table) {
  const auto solid = make_solid<d>(body, table);
  const auto inverse = shape_pose<d>(body).inverse();
  const Vec<d> centre = solid->centre(elastic::Field::Zero(solid->size()));
  WholeMass whole{.mass = solid->total_mass(), .centre = in_space<d>(inverse * centre)};
  const Mat<d> turn = inverse.linear(), moments = turn * solid->second_moments() * turn.transpose();
  if constexpr (d == 2)
    whole.inertia(2, 2) = moments.trace();
  else
    whole.inertia = moments.trace() * Mat<d>::Identity() - moments;
  return whole;
}

}  // namespace

template <int d>
double density_of(const Body& body, const ElasticTable& table, const elastic::SolidMesh<d>& mesh) {
  return table.density ? *table.density : mass_properties<d>(body).mass / meshed_volume<d>(body, table, mesh);
}

void ElasticKind::complete(Scene& scene) const {
  for (auto& table : scene.effects.table<ElasticTables>().of_bodies) {
    if (table.parts.empty() && table.point_masses.empty()) continue;
    auto& body = scene.bodies[table.body];
    const auto fill = [&]<int d>() {
      table.density = density_of<d>(body, table, solid_mesh<d>(body, table));
      body.whole = whole_mass<d>(body, table);
    };
    scene.dimension == 2 ? fill.template operator()<2>() : fill.template operator()<3>();
  }
}

template double density_of<2>(const Body&, const ElasticTable&, const elastic::SolidMesh<2>&);
template double density_of<3>(const Body&, const ElasticTable&, const elastic::SolidMesh<3>&);

}  // namespace splashdown::apps
