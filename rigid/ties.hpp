// What joints leave of the freedoms of bodies, found before a run from the conditions that its steps solve.
//
//   J u = b,   u = p + Z w      u: velocities of free coordinates at t = 0, turns times the body's reach [m/s]
//
// J has the rows that joints have at t = 0 (rigid/bullet_engine.hpp), each of length 1; b is what bodies that are held or
// prescribed, and held freedoms, ask for through them. Joints are taken in their order: one whose rows vanish on Z repeats
// the others, one that no w satisfies contradicts them. Rows are nothing below 1e-10, as in the steps (motions.hpp), so that
// what is found here is what the run does: two hinges whose axes miss each other by more hold a body fast.
// It is the rank at t = 0: of a linkage that is stretched straight then, motions that end at once count as motions.
#pragma once

#include <span>
#include <vector>

#include "rigid/body.hpp"
#include "rigid/joint.hpp"

namespace splashdown::rigid {

/// A free body without a motion of its own, and a least set of joints that take it, in their order.
struct HeldBody {
  std::size_t body = 0;                  ///< index
  std::vector<std::size_t> joints = {};  ///< indices, ascending
};

/// What is odd about the joints of a scene; indices of joints and bodies.
struct Ties {
  std::vector<std::size_t> repeated;  ///< joints that ask for nothing that others before them, or held freedoms, do not
  std::vector<std::size_t> contradicting;  ///< a least set of joints that no velocities satisfy together; empty: none
  std::vector<HeldBody> held;              ///< free bodies that joints hold fast
  std::vector<std::size_t>
      jolted;  ///< free bodies whose velocity at t = 0 their joints change by more than a thousandth
};

/// Throws std::invalid_argument for joints that tie nothing (check of joint.hpp).
template <int d>
Ties examine_ties(std::span<const BodySpec<d>> bodies, std::span<const JointSpec> joints);

}  // namespace splashdown::rigid
