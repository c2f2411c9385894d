#include "rigid/bullet_engine.hpp"

#include <btBulletDynamicsCommon.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/geometry.hpp"
#include "rigid/spin.hpp"

static_assert(sizeof(btScalar) == sizeof(double), "Bullet must be its double precision build");

namespace splashdown::rigid {

namespace {

btVector3 vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btMatrix3x3 matrix(const Eigen::Matrix3d& r) {
  return btMatrix3x3(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
}
Eigen::Matrix3d from_bullet(const btMatrix3x3& basis) {
  Eigen::Matrix3d r;
  for (int i = 0; i < 3; ++i) r.row(i) = from_bullet(basis[i]).transpose();
  return r;
}

/// Frame at a point of the world whose given axis is `column`, seen from a body.
btTransform seen_from(const btRigidBody& body, const JointSpec& joint, int column) {
  const Eigen::Vector3d axis = joint.axis.normalized(), across = axis.unitOrthogonal();
  Eigen::Matrix3d frame;
  frame.col(column) = axis;
  frame.col((column + 1) % 3) = across;
  frame.col((column + 2) % 3) = axis.cross(across);
  return body.getCenterOfMassTransform().inverse() * btTransform(matrix(frame), vector(joint.point));
}

std::unique_ptr<btTypedConstraint> made(const JointSpec& joint, btRigidBody& a, btRigidBody& b) {
  constexpr bool frame_of_first = true;
  if (joint.type == JointType::weld)
    return std::make_unique<btFixedConstraint>(a, b, seen_from(a, joint, 0), seen_from(b, joint, 0));
  if (joint.type == JointType::slider) {
    auto slider =
        std::make_unique<btSliderConstraint>(a, b, seen_from(a, joint, 0), seen_from(b, joint, 0), frame_of_first);
    slider->setUseFrameOffset(false);
    constexpr double none = 1;  // lower limit above the upper one
    slider->setLowerLinLimit(none), slider->setUpperLinLimit(-none);
    slider->setLowerAngLimit(0), slider->setUpperAngLimit(0);
    return slider;
  }
  auto hinge =
      std::make_unique<btHingeConstraint>(a, b, seen_from(a, joint, 2), seen_from(b, joint, 2), frame_of_first);
  hinge->setUseFrameOffset(false);
  return hinge;
}

struct Joint {
  std::unique_ptr<btTypedConstraint> bullet;
  std::size_t body;
  std::optional<std::size_t> other;
};

}  // namespace

struct BulletEngine::Objects {
  btEmptyShape shape;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<Joint> joints;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
};

BulletEngine::BulletEngine() : objects_(std::make_unique<Objects>()) { objects_->world.setGravity(btVector3(0, 0, 0)); }

BulletEngine::~BulletEngine() = default;

std::size_t BulletEngine::add(bool moves) {
  const double any_mass = moves ? 1 : 0;  // 0: stays where it is placed
  btRigidBody::btRigidBodyConstructionInfo info(any_mass, nullptr, &objects_->shape,
                                                btVector3(any_mass, any_mass, any_mass));
  info.m_linearDamping = 0;
  info.m_angularDamping = 0;
  info.m_additionalDamping = false;
  auto body = std::make_unique<btRigidBody>(info);
  const int no_gyroscopic_term = 0;
  body->setFlags(no_gyroscopic_term);
  const int no_collisions = 0;
  objects_->world.addRigidBody(body.get(), no_collisions, no_collisions);
  objects_->bodies.push_back(std::move(body));
  return objects_->bodies.size() - 1;
}

void BulletEngine::add(const JointSpec& joint) {
  btRigidBody& first = *objects_->bodies[joint.body];
  btRigidBody& second = joint.other ? *objects_->bodies[*joint.other] : btTypedConstraint::getFixedBody();
  objects_->joints.push_back({made(joint, first, second), joint.body, joint.other});
}

void BulletEngine::place(std::size_t body, const Isometry<3>& pose, const Twist<3>& velocity) {
  btRigidBody& b = *objects_->bodies[body];
  b.setCenterOfMassTransform(btTransform(matrix(pose.linear()), vector(pose.translation())));
  b.setLinearVelocity(vector(velocity.head<3>()));
  b.setAngularVelocity(vector(velocity.tail<3>()));
}

void BulletEngine::drift(double dt) {
  const double bullet_stops_turning_at = 0.78;  // a little below pi/4
  std::vector<std::pair<std::size_t, btMatrix3x3>> fast;
  for (std::size_t i = 0; i < objects_->bodies.size(); ++i) {
    btRigidBody& body = *objects_->bodies[i];
    // Forced, because Bullet switches off for good a body that a diverged trial once threw out of its world.
    body.forceActivationState(DISABLE_DEACTIVATION);
    const Eigen::Vector3d turn = dt * from_bullet(body.getAngularVelocity());
    if (body.isStaticObject() || turn.norm() <= bullet_stops_turning_at) continue;
    fast.emplace_back(i, matrix(rotation(turn) * from_bullet(body.getWorldTransform().getBasis())));
  }
  const int one_step_of_dt = 0;
  objects_->world.stepSimulation(dt, one_step_of_dt);
  for (const auto& [i, turned] : fast) objects_->bodies[i]->getWorldTransform().setBasis(turned);
}

std::vector<Condition<3>> BulletEngine::conditions(double dt) {
  // Rows of a joint; numbers in one: linear and angular, of both bodies, then what stands on the right.
  constexpr int most = 6, row = 3 * 4 + 4;
  std::vector<Condition<3>> all;
  joint_of_condition_.clear();
  for (const Joint& joint : objects_->joints) {
    std::array<double, most * row> rows{};
    btTypedConstraint::btConstraintInfo1 count{};
    joint.bullet->getInfo1(&count);
    btTypedConstraint::btConstraintInfo2 info{};
    info.fps = 1 / dt;
    info.erp = 1;  // what is violated is mended in one step
    info.m_J1linearAxis = rows.data();
    info.m_J1angularAxis = rows.data() + 3;
    info.m_J2linearAxis = rows.data() + 6;
    info.m_J2angularAxis = rows.data() + 9;
    info.rowskip = row;
    info.m_constraintError = rows.data() + 12;
    info.cfm = rows.data() + 13;
    info.m_lowerLimit = rows.data() + 14;
    info.m_upperLimit = rows.data() + 15;
    joint.bullet->getInfo2(&info);
    for (int i = 0; i < count.m_numConstraintRows; ++i) {
      const Eigen::Map<const Wrench<3>> first(rows.data() + i * row);
      // Bullet's own second half balances forces but not moments while the two frames are apart; hinges lack it.
      Wrench<3> second = -first;
      if (joint.other) {
        const Eigen::Vector3d arm = pose(joint.body).translation() - pose(*joint.other).translation();
        second.tail<3>() -= arm.cross(first.head<3>());
      }
      all.push_back({joint.body, joint.other, first, second, first.data()[12]});
      joint_of_condition_.push_back(static_cast<std::size_t>(&joint - objects_->joints.data()));
    }
    const auto* slider = dynamic_cast<const btSliderConstraint*>(joint.bullet.get());
    constexpr int with_turn = 5;
    if (!slider || count.m_numConstraintRows == with_turn) continue;
    // Its last row holds the turn about the axis; Bullet leaves it out where that is exactly nought.
    Wrench<3> turn = Wrench<3>::Zero();
    turn.tail<3>() = from_bullet(slider->getCalculatedTransformA().getBasis().getColumn(0));
    all.push_back({joint.body, joint.other, turn, -turn, 0});
    joint_of_condition_.push_back(static_cast<std::size_t>(&joint - objects_->joints.data()));
  }
  return all;
}

JointCoordinate<3> BulletEngine::coordinate(std::size_t joint) const {
  const Joint& of = objects_->joints[joint];
  const btTransform& at_a = of.bullet->getRigidBodyA().getCenterOfMassTransform();
  const btTransform& at_b = of.bullet->getRigidBodyB().getCenterOfMassTransform();
  JointCoordinate<3> all{0, {of.body, of.other}};
  const auto from_centre = [](const btTransform& place, const btTransform& body) {
    return from_bullet(place.getOrigin() - body.getOrigin());
  };
  // The force acts along one line on both, so that it changes no momentum of the two.
  if (const auto* hinge = dynamic_cast<const btHingeConstraint*>(of.bullet.get())) {
    const btMatrix3x3 a = (at_a * hinge->getAFrame()).getBasis(), b = (at_b * hinge->getBFrame()).getBasis();
    const Eigen::Vector3d axis = from_bullet(a.getColumn(2)), zero = from_bullet(b.getColumn(0)),
                          now = from_bullet(a.getColumn(0));
    all.q = std::atan2(axis.dot(zero.cross(now)), zero.dot(now));
    all.rate.first.tail<3>() = axis;
    all.rate.second.tail<3>() = -axis;
  } else if (const auto* slider = dynamic_cast<const btSliderConstraint*>(of.bullet.get())) {
    const btTransform a = at_a * slider->getFrameOffsetA(), b = at_b * slider->getFrameOffsetB();
    const Eigen::Vector3d axis = from_bullet(a.getBasis().getColumn(0));
    all.q = axis.dot(from_bullet(a.getOrigin() - b.getOrigin()));
    all.rate.first = wrench_of<3>(from_centre(a, at_a), axis);
    all.rate.second = -wrench_of<3>(from_centre(a, at_b), axis);
  }
  return all;
}

Isometry<3> BulletEngine::pose(std::size_t body) const {
  Isometry<3> pose = Isometry<3>::Identity();
  const btTransform& at = objects_->bodies[body]->getWorldTransform();
  pose.linear() = from_bullet(at.getBasis());
  pose.translation() = from_bullet(at.getOrigin());
  return pose;
}

}  // namespace splashdown::rigid
