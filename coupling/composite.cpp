#include "coupling/composite.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace splashdown::coupling {
namespace {

/// Blocks along the diagonal.
void put_block(const Eigen::MatrixXd& block, Eigen::Index row, Eigen::Index column, Eigen::MatrixXd& all) {
  all.block(row, column, block.rows(), block.cols()) = block;
}

/// The directions of a part that restricts nothing, too.
Eigen::MatrixXd directions_of(const Response& part, const Eigen::MatrixXd& given) {
  const Eigen::Index modes = part.modal.modes.cols();
  if (!part.contacts.restrict_modes()) return Eigen::MatrixXd::Identity(modes, modes);
  return given.size() > 0 ? given : Eigen::MatrixXd(modes, 0);
}

/// Contacts of all parts; nothing where no part has any.
ClosedContacts joined(const std::vector<Response>& parts, Eigen::Index modes) {
  ClosedContacts all;
  const auto any = [&](const auto& has) { return std::ranges::any_of(parts, has); };
  if (!any([](const Response& part) { return part.contacts.restrict_modes(); })) return all;
  const bool rub = any([](const Response& part) { return part.contacts.workless.size() > 0; });
  Eigen::Index count = 0;
  for (const auto& part : parts) count += directions_of(part, part.contacts.directions).cols();
  all.directions = Eigen::MatrixXd::Zero(modes, count);
  all.known = Eigen::VectorXd::Zero(modes);
  if (rub) all.workless = all.directions;
  Eigen::Index row = 0, column = 0;
  for (const auto& part : parts) {
    const auto& [directions, known, workless] = part.contacts;
    const Eigen::MatrixXd along = directions_of(part, directions);
    put_block(along, row, column, all.directions);
    if (rub) put_block(workless.size() > 0 ? workless : along, row, column, all.workless);
    if (known.size() > 0) all.known.segment(row, known.size()) = known;
    row += part.modal.modes.cols();
    column += along.cols();
  }
  return all;
}

}  // namespace

Composite::Composite(std::vector<std::unique_ptr<StructurePart>> parts) : parts_(std::move(parts)) {
  if (parts_.empty()) throw std::invalid_argument("a composite structure has at least one part");
  for (const auto& part : parts_)
    if (!part || part->time() != parts_.front()->time())
      throw std::invalid_argument("parts of a structure are at the same time");
  see_walls();
  Eigen::Index count = 0;
  for (const auto& part : parts_) count += part->scales().size();
  scales_.resize(count);
  count = 0;
  for (const auto& part : parts_) {
    scales_.segment(count, part->scales().size()) = part->scales();
    count += part->scales().size();
  }
}

void Composite::see_walls() {
  walls_.clear();
  Eigen::Index first = 0;
  for (const auto& part : parts_) {
    for (auto wall : part->walls()) {
      wall.first += first;
      walls_.push_back(std::move(wall));
    }
    first += part->scales().size();
  }
}

template <class Each>
Eigen::VectorXd Composite::stacked(const Each& each) const {
  std::vector<Eigen::VectorXd> all;
  Eigen::Index at = 0, count = 0;
  for (const auto& part : parts_) {
    all.push_back(each(*part, at));
    at += part->scales().size();
    count += all.back().size();
  }
  Eigen::VectorXd sum(count);
  at = 0;
  for (const auto& values : all) {
    sum.segment(at, values.size()) = values;
    at += values.size();
  }
  return sum;
}

double Composite::stable_dt() const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& part : parts_) least = std::min(least, part->stable_dt());
  return least;
}

void Composite::save(std::ostream& out) const {
  for (const auto& part : parts_) part->save(out);
}
void Composite::load(std::istream& in) {
  for (const auto& part : parts_) part->load(in);
  see_walls();
}

std::string Composite::name() const {
  std::string all;
  for (const auto& part : parts_) all += (all.empty() ? "" : " and ") + part->name();
  return all;
}

double Composite::length() const {
  double longest = 0;
  for (const auto& part : parts_) longest = std::max(longest, part->length());
  return longest;
}

Eigen::VectorXd Composite::speeds(const Velocities& velocities) const {
  return stacked([&](const StructurePart& part, Eigen::Index at) -> Eigen::VectorXd {
    return part.speeds(velocities.segment(at, part.scales().size()));
  });
}

Velocities Composite::velocities() const {
  return stacked([](const StructurePart& part, Eigen::Index) -> Eigen::VectorXd { return part.velocities(); });
}

void Composite::begin(const Step& step) {
  for (const auto& part : parts_) part->begin(step);
}

Response Composite::response() const {
  std::vector<Response> each;
  Eigen::Index modes = 0;
  for (const auto& part : parts_) {
    each.push_back(part->response());
    modes += each.back().modal.modes.cols();
  }
  Response all;
  all.free.resize(scales_.size());
  all.modal.modes = Eigen::MatrixXd::Zero(scales_.size(), modes);
  all.modal.inertia = Eigen::MatrixXd::Zero(modes, modes);
  Eigen::Index row = 0, column = 0;
  for (const auto& part : each) {
    all.free.segment(row, part.free.size()) = part.free;
    put_block(part.modal.modes, row, column, all.modal.modes);
    put_block(part.modal.inertia, column, column, all.modal.inertia);
    row += part.free.size();
    column += part.modal.modes.cols();
  }
  all.contacts = joined(each, modes);
  return all;
}

const Velocities& Composite::solve(const Impulse& impulse) {
  Eigen::Index at = 0;
  trial_.resize(scales_.size());
  for (const auto& part : parts_) {
    const auto count = part->scales().size();
    trial_.segment(at, count) = part->solve(impulse.segment(at, count));
    at += count;
  }
  return trial_;
}

const Velocities& Composite::adopt(const Velocities& velocities) {
  Eigen::Index at = 0;
  trial_.resize(scales_.size());
  for (const auto& part : parts_) {
    const auto count = part->scales().size();
    trial_.segment(at, count) = part->adopt(velocities.segment(at, count));
    at += count;
  }
  return trial_;
}

bool Composite::update_contacts(const Impulse& impulse) {
  bool changes = false;
  Eigen::Index at = 0;
  for (const auto& part : parts_) {
    changes |= part->update_contacts(impulse.segment(at, part->scales().size()));
    at += part->scales().size();
  }
  return changes;
}

Placement Composite::placement() const {
  return stacked([](const StructurePart& part, Eigen::Index) -> Eigen::VectorXd { return part.placement(); });
}

void Composite::see_wetted(const Eigen::VectorXd& measures) {
  Eigen::Index at = 0;
  for (const auto& part : parts_) {
    const auto count = static_cast<Eigen::Index>(part->walls().size());
    part->see_wetted(measures.segment(at, count));
    at += count;
  }
}

Status Composite::acceptable() const {
  for (const auto& part : parts_)
    if (auto status = part->acceptable(); !status.ok()) return status;
  return {};
}

void Composite::commit() {
  for (const auto& part : parts_) part->commit();
  see_walls();
}

}  // namespace splashdown::coupling
