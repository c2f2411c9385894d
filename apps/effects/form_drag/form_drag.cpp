#include "apps/effects/form_drag/form_drag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/effects/form_drag/shape_classes.hpp"
#include "apps/effects/theory/theory.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/read/reader.hpp"
#include "fluid/effects/form_drag/form_drag.hpp"

namespace splashdown::apps {
namespace {

constexpr double round_hulls_take =
    1.8;  // diameters until the flow behind a circle is separated (fluid/effects/form_drag)

double coefficient_of(const FormDrag& table, const Body& body) {
  const auto given = table.coefficients.find(body.name);
  return given == table.coefficients.end() ? shape_drag(body.shape).coefficient : given->second;
}

}  // namespace

void FormDragKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<FormDrag>();
  reader.numbers_by_name("coefficients", table.coefficients, "float = 1.2");
}

void FormDragKind::check(const Scene& scene, Problems& problems) const {
  const auto* table = scene.effects.find<FormDrag>();
  if (!table) return;
  if (scene.bodies.empty())
    problems.add("fluid.form_drag", "needs a [[body]]: it acts on hulls", "Add a body or remove the table.");
  std::vector<std::string> names;
  for (const auto& body : scene.bodies) names.push_back(body.name);
  constexpr double largest = 20;  // cups, and plates that swing (KC below 5), reach 4 to 10
  for (const auto& [name, value] : table->coefficients) {
    const auto key = "fluid.form_drag.coefficients." + name;
    if (problems.found_in(key)) continue;
    if (std::ranges::find(names, name) == names.end())
      problems.add_unknown(key, names);
    else if (!(value >= 0 && value <= largest))
      problems.add(key, fmt::format("must be from 0 to {:g}", largest),
                   "Use e.g. 1.2 for a circle, 2 for a plate across the flow; 0 for none.");
  }
}

// Facets cut off what lies between them and the hull, 0.45 (h/R)^2 of a sphere's volume: water at rest pushes so much less against
// 2.5, 4 and 6 elements on the radius (-6.2, -2.9, -1.2 %). What a body weighs in water is a small difference of two such forces.
void FormDragKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  constexpr double cut_off = 0.45, most = 0.05;
  if (!present(asked.scene) || asked.scene.dimension != 3) return;
  for (const auto& body : asked.scene.bodies) {
    const auto* sphere = std::get_if<SphereShape>(&body.shape);
    if (!sphere || !body.becomes_free() || body.without_mass || !asked.scene.fluid) continue;
    const double volume = shape_of<3>(body.shape).at_unit_density.mass;
    const double ratio = mass_properties<3>(body).mass / volume / asked.scene.fluid->density;
    const double lost = cut_off * std::pow(body.size / sphere->radius, 2), faster = 0.5 * lost / std::abs(ratio - 1);
    if (!(faster > most)) continue;
    questions.push_back(fmt::format(
        "body.{}.size = {:.3g} m: facets of {:.2g} elements on a radius hold {:.2g} % less than the sphere, so that it "
        "sinks or rises {:.2g} % too fast: did you mean {:.2g} m?",
        body.name, body.size, sphere->radius / body.size, 100 * lost, 100 * faster,
        body.size * std::sqrt(0.8 * most / faster)));
  }
}

std::optional<EffectNote> FormDragKind::note(const Scene& scene, const Scales& s) const {
  if (!scene.fluid || scene.bodies.empty() || s.length == 0) return {};
  const double ways = s.speed * scene.time.end / s.length;
  return EffectNote{"form_drag", present(scene),
                    fmt::format("U T/L = {:.3g} lengths in the run: drag of separated flow {}", ways,
                                ways < 1 ? "has no way to develop"
                                         : "counts for hulls under water or afloat so far, not in their first impact")};
}

std::optional<Advice> FormDragKind::advise(const Outlook& look) const {
  if (!look.scene.fluid) return {};
  auto advice = advise_form_drag(look);
  if (!present(look.scene) && !look.scene.bodies.empty()) advice.set = {"fluid.form_drag={}"};
  return advice;
}

template <int d>
void FormDragKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  const auto* table = scene.effects.find<FormDrag>();
  std::vector<fluid::FormDragSpec> hulls;
  for (const auto& body : scene.bodies)
    hulls.push_back(
        {.coefficient = coefficient_of(*table, body), .develops = shape_drag(body.shape).round ? round_hulls_take : 0});
  parts.fluid.push_back(std::make_unique<fluid::FormDrag<d>>(std::move(hulls), mirror_of(scene)));
}

template void FormDragKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void FormDragKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
