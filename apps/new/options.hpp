// What `splashdown new` is told, as it stands on the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace splashdown::apps {

struct NewOptions {
  std::string hull;    ///< an STL or OBJ file; empty: `shape`
  std::string shape;   ///< a word of the scene: "capsule", "sphere" ...; empty: `hull`
  bool plane = false;  ///< two dimensions
  std::optional<double> radius, length, breadth, height, deadrise;  ///< of a shape [m, deg]
  std::string size;                                                 ///< of a box: "1.2,0.4,0.3" [m]
  std::optional<double> mass;                                       ///< [kg, kg/m]
  std::optional<double> sink;                                       ///< downward at the start [m/s]
  double forward = 0;                                               ///< along x [m/s]
  double pitch = 0, roll = 0;                                       ///< [deg]
  std::string units;                 ///< of the file: "mm", "cm", "in", "ft", "m"; empty: guessed
  std::optional<double> scale;       ///< metres per unit of the file, instead
  std::string nose = "x", up = "z";  ///< axes of the file: "x", "-x", "y" ...
  bool repair = false;
  std::string centre, inertia;      ///< "x,y,z" in the shape's frame [m]; [kg m^2]
  std::vector<std::string> points;  ///< "NAME=x,y,z" in the shape's frame [m]
  int panels = 3;
  std::optional<double> limit_g, limit_pressure;  ///< [g], [Pa]
  std::optional<double> end;                      ///< [s]
  std::optional<double> depth;                    ///< of the water [m]
  double accuracy = 2;                            ///< what walls and floor may do to the added mass [%]
  double density = 1000;                          ///< of the water [kg/m^3]
  std::string name;                               ///< of the body and the folder; empty: that of the file or the shape
  std::filesystem::path out;                      ///< folder of the scene; empty: `name`
  bool force = false;
  std::string command;  ///< as it was typed, for the scene's first lines

  int dimension() const { return plane ? 2 : 3; }
};

/// A command line that no scene follows from; the text names the option, the rule and the cure.
class NewError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What was decided and why: a line on the console, a comment in the scene.
struct Assumption {
  std::string about;  ///< "units", "tank" ...: where in the scene it stands
  std::string text;
};

}  // namespace splashdown::apps
