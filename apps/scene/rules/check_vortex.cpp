// Rules of a fluid on a grid: its extents, and bodies that it resolves and holds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/rules/check.hpp"

namespace splashdown::apps {
namespace {

constexpr double least_squares = 16, most_squares = 1 << 26;  // each way; in all, 10 GB
constexpr double rim = 6;                                     // squares around bodies, for the kernels
constexpr double least_width = 2;                             // squares across a body

/// The least distance of two parallel lines that a body lies between, one of them along one of its sides.
double width_of(const rigid::Surface<2>& outline) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < outline.facets.cols(); ++f) {
    const rigid::Vec<2> side = outline.vertices.col(outline.facets(1, f)) - outline.vertices.col(outline.facets(0, f));
    const Eigen::RowVectorXd across = rigid::Vec<2>(-side.y(), side.x()).normalized().transpose() * outline.vertices;
    least = std::min(least, across.maxCoeff() - across.minCoeff());
  }
  return least;
}

/// Sides that are walls have to be where the scene says.
void check_fours(const VortexFluid& fluid, const Point& size, Problems& problems) {
  constexpr double roundoff = 1e-6;
  for (int k = 0; k < 2; ++k) {
    const double fours = size[k] / 4;
    if (std::abs(fours - std::round(fours)) <= roundoff * fours) continue;
    return problems.add(
        "fluid.grid.size",
        fmt::format("a grid with slip sides is a multiple of four squares long and high, not {:g}", size[k]),
        fmt::format("Use e.g. {:.6g} m.", (fluid.max - fluid.min)[k] / (4 * std::ceil(fours))));
  }
}

void check_grid(const VortexFluid& fluid, bool has_tank, Problems& problems) {
  const Point size = (fluid.max - fluid.min) / fluid.size;
  if (size.head<2>().minCoeff() <= 0)
    problems.add("fluid.grid.max", "must lie above fluid.grid.min on every axis", "Swap them, or mend the signs.");
  else if (size.head<2>().minCoeff() < least_squares)
    problems.add("fluid.grid.size",
                 fmt::format("the grid must have {:g} squares or more each way, not {:g} x {:g}", least_squares,
                             std::round(size.x()), std::round(size.y())),
                 "Use smaller squares or a larger grid.");
  else if (size.x() * size.y() > most_squares)
    problems.add("fluid.grid.size",
                 fmt::format("the grid must have {:g} squares at most, not {:.3g}", most_squares, size.x() * size.y()),
                 "Use larger squares or a smaller grid.");
  else if (fluid.sides == "slip" && !has_tank)
    check_fours(fluid, size, problems);
}

void check_body(const VortexFluid& fluid, const Body& body, const std::string& label, Problems& problems) {
  rigid::Surface<2> hull;
  try {
    hull = outline<2>(body);
  } catch (const std::invalid_argument&) {  // the body's own check has reported it
    return;
  }
  const double width = width_of(hull);
  if (width < least_width * fluid.size)
    problems.add("fluid.grid.size",
                 fmt::format("{} is {:.3g} m across, less than two squares of {:g} m", label, width, fluid.size),
                 fmt::format("Use {:.2g} m or less, a twelfth of it for loads.", width / least_width));
  const auto box = extents<2>(hull);
  const double margin = rim * fluid.size;
  const Extents<2> inner(vec<2>(fluid.min).array() + margin, vec<2>(fluid.max).array() - margin);
  if (!inner.contains(box))
    problems.add(label + (body.path.empty() || body.oscillation ? ".position" : ".path"),
                 fmt::format("the body spans {} m and does not lie six squares or more inside the grid {} m",
                             text<2>(box), text<2>(Extents<2>(vec<2>(fluid.min), vec<2>(fluid.max)))),
                 "Move the body or enlarge fluid.grid.");
}

}  // namespace

void check_vortex(const Scene& scene, const SceneLabels& labels, Problems& problems) {
  const auto& fluid = *scene.vortex;
  for (const auto* kind : effect_kinds())
    if (kind->present(scene) && !kind->knows_no_mesh())
      problems.add(std::string(kind->name()), "needs a liquid with a free surface, fluid.formulation = \"fractional\"",
                   "Remove the table, or change the formulation.");
  if (scene.coupling && scene.coupling->interface_term != "rigid" && scene.coupling->interface_term != "none")
    problems.add("coupling.interface_term", "must be \"rigid\" or \"none\" with fluid.formulation = \"vortex\"",
                 "Use \"rigid\": one pass, stable for light bodies.");
  for (std::size_t i = 0; i < scene.records.size(); ++i)
    if (std::holds_alternative<ElevationEntry>(scene.records[i]))
      problems.add(labels.records[i] + ".kind", "there is no free surface with fluid.formulation = \"vortex\"",
                   "Remove the record.");
  if (problems.found_in("fluid.grid") || fluid.size <= 0) return;
  check_grid(fluid, scene.tank.has_value(), problems);
  if (problems.found_in("fluid.grid")) return;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (!problems.found_in(labels.bodies[i])) check_body(fluid, scene.bodies[i], labels.bodies[i], problems);
}

}  // namespace splashdown::apps
