// A scene that is stepped by hand: open, advance, look, save. What the command does with the same scene comes out, bit for bit.
//
//   auto simulation = Simulation::open("scene.toml");
//   while (simulation.advance())
//     std::printf("%g %g\n", simulation.time(), simulation.bodies()[0].position.y());
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace splashdown {
namespace apps {
struct SceneFile;
}

/// A body at t_n. World frame. In two dimensions vectors have no third entry but spins and moments, which have it alone; loads and
/// masses are per metre of depth.
struct BodyNow {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();              ///< of the centre of mass [m]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();          ///< body frame to world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();              ///< of the centre of mass [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();                  ///< angular velocity [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();          ///< of the centre of mass [m/s^2]
  Eigen::Vector3d angular_acceleration = Eigen::Vector3d::Zero();  ///< [rad/s^2]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();                 ///< of the fluid [N, N/m]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();                ///< of the fluid about the centre of mass [N m, N]
  double wetted = 0;                                               ///< area, in two dimensions length [m^2, m]
};

/// The fluid at t_n: views that are good until the next step is tried, and what has to be made for it. World frame; `d` entries a
/// node. Halves of symmetric scenes have the nodes of the half.
struct WaterNow {
  std::span<const double> positions;  ///< d a node [m]
  std::span<const double> pressure;   ///< [Pa]
  std::span<const int> cells;         ///< d + 1 nodes each
  std::vector<double> velocities;     ///< at t_n, d a node [m/s]
  std::vector<int> boundary;          ///< of the water: d nodes each, area vectors outward
  std::vector<int> walls;             ///< of boundary facets: number of the body, then the tank's; -1: free surface
  double volume = 0;                  ///< drops included [m^3, m^2]
  double kinetic = 0, potential = 0;  ///< energies [J, J/m]
};

/// Why a simulation cannot go on, with what may help.
class CannotGoOn : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What moves or pushes a body besides its scene.
struct SimulationHooks {
  /// Force and moment about the centre of mass, world frame [N, N m; 2D: N/m, N].
  struct Push {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  };
  /// Pose of the centre of mass.
  struct Pose {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  };
  struct Force {
    std::string body;
    /// Of time and of the body at t_n: name, position, rotation, velocity and spin; taken explicitly once a step.
    std::function<Push(double, const BodyNow&)> push;
  };
  struct Path {
    std::string body;                  ///< with motion = "prescribed"
    std::function<Pose(double)> pose;  ///< of time; begins where the scene puts the body
  };
  std::vector<Force> forces;
  std::vector<Path> paths;
};

/// Throws std::runtime_error with the texts of the command for scenes that are wrong, before anything is made.
class Simulation {
 public:
  /// The scene of a file, with texts `key=value` set in it.
  static Simulation open(const std::filesystem::path& scene, const std::vector<std::string>& set = {},
                         const SimulationHooks& hooks = {});
  /// The scene of a text; files that it names are looked for in `folder`.
  static Simulation of_text(const std::string& toml, const std::filesystem::path& folder = ".",
                            const std::vector<std::string>& set = {}, const SimulationHooks& hooks = {});
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// Commits the step that was tried last and tries the next one: then all of t_n is known. False, and nothing is done, at the
  /// end. Throws CannotGoOn.
  bool advance();
  /// To t_n = `time` or the end, whichever is first; false at the end.
  bool advance_to(double time);

  int dimension() const;                        ///< 2 or 3
  const std::string& title() const;             ///< of the scene
  const std::string& resolved() const;          ///< the scene as TOML with every value in force
  double time() const;                          ///< t_n [s]
  double end() const;                           ///< time.end of the scene [s]
  double dt() const;                            ///< of the step that was tried last [s]
  long steps() const;                           ///< committed
  int passes() const;                           ///< of the coupling in the step that was tried last
  std::vector<std::string> body_names() const;  ///< in the order of the scene
  /// After advance(); in the order of the scene.
  std::vector<BodyNow> bodies() const;
  /// After advance(); nothing in a scene without liquid.
  std::optional<WaterNow> water() const;
  /// Pressure at a point at t_n [Pa]; nothing outside of the water.
  std::optional<double> pressure_at(const Eigen::Vector3d& point) const;

  /// Writes the state at t_n into a folder, whole or not at all; the one before is kept.
  void save(const std::filesystem::path& folder);
  /// Goes back, or on, to what save() or a run of the command left there. Throws std::runtime_error for another scene's.
  void restore(const std::filesystem::path& folder);

 private:
  class State;
  template <int d>
  class StateOf;
  explicit Simulation(std::unique_ptr<State> state);
  static Simulation made(apps::SceneFile file, const SimulationHooks& hooks);
  std::unique_ptr<State> state_;
};

}  // namespace splashdown
