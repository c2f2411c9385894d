#include "rigid/bullet_world.hpp"

#include <btBulletDynamicsCommon.h>

#include <vector>

#include "rigid/spin.hpp"

static_assert(sizeof(btScalar) == sizeof(double), "Bullet must be its double precision build");

namespace splashdown::rigid {

namespace {

btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const Eigen::Matrix3d& r, const Eigen::Vector3d& origin) {
  const btMatrix3x3 basis(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
  return btTransform(basis, to_bullet(origin));
}

Eigen::Matrix3d from_bullet(const btMatrix3x3& basis) {
  Eigen::Matrix3d r;
  for (int i = 0; i < 3; ++i) r.row(i) = from_bullet(basis[i]).transpose();
  return r;
}

struct Body {
  std::unique_ptr<btRigidBody> bullet;
  double mass;
  Inertia<3> inertia;
  Eigen::Matrix3d axes;  // Bullet's body frame: it knows diagonal inertias only
};

}  // namespace

struct BulletWorld::Objects {
  btEmptyShape shape;
  std::vector<Body> bodies;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
};

BulletWorld::BulletWorld() : objects_(std::make_unique<Objects>()) {
  objects_->world.setGravity(btVector3(0, 0, 0));
}

BulletWorld::~BulletWorld() = default;

std::size_t BulletWorld::add(double mass, const Inertia<3>& inertia, const std::array<bool, 6>& free) {
  const Eigen::Matrix3d axes = principal_axes(inertia);
  const Eigen::Vector3d principal = (axes.transpose() * inertia * axes).diagonal();
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &objects_->shape, to_bullet(principal));
  info.m_linearDamping = 0;
  info.m_angularDamping = 0;
  info.m_additionalDamping = false;
  auto body = std::make_unique<btRigidBody>(info);
  const int no_gyroscopic_term = 0;
  body->setFlags(no_gyroscopic_term);
  body->setLinearFactor(btVector3(free[0], free[1], free[2]));
  body->setAngularFactor(btVector3(free[3], free[4], free[5]));
  const int no_collisions = 0;
  objects_->world.addRigidBody(body.get(), no_collisions, no_collisions);
  objects_->bodies.push_back({std::move(body), mass, inertia, axes});
  return objects_->bodies.size() - 1;
}

void BulletWorld::kick(std::size_t body, const Isometry<3>& pose, const Twist<3>& velocity,
                       const Twist<3>& change) {
  const Body& b = objects_->bodies[body];
  b.bullet->setCenterOfMassTransform(to_bullet(pose.linear() * b.axes, pose.translation()));
  b.bullet->setLinearVelocity(to_bullet(velocity.head<3>()));
  b.bullet->setAngularVelocity(to_bullet(velocity.tail<3>()));
  b.bullet->applyCentralImpulse(to_bullet(b.mass * change.head<3>()));
  b.bullet->applyTorqueImpulse(to_bullet(world_inertia(pose.linear(), b.inertia) * change.tail<3>()));
}

void BulletWorld::drift(double dt) {
  const double bullet_stops_turning_at = 0.78;  // a little below pi/4
  std::vector<std::pair<std::size_t, btTransform>> fast;
  for (std::size_t i = 0; i < objects_->bodies.size(); ++i) {
    btRigidBody& body = *objects_->bodies[i].bullet;
    // Forced, because Bullet switches off for good a body that a diverged trial once threw out of its world.
    body.forceActivationState(DISABLE_DEACTIVATION);
    const Eigen::Vector3d turn = dt * from_bullet(body.getAngularVelocity());
    if (turn.norm() <= bullet_stops_turning_at) continue;
    const Eigen::Matrix3d turned = rotation_exp(turn) * from_bullet(body.getWorldTransform().getBasis());
    fast.emplace_back(i, to_bullet(turned, Eigen::Vector3d::Zero()));
  }
  const int one_step_of_dt = 0;
  objects_->world.stepSimulation(dt, one_step_of_dt);
  for (const auto& [i, turned] : fast)
    objects_->bodies[i].bullet->getWorldTransform().setBasis(turned.getBasis());
}

Isometry<3> BulletWorld::pose(std::size_t body) const {
  const Body& b = objects_->bodies[body];
  Isometry<3> pose = Isometry<3>::Identity();
  pose.linear() = from_bullet(b.bullet->getWorldTransform().getBasis()) * b.axes.transpose();
  pose.translation() = from_bullet(b.bullet->getWorldTransform().getOrigin());
  return pose;
}

Twist<3> BulletWorld::velocity(std::size_t body) const {
  const btRigidBody& bullet = *objects_->bodies[body].bullet;
  Twist<3> velocity;
  velocity << from_bullet(bullet.getLinearVelocity()), from_bullet(bullet.getAngularVelocity());
  return velocity;
}

}  // namespace splashdown::rigid
