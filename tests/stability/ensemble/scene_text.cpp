#include "tests/stability/ensemble/scene_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tests/stability/ensemble/random.hpp"

namespace splashdown::ensemble {

std::string toml_of(double value) { return fmt::format("{:.6g}", value); }

std::string toml_of(const Point& value) {
  std::string text = "[";
  for (const double x : value) text += (text.size() > 1 ? ", " : "") + toml_of(x);
  return text + "]";
}

std::string toml_of(const std::vector<Point>& value) {
  std::string text = "[";
  for (const Point& x : value) text += (text.size() > 1 ? ", " : "") + toml_of(x);
  return text + "]";
}

SceneText& SceneText::table(std::string_view name) {
  text_ += fmt::format("\n[{}]\n", name);
  return *this;
}

SceneText& SceneText::list(std::string_view name) {
  text_ += fmt::format("\n[[{}]]\n", name);
  return *this;
}

SceneText& SceneText::set(std::string_view key, double value) { return toml(key, toml_of(value)); }
SceneText& SceneText::set(std::string_view key, const Point& value) { return toml(key, toml_of(value)); }
SceneText& SceneText::word(std::string_view key, std::string_view value) {
  return toml(key, fmt::format("\"{}\"", value));
}

SceneText& SceneText::toml(std::string_view key, std::string_view value) {
  text_ += fmt::format("{} = {}\n", key, value);
  return *this;
}

double Basin::water() const {
  const double breadth = dimension == 3 ? 2 * rounded(half_breadth > 0 ? half_breadth : half_width) : 1;
  return 2 * rounded(half_width) * breadth * rounded(depth);
}

SceneText Basin::scene() const {
  Point low(static_cast<std::size_t>(dimension), -half_width), high(low.size(), half_width), top = high;
  if (dimension == 3 && half_breadth > 0) low[1] = -half_breadth, high[1] = top[1] = half_breadth;
  low.back() = -depth, high.back() = 0, top.back() = air;
  SceneText s;
  s.word("title", title);
  if (dimension != 2) s.set("dimension", dimension);
  s.table("time").set("end", end);
  if (cfl > 0) s.set("cfl", cfl);
  s.table("gravity");
  s.table("tank").set("min", low).set("max", top);
  s.table("fluid").set("density", 1000.0);
  s.table("fluid.size").set("surface", surface).set("far", far).set("growth", growth);
  if (wetted_fraction > 0) s.set("wetted_fraction", wetted_fraction);
  s.list("fluid.region").word("shape", "box").set("min", low).set("max", high);
  return s;
}

}  // namespace splashdown::ensemble
