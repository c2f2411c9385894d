#include "coupling/accelerators/secants.hpp"

#include <cmath>
#include <cstdint>
#include <istream>
#include <ostream>
#include <utility>

#include "core/stored.hpp"

namespace splashdown::coupling {
namespace {

void write(std::ostream& out, const Eigen::VectorXd& v) {
  const auto size = static_cast<std::int64_t>(v.size());
  out.write(reinterpret_cast<const char*>(&size), sizeof size);
  out.write(reinterpret_cast<const char*>(v.data()), size * static_cast<std::streamsize>(sizeof(double)));
}

void read(std::istream& in, Eigen::VectorXd& v) {
  v.resize(static_cast<Eigen::Index>(stored_count(in, sizeof(double))));
  in.read(reinterpret_cast<char*>(v.data()), v.size() * static_cast<std::streamsize>(sizeof(double)));
}

}  // namespace

bool Secants::add(Secant pair) {
  const double squared = pair.residual.squaredNorm();
  if (!(squared > 0) || !std::isfinite(squared) || !pair.image.allFinite()) return false;
  pairs_.push_front(std::move(pair));
  return true;
}

void Secants::append(const Secants& older, double kept) {
  for (const auto& pair : older.pairs_) pairs_.push_back({pair.residual, pair.image, kept});
}

void Secants::keep_newest(std::size_t count) {
  if (pairs_.size() > count) pairs_.resize(count);
}

std::optional<Secant> Secants::explain(const Eigen::VectorXd& residual) {
  // Gram-Schmidt with a second sweep; W is carried along, so that no triangular system is left to solve.
  std::deque<Secant> independent, orthonormal;
  for (auto& pair : pairs_) {
    if (pair.residual.size() != residual.size()) continue;
    Secant q = pair;
    const double length = q.residual.norm();
    for (int sweep = 0; sweep < 2; ++sweep)
      for (const auto& o : orthonormal) {
        const double share = o.residual.dot(q.residual);
        q.residual -= share * o.residual;
        q.image -= share * o.image;
      }
    const double rest = q.residual.norm();
    if (!(rest > pair.kept * length)) continue;
    q.residual /= rest;
    q.image /= rest;
    orthonormal.push_back(std::move(q));
    independent.push_back(std::move(pair));
  }
  pairs_ = std::move(independent);
  if (orthonormal.empty()) return {};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(residual.size());
  Secant explained{.residual = zero, .image = zero};
  for (const auto& o : orthonormal) {
    const double share = o.residual.dot(residual);
    explained.residual += share * o.residual;
    explained.image += share * o.image;
  }
  if (!explained.residual.allFinite() || !explained.image.allFinite()) return {};
  return explained;
}

void Secants::save(std::ostream& out) const {
  const auto count = static_cast<std::int64_t>(pairs_.size());
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& pair : pairs_) write(out, pair.residual), write(out, pair.image);
}

void Secants::load(std::istream& in) {
  auto count = stored_count(in, 2 * sizeof(std::int64_t));  // a pair: two lengths at least
  pairs_.clear();
  for (; in && count > 0; --count) {
    auto& pair = pairs_.emplace_back();
    read(in, pair.residual), read(in, pair.image);
  }
}

}  // namespace splashdown::coupling
