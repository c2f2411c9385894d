#include "apps/study/design/shares.hpp"

#include <boost/random/sobol.hpp>
#include <utility>

namespace splashdown::apps {
namespace {

using Shares = std::vector<std::vector<double>>;

/// One share in each of `number` equal parts, the parts in random order.
std::vector<double> stratified(int number, RandomShares random) {
  std::vector<double> shares;
  for (int i = 0; i < number; ++i) shares.push_back((i + random.share()) / number);
  for (std::size_t i = shares.size(); i > 1; --i)
    std::swap(shares[i - 1], shares[static_cast<std::size_t>(random.share() * static_cast<double>(i))]);
  return shares;
}

/// Sobol's sequence with direction numbers of Joe and Kuo (2008), each coordinate shifted bit by bit: still a digital net.
Shares sobol_shares(int number, int seed, const std::vector<std::string>& names) {
  boost::random::sobol sequence(names.size());
  std::vector<std::uint64_t> shift;
  for (const auto& name : names) shift.push_back(RandomShares(seed, name).next());
  Shares shares(names.size());
  for (int i = 0; i < number; ++i)
    for (std::size_t a = 0; a < names.size(); ++a)
      shares[a].push_back(static_cast<double>((sequence() ^ shift[a]) >> 11) * 0x1p-53);
  return shares;
}

Shares saltelli_shares(int number, int seed, const std::vector<std::string>& axes) {
  std::vector<std::string> twice = axes;
  for (const auto& axis : axes) twice.push_back(axis + "'");
  const auto both = sobol_shares(number, seed, twice);
  Shares shares(axes.size());
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const auto &first = both[a], &second = both[axes.size() + a];
    const auto add = [&](const std::vector<double>& block) {
      shares[a].insert(shares[a].end(), block.begin(), block.end());
    };
    add(first);
    add(second);
    for (std::size_t changed = 0; changed < axes.size(); ++changed) add(changed == a ? second : first);
  }
  return shares;
}

}  // namespace

RandomShares::RandomShares(int seed, const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const unsigned char c : name) hash = (hash ^ c) * 0x100000001b3;
  state_ = hash ^ (static_cast<std::uint64_t>(seed) * 0x9e3779b97f4a7c15);
}

std::uint64_t RandomShares::next() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

double RandomShares::share() { return static_cast<double>(next() >> 11) * 0x1p-53; }

Shares shares_of(Plan plan, int number, int seed, const std::vector<std::string>& axes) {
  if (axes.empty()) return {};
  if (plan == Plan::sobol) return sobol_shares(number, seed, axes);
  if (plan == Plan::saltelli) return saltelli_shares(number, seed, axes);
  Shares shares;
  for (const auto& axis : axes) {
    RandomShares random(seed, axis);
    if (plan == Plan::latin_hypercube) {
      shares.push_back(stratified(number, random));
    } else {
      auto& drawn = shares.emplace_back();
      for (int i = 0; i < number; ++i) drawn.push_back(random.share());
    }
  }
  return shares;
}

}  // namespace splashdown::apps
