// What one solve of a step works with.
#pragma once

#include <vector>

#include "core/response.hpp"
#include "core/status.hpp"
#include "fluid/pfem/contact/wall_motion.hpp"
#include "fluid/pfem/mesh/conservation/free_water.hpp"

namespace splashdown::fluid {

/// What a residual asks for: impulses A^-1 r, and how walls answer to them and to what effects have yet to give them.
template <int d>
struct Correction {
  std::vector<double> residual, impulse;
  std::vector<WallVelocity<d>> walls;
  Eigen::VectorXd answer;
  Eigen::VectorXd owed, owed_answer;  ///< impulses on modes, and (M + G)^-1 of them; empty: none

  /// r^T A^-1 r', and the same of what is owed to bodies
  double dot(const Correction& other) const {
    return of(residual).dot(of(other.impulse)) + owed.dot(other.owed_answer);
  }
  /// Adds a share of another one.
  void add(double share, const Correction& other) {
    of(residual) += share * of(other.residual);
    of(impulse) += share * of(other.impulse);
    for (std::size_t w = 0; w < walls.size(); ++w) walls[w] += share * other.walls[w];
    answer += share * other.answer;
    owed += share * other.owed, owed_answer += share * other.owed_answer;
  }

 private:
  static auto of(const std::vector<double>& v) {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  }
  static auto of(std::vector<double>& v) {
    return Eigen::Map<Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  }
};

/// What one solve works with.
template <int d>
struct Trial {
  std::vector<Vec<d>> v;                              ///< of nodes, before the pressure
  std::vector<Vec<d>> carried;                        ///< of nodes, before effects; empty: there are none
  std::vector<WallVelocity<d>> carried_walls;         ///< of walls, before effects
  typename FreeWater<d>::Moments free_water;          ///< what it has before the pressure
  std::vector<WallVelocity<d>> s_before;              ///< of walls, repaired
  std::vector<WallVelocity<d>> s_unloaded;            ///< of walls, before the pressure
  std::vector<Vec<d>> x_mid;                          ///< where a motion is judged
  std::vector<double> r, repaired;                    ///< residual, repair impulse
  std::vector<WallImpulse<d>> on_walls;               ///< impulses of effects
  std::vector<double> of_surface;                     ///< impulses of a pressure on the surface, of nodes; empty: none
  std::vector<WallImpulse<d>> handed, repair_handed;  ///< impulses of held nodes: physical, of the repair
  Eigen::VectorXd known, answer;  ///< impulses on the motions besides the pressure's, and what they did
  Eigen::VectorXd unanswered;     ///< impulses that the motions have yet to answer
  double energy_before = 0, energy_repaired = 0,
         energy_unloaded = 0;            ///< of v: as carried, repaired, before the pressure
  std::vector<double> phi, uncorrected;  ///< physical impulse, with and without the corrections
  std::vector<Vec<d>> v_after;           ///< of nodes, with the pressure
  std::vector<WallVelocity<d>> s_after;  ///< of walls
  typename WallMotion<d>::Moved moved;   ///< along the walls
  /// What an effect whose work is booked has changed in a kick.
  struct Booked {
    std::size_t effect;
    std::vector<Vec<d>> change;            ///< of velocities of nodes
    std::vector<WallImpulse<d>> on_walls;  ///< impulse
  };
  std::vector<Booked> booked;
  /// Of effects that the formulation solves for with the pressure: what of their work is in v and on_walls.
  struct Following {
    std::vector<Vec<d>> change;            ///< of velocities of nodes, before the pressure; empty: there are none
    std::vector<WallImpulse<d>> on_walls;  ///< impulse
    Eigen::VectorXd given;                 ///< impulse on modes, with what held nodes hand on
    Eigen::VectorXd answered;              ///< what of it they have answered to
  };
  Following following;
};

}  // namespace splashdown::fluid
