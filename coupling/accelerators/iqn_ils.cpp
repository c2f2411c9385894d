#include <cstdint>
#include <istream>
#include <ostream>

#include "core/stored.hpp"
#include "coupling/accelerators/quasi_newton.hpp"

namespace splashdown::coupling {
namespace {

// Columns of past steps belong to another mesh: what they add to newer ones is worth having beyond a hundredth
// of their length, below that it is noise.
constexpr double kept_of_past = 1e-2;

}  // namespace

IqnIls::IqnIls(double factor, std::size_t reuse) : factor_(factor), reuse_(reuse) {}

void IqnIls::begin_step() {
  secants_.clear();
  residual_.resize(0);
}

Eigen::VectorXd IqnIls::next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) {
  const Eigen::VectorXd residual = image - x;
  if (residual_.size() == residual.size()) secants_.add({.residual = residual - residual_, .image = image - image_});
  residual_ = residual;
  image_ = image;
  Secants all = secants_;
  for (const auto& step : past_) all.append(step, kept_of_past);
  const auto explained = all.explain(residual);
  if (!explained) return x + factor_ * residual;
  return image - explained->image;
}

void IqnIls::commit_step() {
  if (reuse_ == 0 || secants_.size() == 0) return;
  past_.push_front(secants_);
  if (past_.size() > reuse_) past_.pop_back();
}

void IqnIls::save(std::ostream& out) const {
  const auto count = static_cast<std::int64_t>(past_.size());
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& step : past_) step.save(out);
}

void IqnIls::load(std::istream& in) {
  auto count = stored_count(in, sizeof(std::int64_t));  // of a step without pairs
  past_.clear();
  for (; in && count > 0; --count) past_.emplace_back().load(in);
  if (past_.size() > reuse_) past_.resize(reuse_);  // a run may go on with another reuse
}

}  // namespace splashdown::coupling
