// [body.elastic]: a body that deforms.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

/// A part of a body, held, loaded or of its own material: what a disc around `centre`, the box between `min` and `max`, or in the
/// plane a polygon covers; shape's frame.
struct ElasticRegion {
  std::optional<Point> centre;
  std::optional<double> radius;
  std::optional<Point> min, max;
  std::vector<Point> points;
};

struct ElasticClamp : ElasticRegion {
  std::vector<std::string> axes;              ///< of the world, along which it holds; empty: all
  std::vector<std::vector<double>> velocity;  ///< rows of a time and components [m/s]; empty: it stays
};

struct ElasticPoint {
  std::string name, path;                               ///< path of its table in messages
  Point point = Point::Zero();                          ///< undeformed, shape's frame [m]
  double mass = 0;                                      ///< of a point mass [kg, kg/m]
  std::vector<std::string> signals = {"displacement"};  ///< of a point that is looked at, of `elastic_signals`
};

/// A load on the boundary of a body within a region. Rows begin with a time [s]; one of the three lists has any.
struct ElasticPatch {
  ElasticRegion region;
  std::vector<std::vector<double>> traction;  ///< components, shape's frame at t = 0, per undeformed area [Pa]
  std::vector<std::vector<double>> pressure;  ///< against the outward normal at rest [Pa]
  std::vector<std::vector<double>>
      stretch;                      ///< of a bonded disc or strip, along its rim and away from its middle [N/m]
  std::optional<double> frequency;  ///< of a tone burst that the load is multiplied by [Hz]
  double cycles = 5;                ///< of the burst
  double start = 0;                 ///< of the burst [s]
};

/// A displacement, or a natural frequency, that is told with its error.
struct ElasticGoal {
  std::string path;             ///< of its table in messages
  std::string point;            ///< name of a point; empty: `mode`
  std::string direction = "y";  ///< world axis that the point is displaced along
  int mode = 0;                 ///< number of a natural frequency, 1 the lowest
};

/// What summary.json and tables call it.
inline std::string name_of(const ElasticGoal& goal, const std::string& body) {
  return goal.mode > 0 ? body + ".f" + std::to_string(goal.mode) : goal.point + ".u" + goal.direction;
}

/// Nine moduli of law = "orthotropic".
struct ElasticPly {
  std::vector<double> young_moduli;    ///< along the fibres, across them, along the normal [Pa]
  std::vector<double> poisson_ratios;  ///< nu_12, nu_13, nu_23
  std::vector<double> shear_moduli;    ///< G_12, G_13, G_23 [Pa]
  Point fibres = Point::UnitX();       ///< direction in the shape's frame
  Point normal = Point::UnitZ();       ///< the same; of plane scenes z
};

/// What a body or a part of it is made of.
struct ElasticMaterial {
  std::string law = "st_venant_kirchhoff";  ///< of `elastic_laws`
  double young_modulus = 0;                 ///< [Pa]
  double poisson_ratio = 0;                 ///< -1 to 1/2
  ElasticPly ply;                           ///< of law = "orthotropic"
};

/// A part of a body that is made of something else.
struct ElasticPart : ElasticMaterial {
  std::string name, path;  ///< path of its table in messages
  ElasticRegion region;
  std::optional<double> density;  ///< [kg/m^3]; empty: the body's
};

struct ElasticTable : ElasticMaterial {
  std::size_t body = 0;
  std::string path;                ///< of the table in messages
  std::optional<double> density;   ///< of what is no part; known in complete scenes whose body has a `whole`
  std::vector<ElasticPart> parts;  ///< later ones go before earlier ones
  double size = 0;                 ///< of elements [m], divided by Body::refine; of a mesh from a file what it is
  std::string mesh_file;           ///< of Gmsh, absolute; empty: the shape is meshed
  double mesh_scale = 1;           ///< metres per unit of the file
  std::string scheme = "generalised_alpha";  ///< of `elastic_schemes`
  double spectral_radius = 0.9;  ///< of generalised_alpha: five periods resolved by ten steps lose 1 % of a mode
  double shift = 1;              ///< of shifted_crank_nicolson [1/s]
  double mass_damping = 0;       ///< Rayleigh's alpha [1/s]
  double stiffness_damping = 0;  ///< Rayleigh's beta [s]
  std::vector<ElasticClamp> clamps;
  std::vector<ElasticPatch> patches;
  std::string start = "undeformed";  ///< or "equilibrium" with the loads of t = 0
  std::vector<ElasticPoint> point_masses, points;
  std::vector<ElasticGoal> goals;
  int adapt = 0;  ///< how often the mesh is refined for them before the run
  int modes = 0;  ///< natural frequencies that are told before the run
  /// Of the wall that a fluid presses on: all nodes, the `modes` lowest modes, or all nodes with modes in the exact term.
  std::string coordinates = "nodes";
};

struct ElasticTables {
  std::vector<ElasticTable> of_bodies;
};

/// Whether a body deforms.
inline bool deforms(const Scene& scene, std::size_t body) {
  const auto* tables = scene.effects.find<ElasticTables>();
  return tables && std::ranges::find(tables->of_bodies, body, &ElasticTable::body) != tables->of_bodies.end();
}

class ElasticKind final : public EffectOf<ElasticKind, ElasticTables> {
 public:
  std::string_view name() const override { return "elastic"; }
  TablePlace place() const override { return TablePlace::body; }
  bool knows_no_mesh() const override { return true; }  // its own rule speaks of all fluids
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  void complete(Scene& scene) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::vector<NamedNumber> numbers(const Scene& scene) const override;

 private:
  friend EffectOf;
};

}  // namespace splashdown::apps
