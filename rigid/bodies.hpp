// All rigid bodies of a scene, moved by Bullet (double precision).
//
//   m dV/dt = F,   d(I w)/dt = M        (Newton-Euler, about the centre of mass)
//
// Leapfrog (Stoermer-Verlet): velocities live at half steps, poses at whole steps,
//
//   s_{n+1/2} = s_{n-1/2} + kick M_b^-1 (f_n + sum of forces),   kick = (dt_{n-1} + dt_n)/2
//   x_{n+1}   = x_n + dt_n V_{n+1/2},   R_{n+1} = exp(dt_n w_{n+1/2}) R_n
//
// which is Bullet's semi-implicit Euler step when dt is constant. Second order, symplectic.
// The three verbs: begin fixes kick and dt, solve may be repeated (always from t_n, same bits for the
// same input), commit makes t_{n+1} the present.
// A body whose load is not finite gets a trial state that is not finite either, and nothing else happens.
#pragma once

#include <iosfwd>
#include <memory>
#include <span>
#include <vector>

#include "rigid/body.hpp"

namespace splashdown::rigid {

/// A force on the bodies besides the fluid's load. Present in a scene or absent; never switched.
template <int d>
class Force {
 public:
  virtual ~Force() = default;
  virtual std::string name() const = 0;
  /// Wrench about the centre of mass, world frame, on a body at the given pose and half-step velocity.
  virtual Wrench<d> wrench(const BodySpec<d>& body, const Isometry<d>& pose, const Twist<d>& velocity,
                           double time) const = 0;
};

template <int d>
class Gravity final : public Force<d> {
 public:
  explicit Gravity(const Vec<d>& acceleration) : acceleration_(acceleration) {}
  std::string name() const override { return "gravity"; }
  Wrench<d> wrench(const BodySpec<d>& body, const Isometry<d>&, const Twist<d>&, double) const override;

 private:
  Vec<d> acceleration_;
};

template <int d>
struct BodyState {
  Isometry<d> pose;   ///< at t_n, body frame to world
  Twist<d> velocity;  ///< at t_{n-1/2} (at t_0 for the first step)
};

template <int d>
class Bodies {
 public:
  Bodies(std::vector<BodySpec<d>> specs, std::vector<std::unique_ptr<Force<d>>> forces);
  ~Bodies();
  Bodies(Bodies&&) noexcept;
  Bodies& operator=(Bodies&&) noexcept;

  std::size_t size() const;
  const BodySpec<d>& spec(std::size_t body) const;
  const BodyState<d>& state(std::size_t body) const;  ///< at t_n
  double time() const;                                ///< t_n

  /// Compliance M_b^-1 of the body at t_n in the world frame: the velocity change per unit impulse.
  /// Rows and columns of held freedoms are zero; fixed and prescribed bodies have none at all.
  /// Between begin and commit it is that of the begun step, and exact: the half-step velocity is affine in
  /// the load with slope kick * compliance. (A spinning body in space is taken at its predicted midpoint.)
  Compliance<d> compliance(std::size_t body) const;

  void begin(double kick, double dt);
  /// Trial state at t_{n+1} (pose) and t_{n+1/2} (velocity) under constant loads, one wrench a body.
  std::span<const BodyState<d>> solve(std::span<const Wrench<d>> loads);
  /// Accepts the last trial.
  void commit();

  void save(std::ostream& out) const;  ///< bit-exact state at t_n
  void load(std::istream& in);

 private:
  struct World;  // Bullet's objects
  std::unique_ptr<World> world_;
};

extern template class Bodies<2>;
extern template class Bodies<3>;

}  // namespace splashdown::rigid
