// The text of a scene, table by table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace splashdown::ensemble {

using Point = std::vector<double>;

class SceneText {
 public:
  SceneText& table(std::string_view name);  ///< [name]
  SceneText& list(std::string_view name);   ///< [[name]]
  SceneText& set(std::string_view key, double value);
  SceneText& set(std::string_view key, const Point& value);
  SceneText& word(std::string_view key, std::string_view value);  ///< in quotes
  SceneText& toml(std::string_view key, std::string_view value);  ///< as it is
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// "0.5", "[1, 2]", "[[0, 0], [1, 0]]" as TOML.
std::string toml_of(double value);
std::string toml_of(const Point& value);
std::string toml_of(const std::vector<Point>& value);

/// Water at rest up to the height 0 in an open tank. The last coordinate is the vertical one.
struct Basin {
  std::string title;
  double end = 1;
  double cfl = 0;  ///< 0: the default
  double half_width = 1;
  double half_breadth = 0;  ///< in space, along y; 0: half_width
  double depth = 1, air = 1;
  double surface = 0.1, far = 0.1, growth = 0.2, wetted_fraction = 0;
  int dimension = 2;

  double water() const;  ///< volume without bodies [m^d]
  /// From the title to the region. Everything after it may follow.
  SceneText scene() const;
};

}  // namespace splashdown::ensemble
