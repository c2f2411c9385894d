#include "coupling/accelerators/pass_slope.hpp"

#include <stdexcept>
#include <vector>

#include "core/dense.hpp"

namespace splashdown::coupling {
namespace {

/// Walls that answer, and where their coordinates stand among those of all.
struct Answering {
  std::vector<std::size_t> walls;
  std::vector<WallCoordinates> coordinates;
  Eigen::Index count = 0;  // of coordinates
};

Answering answering(const StructurePart& structure) {
  Answering some;
  for (std::size_t w = 0; w < structure.walls().size(); ++w) {
    const auto& wall = structure.walls()[w];
    if (!wall.answers) continue;
    some.walls.push_back(w);
    some.coordinates.push_back(wall);
    some.count += wall.count;
  }
  return some;
}

/// Velocity change of the whole structure per unit impulse on the walls that answer.
Eigen::MatrixXd compliance(const StructurePart& structure, const Answering& some) {
  const Response all = structure.response();
  const bool restricted = all.contacts.restrict_modes();
  const Eigen::MatrixXd modes =
      restricted ? Eigen::MatrixXd(all.modal.modes * all.contacts.directions) : all.modal.modes;
  const Eigen::MatrixXd inertia =
      restricted ? algebra::congruence(all.modal.inertia, all.contacts.directions) : all.modal.inertia;
  Eigen::MatrixXd of_some(modes.cols(), some.count);
  Eigen::Index at = 0;
  for (const auto& wall : some.coordinates) {
    of_some.middleCols(at, wall.count) = modes.middleRows(wall.first, wall.count).transpose();
    at += wall.count;
  }
  return modes * algebra::symmetric_solution(inertia, of_some);
}

}  // namespace

Eigen::MatrixXd pass_slope(const FluidPart& fluid, const StructurePart& structure) {
  if (!fluid.linearised()) throw std::invalid_argument("coupling: this fluid knows no slope; use another accelerator");
  const Answering some = answering(structure);
  const Eigen::Index all = structure.scales().size();
  const auto pieces = static_cast<Eigen::Index>(fluid.pieces().size());

  const Eigen::MatrixXd of_fluid = fluid.linearised()->slope(some.walls);
  const Eigen::MatrixXd of_structure = compliance(structure, some);
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(all + pieces, all + pieces);
  const auto set_columns = [&](Eigen::Index to, Eigen::Index from, Eigen::Index count) {
    slope.block(0, to, all, count) = of_structure * of_fluid.block(0, from, some.count, count);
    slope.block(all, to, pieces, count) = of_fluid.block(some.count, from, pieces, count);
  };
  Eigen::Index from = 0;
  for (const auto& wall : some.coordinates) {
    set_columns(wall.first, from, wall.count);
    from += wall.count;
  }
  set_columns(all, some.count, pieces);
  return slope;
}

}  // namespace splashdown::coupling
