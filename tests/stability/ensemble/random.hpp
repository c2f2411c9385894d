// Random numbers that are the same everywhere: the standard's distributions are up to each library, and seeds of
// failures have to mean the same scene on all machines.
//
// Steele, Lea, Flood 2014 (SplitMix64): state += golden ratio, then a mix of the state. Numbers are rounded to six
// digits, so that neither the last bit of a machine's exp() nor the text of a scene makes a difference.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string_view>

namespace splashdown::ensemble {

/// What "%g" prints: the scene's text and the laws see one number.
inline double rounded(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return std::strtod(text, nullptr);
}

class Random {
 public:
  /// Classes of one seed have nothing to do with each other. FNV-1a of the name.
  Random(std::string_view name, std::uint64_t seed) : state_(14695981039346656037u) {
    for (const char c : name) state_ = (state_ ^ static_cast<unsigned char>(c)) * 1099511628211u;
    state_ ^= mixed(seed);
  }

  std::uint64_t bits() { return mixed(state_ += 0x9e3779b97f4a7c15u); }
  /// In [low, high), 53 bits.
  double uniform(double low, double high) {
    return rounded(low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53));
  }
  double log_uniform(double low, double high) { return rounded(std::exp(uniform(std::log(low), std::log(high)))); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  /// From low to high, both included. The bias of the remainder is 2^-60 for the small ranges of scenes.
  int integer(int low, int high) { return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1)); }
  template <class T>
  T pick(std::initializer_list<T> choices) {
    return choices.begin()[integer(0, static_cast<int>(choices.size()) - 1)];
  }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace splashdown::ensemble
