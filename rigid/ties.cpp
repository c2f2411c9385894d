#include "rigid/ties.hpp"

#include <algorithm>
#include <numeric>

#include "core/dense.hpp"
#include "rigid/bullet_engine.hpp"
#include "rigid/constraints/constraint_solver.hpp"
#include "rigid/embedding.hpp"

namespace splashdown::rigid {

namespace {

using Joints = std::vector<std::size_t>;

constexpr double digits = 1e-3;  // of velocities, that people write

/// Rows of one joint in the free coordinates, and what is asked of them.
struct Rows {
  Eigen::MatrixXd left;
  Eigen::VectorXd right;
};

/// What the joints that were added so far leave.
class Left {
 public:
  explicit Left(Eigen::Index coordinates)
      : point(Eigen::VectorXd::Zero(coordinates)), motions(Eigen::MatrixXd::Identity(coordinates, coordinates)) {}

  enum class Answer { ties, repeats, contradicts };
  Answer add(const Rows& rows) {
    const Eigen::MatrixXd on_motions = rows.left * motions;
    const Eigen::VectorXd lacking = rows.right - rows.left * point;
    const double largest = on_motions.norm();
    const bool repeats = largest <= negligible;
    Eigen::VectorXd rest = lacking;
    if (!repeats) {
      const auto found = algebra::solutions_of(on_motions, lacking, std::min(1., negligible / largest));
      rest -= on_motions * found.point;
      point += motions * found.point;
      motions = (motions * found.directions).eval();
    }
    if (rest.norm() > digits * (rows.right.norm() + point.norm())) return Answer::contradicts;
    return repeats ? Answer::repeats : Answer::ties;
  }

  Eigen::VectorXd point;    // p
  Eigen::MatrixXd motions;  // Z, orthonormal
};

template <int d>
class Examined {
 public:
  Examined(std::span<const BodySpec<d>> bodies, std::span<const JointSpec> joints) : bodies_(bodies), joints_(joints) {
    for (const auto& joint : joints) check(joint, bodies.size());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto& body = bodies[b];
      unit_.push_back(Twist<d>::Ones());
      unit_.back().template tail<rotations<d>>().setConstant(reach<d>(body));
      for (int k = 0; k < freedoms<d>; ++k)
        free_.push_back(body.motion == BodyMotion::free && body.free[static_cast<std::size_t>(k)]);
    }
    for (const auto& joint : joints) conditions_.push_back(conditions_of(joint));
    find_groups();
  }

  Ties ties() const {
    Ties all;
    for (const auto& group : groups_) add_group(group, all);
    std::ranges::sort(all.repeated);
    return all;
  }

 private:
  struct Group {
    std::vector<std::size_t> bodies;  // free ones that joints tie to each other
    Joints joints;
    Eigen::Index coordinates = 0;
    std::vector<Eigen::Index> place;  // of each coordinate of all bodies; -1: not in it
  };

  std::vector<Condition<3>> conditions_of(const JointSpec& joint) const {
    BulletEngine world;
    for (const auto& body : bodies_) {
      world.add(body.motion == BodyMotion::free);
      world.place(static_cast<std::size_t>(&body - bodies_.data()), embedded<d>(body.pose), Twist<3>::Zero());
    }
    world.add(joint);
    return world.conditions(1);
  }

  bool is_free(std::size_t body) const { return bodies_[body].motion == BodyMotion::free; }

  void find_groups() {
    std::vector<std::size_t> of(bodies_.size());
    std::iota(of.begin(), of.end(), std::size_t{0});
    for (const auto& joint : joints_)
      if (joint.other && is_free(joint.body) && is_free(*joint.other))
        std::ranges::replace(of, std::size_t{of[joint.body]}, std::size_t{of[*joint.other]});
    for (std::size_t g = 0; g < bodies_.size(); ++g) {
      Group group;
      group.place.assign(free_.size(), -1);
      for (std::size_t b = 0; b < bodies_.size(); ++b)
        if (of[b] == g && is_free(b)) group.bodies.push_back(b);
      for (std::size_t j = 0; j < joints_.size(); ++j) {
        const std::size_t tied = !joints_[j].other || is_free(joints_[j].body) ? joints_[j].body : *joints_[j].other;
        if (of[tied] == g) group.joints.push_back(j);
      }
      for (const std::size_t b : group.bodies)
        for (std::size_t k = freedoms<d> * b; k < freedoms<d> * (b + 1); ++k)
          if (free_[k]) group.place[k] = group.coordinates++;
      if (!group.joints.empty()) groups_.push_back(std::move(group));
    }
  }

  Rows rows(const Group& group, std::size_t joint) const {
    const auto& all = conditions_[joint];
    Rows result{Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(all.size()), group.coordinates),
                Eigen::VectorXd::Zero(static_cast<Eigen::Index>(all.size()))};
    Eigen::Index row = 0;
    for (const auto& condition : all) {
      double length = 0;
      const auto add = [&](std::size_t body, const Wrench<3>& in_space) {
        const Twist<d> wrench = (embedding<d>().transpose() * in_space).cwiseQuotient(unit_[body]);
        const Twist<d> velocity = bodies_[body].velocity.cwiseProduct(unit_[body]);
        length += wrench.squaredNorm();
        for (int k = 0; k < freedoms<d>; ++k) {
          const Eigen::Index at = group.place[freedoms<d> * body + static_cast<std::size_t>(k)];
          if (at >= 0)
            result.left(row, at) += wrench[k];
          else if (moves_as_told(body))
            result.right[row] -= wrench[k] * velocity[k];
        }
      };
      add(condition.body, condition.first);
      if (condition.other) add(*condition.other, condition.second);
      if (length <= negligible * negligible) continue;  // about what the plane holds anyway
      result.left.row(row) /= std::sqrt(length);
      result.right[row] /= std::sqrt(length);
      ++row;
    }
    return {result.left.topRows(row), result.right.head(row)};
  }

  bool moves_as_told(std::size_t body) const { return bodies_[body].motion != BodyMotion::fixed; }

  Left left_by(const Group& group, const Joints& joints) const {
    Left left(group.coordinates);
    for (const std::size_t j : joints) left.add(rows(group, j));
    return left;
  }

  bool holds(const Group& group, const Left& left, std::size_t body) const {
    double moves = 0;
    for (std::size_t k = freedoms<d> * body; k < freedoms<d> * (body + 1); ++k)
      if (group.place[k] >= 0) moves += left.motions.row(group.place[k]).squaredNorm();
    return moves <= negligible;
  }

  bool contradict(const Group& group, const Joints& joints) const {
    Left left(group.coordinates);
    return std::ranges::any_of(joints,
                               [&](std::size_t j) { return left.add(rows(group, j)) == Left::Answer::contradicts; });
  }

  /// What is left when each joint that `enough` does without is taken away, the last ones first.
  template <class Enough>
  static Joints least_set(Joints joints, Enough enough) {
    for (std::size_t i = joints.size(); i-- > 0;) {
      Joints fewer = joints;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      if (enough(fewer)) joints = std::move(fewer);
    }
    return joints;
  }

  void add_group(const Group& group, Ties& all) const {
    Left left(group.coordinates);
    for (const std::size_t j : group.joints) {
      const auto answer = left.add(rows(group, j));
      if (answer == Left::Answer::repeats) all.repeated.push_back(j);
      if (answer != Left::Answer::contradicts) continue;
      if (all.contradicting.empty())
        all.contradicting = least_set(group.joints, [&](const Joints& some) { return contradict(group, some); });
      return;
    }
    for (const std::size_t body : group.bodies) {
      if (jolts(group, left, body)) all.jolted.push_back(body);
      if (!holds(group, left, body)) continue;
      all.held.push_back({body, least_set(group.joints, [&](const Joints& some) {
                            return holds(group, left_by(group, some), body);
                          })});
    }
  }

  /// Whether the body's own velocity is none that the joints leave it.
  bool jolts(const Group& group, const Left& left, std::size_t body) const {
    Eigen::VectorXd given = -left.point;
    for (const std::size_t b : group.bodies)
      for (int k = 0; k < freedoms<d>; ++k)
        if (const Eigen::Index at = group.place[freedoms<d> * b + static_cast<std::size_t>(k)]; at >= 0)
          given[at] += unit_[b][k] * bodies_[b].velocity[k];
    const Eigen::VectorXd lost = given - left.motions * (left.motions.transpose() * given);
    double change = 0, speed = 0;
    for (int k = 0; k < freedoms<d>; ++k) {
      const Eigen::Index at = group.place[freedoms<d> * body + static_cast<std::size_t>(k)];
      if (at >= 0) change += lost[at] * lost[at];
      speed += std::pow(unit_[body][k] * bodies_[body].velocity[k], 2);
    }
    return speed > 0 && change > digits * digits * speed;
  }

  std::span<const BodySpec<d>> bodies_;
  std::span<const JointSpec> joints_;
  std::vector<Twist<d>> unit_;
  std::vector<bool> free_;  // each coordinate of all bodies
  std::vector<std::vector<Condition<3>>> conditions_;
  std::vector<Group> groups_;
};

}  // namespace

template <int d>
Ties examine_ties(std::span<const BodySpec<d>> bodies, std::span<const JointSpec> joints) {
  return Examined<d>(bodies, joints).ties();
}

template Ties examine_ties<2>(std::span<const BodySpec<2>>, std::span<const JointSpec>);
template Ties examine_ties<3>(std::span<const BodySpec<3>>, std::span<const JointSpec>);

}  // namespace splashdown::rigid
