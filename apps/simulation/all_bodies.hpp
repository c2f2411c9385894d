// Bodies of two kinds as one list.
#pragma once

#include "core/bodies_view.hpp"

namespace splashdown::apps {

/// Those of one view, then those of another.
template <int d>
class AllBodies final : public BodiesView<d> {
 public:
  /// Keeps both, which outlive it.
  AllBodies(const BodiesView<d>& first, const BodiesView<d>& second) : first_(first), second_(second) {}
  std::size_t size() const override { return first_.size() + second_.size(); }
  const BodySpec<d>& spec(std::size_t body) const override {
    return body < first_.size() ? first_.spec(body) : second_.spec(body - first_.size());
  }
  const BodyState<d>& state(std::size_t body) const override {
    return body < first_.size() ? first_.state(body) : second_.state(body - first_.size());
  }
  std::vector<Diagnostic> diagnostics() const override {
    auto all = first_.diagnostics();
    for (auto& other : second_.diagnostics()) all.push_back(std::move(other));
    return all;
  }

 private:
  const BodiesView<d>&first_, &second_;
};

}  // namespace splashdown::apps
