// What acts on one of two halves that a plane of symmetry makes of bodies.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "rigid/forces/force.hpp"

namespace splashdown::rigid {

/// Half of another force, which sees the whole bodies: twice the mass, inertia and wetted share of these.
template <int d>
class HalfForce final : public Force<d> {
 public:
  /// The force on whole bodies; not null.
  explicit HalfForce(std::unique_ptr<Force<d>> of_whole) : of_whole_(std::move(of_whole)) {}
  std::string name() const override { return of_whole_->name(); }
  void add(const BodiesAt<d>& at, std::span<Wrench<d>> wrenches) const override {
    std::vector<Wrench<d>> whole(wrenches.size(), Wrench<d>::Zero());
    look(at, [&](const BodiesAt<d>& seen) { of_whole_->add(seen, whole); });
    for (std::size_t b = 0; b < whole.size(); ++b) wrenches[b] += 0.5 * whole[b];
  }
  bool is_of_velocity() const override { return of_whole_->is_of_velocity(); }
  void pull(const BodiesAt<d>& at, std::vector<Pull<d>>& pulls) const override {
    const std::size_t before = pulls.size();
    look(at, [&](const BodiesAt<d>& seen) { of_whole_->pull(seen, pulls); });
    for (std::size_t p = before; p < pulls.size(); ++p) pulls[p].impulse *= 0.5, pulls[p].inertia *= 0.5;
  }
  void commit(const BodiesAt<d>& at) override {
    look(at, [&](const BodiesAt<d>& seen) { of_whole_->commit(seen); });
  }
  void save(std::ostream& out) const override { of_whole_->save(out); }
  void load(std::istream& in) override { of_whole_->load(in); }
  double stable_dt(const BodiesAt<d>& at) const override {
    double dt = 0;
    look(at, [&](const BodiesAt<d>& seen) { dt = of_whole_->stable_dt(seen); });
    return dt;
  }
  std::vector<Diagnostic> diagnostics(const BodiesAt<d>& at) const override {
    std::vector<Diagnostic> found;
    look(at, [&](const BodiesAt<d>& seen) { found = of_whole_->diagnostics(seen); });
    return found;
  }

 private:
  template <class Use>
  void look(const BodiesAt<d>& at, const Use& use) const {
    if (specs_.empty()) {
      specs_.assign(at.specs.begin(), at.specs.end());
      for (auto& spec : specs_) spec.mass *= 2, spec.inertia *= 2;
    }
    std::vector<double> wetted(at.wetted_share.begin(), at.wetted_share.end());
    for (double& share : wetted) share = std::min(1.0, 2 * share);
    BodiesAt<d> seen = at;
    seen.specs = specs_;
    seen.wetted_share = wetted;
    use(seen);
  }

  std::unique_ptr<Force<d>> of_whole_;
  mutable std::vector<BodySpec<d>> specs_;  // of whole bodies, which stay as they were made
};

}  // namespace splashdown::rigid
