#include "apps/effects/aero/aero.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/effects/wind/wind.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/read/parts.hpp"
#include "rigid/forces/aero/aero.hpp"

namespace splashdown::apps {
namespace {

constexpr double standard_air = 1.225;  // [kg/m^3]

/// Whether moments need the length.
bool turns(const AeroTable& table) { return !table.moment.empty() || table.pitch_damping != 0; }
bool turns_in_space(const AeroTable& table) {
  return !table.roll.empty() || !table.yaw.empty() || table.roll_damping != 0 || table.yaw_damping != 0;
}

void read_axes(Reader& reader, AeroTable& table, int dimension) {
  table.up = Point::Unit(dimension - 1);
  const std::string cure = "Use a direction in the shape's frame, e.g. ";
  reader.point("nose", table.nose,
               any("", cure + (dimension == 2 ? "[-1.0, 0.0] for a nose on the left." : "[1.0, 0.0, 0.0].")));
  reader.point("up", table.up, any("", cure + axis_example(dimension, 1) + "."));
  constexpr double least = 1e-6;  // sine of the angle between both
  auto& problems = reader.context().problems;
  if (!(table.nose.norm() > 0))
    problems.add(reader.key("nose"), "must not be zero", cure + "[1.0, 0.0].");
  else if (!(table.nose.normalized().cross(table.up).norm() > least * table.up.norm()))
    problems.add(reader.key("up"), "must be across the nose", cure + axis_example(dimension, 1) + ".");
}

void read_sideslip(Reader& reader, AeroTable& table, const Rule& coefficient) {
  if (reader.context().dimension == 2) return;
  reader.curve("side", table.side, 2, coefficient);
  reader.curve("roll", table.roll, 2, coefficient);
  reader.curve("yaw", table.yaw, 2, coefficient);
  reader.curve("sideslip_drag", table.sideslip_drag, 2, coefficient);
  const Rule damping = within(-1000, 0, "", "Use a derivative by p b/2V or r b/2V, e.g. -0.4; damping is negative.");
  reader.number("roll_damping", table.roll_damping, damping);
  reader.number("yaw_damping", table.yaw_damping, damping);
}

template <int values>
rigid::Curve<values> curve(const Coefficient& rows, double unit) {
  std::vector<typename rigid::Curve<values>::Row> all;
  for (const auto& row : rows) all.push_back({unit * row[0], Eigen::Matrix<double, values, 1>(row[1])});
  return rigid::Curve<values>(std::move(all));
}

template <int d>
rigid::AeroSpec<d> aero_of(const AeroTable& table, const Body& body) {
  rigid::AeroSpec<d> spec;
  spec.body = table.body;
  spec.density = table.density;
  spec.area = table.area;
  spec.length = table.length.value_or(1);
  spec.span = table.span.value_or(1);
  spec.nose = vec<d>(table.nose).normalized();
  spec.up = (vec<d>(table.up) - spec.nose.dot(vec<d>(table.up)) * spec.nose).normalized();
  if (table.point) spec.point = vec<d>(*table.point) - mass_properties<d>(body).centre;
  const auto over_angle = [](const Coefficient& rows) { return curve<1>(rows, radians); };
  spec.drag = over_angle(table.drag);
  spec.lift = over_angle(table.lift);
  spec.moment = over_angle(table.moment);
  spec.side = over_angle(table.side);
  spec.roll = over_angle(table.roll);
  spec.yaw = over_angle(table.yaw);
  spec.sideslip_drag = over_angle(table.sideslip_drag);
  spec.roll_damping = table.roll_damping;
  spec.pitch_damping = table.pitch_damping;
  spec.yaw_damping = table.yaw_damping;
  return spec;
}

/// rho U^2 A/2 over the weight, A: the body's largest side times its depth.
template <int d>
std::optional<double> load_over_weight(const Scene& scene, const Scales& s) {
  for (const auto& body : scene.bodies) {
    if (!body.becomes_free() || !(s.gravity > 0)) continue;
    const rigid::Vec<d> sizes = extents<d>(outline<d>(body)).sizes();
    const double mass = mass_properties<d>(body).mass, side = sizes.maxCoeff();
    const double area = d == 2 ? side : sizes.prod() / sizes.minCoeff();
    return 0.5 * standard_air * s.speed * s.speed * area / (mass * s.gravity);
  }
  return {};
}

}  // namespace

void AeroKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<AeroTables>().of_bodies.emplace_back();
  const bool plane = scene.dimension == 2;
  table.body = scene.bodies.size() - 1;
  reader.number("density", table.density, positive("kg/m^3", "Leave it out for air at sea level."));
  reader.number("area", table.area,
                positive(plane ? "m" : "m^2", plane ? "Use the area for each metre of depth, e.g. the chord of a wing."
                                                    : "Use the area that the coefficients refer to."),
                Need::required);
  reader.number("length", table.length, positive("m", "Use the length that moments refer to, e.g. the chord."));
  if (!plane) reader.number("span", table.span, positive("m", "Use the span of the wing."));
  read_axes(reader, table, scene.dimension);
  reader.point("point", table.point, place_rule(scene.dimension));
  const Rule coefficient =
      any("", "Use a number, or rows of an angle in degrees and a value: [[-10, -0.6], [10, 0.9]].");
  reader.curve("drag", table.drag, 2, coefficient);
  reader.curve("lift", table.lift, 2, coefficient);
  reader.curve("moment", table.moment, 2, coefficient);
  reader.number("pitch_damping", table.pitch_damping,
                within(-1000, 0, "", "Use the derivative by q c/2V, e.g. -12; damping is negative."));
  read_sideslip(reader, table, coefficient);
  auto& problems = reader.context().problems;
  if (reader.context().sketch || problems.found_in(reader.path())) return;
  if (turns(table) && !table.length)
    problems.add_missing(reader.key("length"), "moment and pitch_damping refer to a length", "Add e.g. the chord.");
  if (turns_in_space(table) && !table.span)
    problems.add_missing(reader.key("span"), "moments of roll and yaw refer to a span", "Add that of the wing.");
  const auto is_negative = [](const auto& row) { return row[1] < 0; };
  if (std::ranges::any_of(table.drag, is_negative))
    problems.add(reader.key("drag"), "must not be negative: it would push",
                 "Mind the sign; drag acts against the motion.");
}

// Stalled at the latest; beyond that a table that ends holds its last value.
void AeroKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  constexpr double steepest = 0.15;  // 1/deg; a thin wing without ends has 2 pi/rad = 0.11
  const auto* tables = asked.scene.effects.find<AeroTables>();
  if (!tables) return;
  for (const auto& table : tables->of_bodies)
    for (std::size_t i = 1; i < table.lift.size(); ++i) {
      const auto &before = table.lift[i - 1], &row = table.lift[i];
      const double slope = (row[1] - before[1]) / (row[0] - before[0]);
      if (std::abs(slope) <= steepest) continue;
      questions.push_back(
          fmt::format("body.{}.aero.lift: {:.3g} for each degree; no wing has more than 0.11: are the "
                      "angles in radians? They are in degrees",
                      asked.scene.bodies[table.body].name, slope));
      break;
    }
}

std::optional<EffectNote> AeroKind::note(const Scene& scene, const Scales& s) const {
  const auto load = scene.dimension == 2 ? load_over_weight<2>(scene, s) : load_over_weight<3>(scene, s);
  if (!load && !present(scene)) return {};
  return EffectNote{
      "aero", present(scene),
      load ? fmt::format("rho_air U^2 A/(2 m g) = {:.3g}: air load over weight, at a coefficient of 1", *load)
           : std::string("loads of the air on bodies")};
}

// In space a body that flies in the plane has an angle of attack and no sideslip. In the plane its nose has a mirror image of its own.
template <int d>
std::optional<std::string> AeroKind::asymmetry_in(const Scene& scene, const Mirror& mirror) const {
  for (const auto& table : scene.effects.find<AeroTables>()->of_bodies) {
    const auto& body = scene.bodies[table.body];
    const auto spec = aero_of<d>(table, body);
    const auto pose = shape_pose<d>(body);
    if (const auto off = off_plane<d>(mirror, body, mass_properties<d>(body).centre + spec.point))
      return fmt::format("acts on '{}' {:g} m off the plane", body.name, *off);
    const auto acts = [](const rigid::Curve<1>& curve, double at) { return !curve.empty() && curve.at(at)[0] != 0; };
    if constexpr (d == 3) {
      if (std::abs((pose.linear() * spec.nose)[mirror.axis]) > written_digits ||
          std::abs((pose.linear() * spec.up)[mirror.axis]) > written_digits)
        return fmt::format("has nose or up of '{}' off the plane", body.name);
      if (acts(spec.side, 0) || acts(spec.roll, 0) || acts(spec.yaw, 0))
        return fmt::format("pushes '{}' aside without sideslip", body.name);
    } else {
      const auto any = [](const Coefficient& rows) {
        return std::ranges::any_of(rows, [](const std::vector<double>& row) { return row.back() != 0; });
      };
      if (any(table.lift) || any(table.moment)) return fmt::format("lifts or turns '{}' to one side", body.name);
    }
  }
  return {};
}

std::optional<std::string> AeroKind::asymmetry(const Scene& scene, const Mirror& mirror) const {
  return scene.dimension == 2 ? asymmetry_in<2>(scene, mirror) : asymmetry_in<3>(scene, mirror);
}

template <int d>
void AeroKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  std::vector<rigid::AeroSpec<d>> specs;
  for (const auto& table : scene.effects.find<AeroTables>()->of_bodies)
    specs.push_back(aero_of<d>(table, scene.bodies[table.body]));
  std::optional<rigid::Wind<d>> wind;
  if (const auto* table = scene.effects.find<WindTable>()) wind = wind_of<d>(*table, scene);
  parts.forces.push_back(std::make_unique<rigid::Aero<d>>(std::move(specs), std::move(wind)));
}

template void AeroKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void AeroKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
