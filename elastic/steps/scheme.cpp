#include "elastic/steps/scheme.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splashdown::elastic {

Status Scheme::accelerate(SolidState& motion) {
  Field force = dynamics_.load(motion.t) - system().internal_force(motion.u);
  if (const auto* C = damping_at(motion, 0)) force -= *C * motion.v;
  return solver_.solve_mass(system(), force, motion.a);
}

const Sparse* Scheme::damping_at(const SolidState& now, double half) {
  const auto& [mass, stiffness] = dynamics_.damping;
  if (mass == 0 && stiffness == 0) return nullptr;
  if (system().linear() && C_.nonZeros() > 0) return &C_;
  C_ = system().mass();
  C_.coeffs() *= mass;
  if (stiffness != 0) {
    Sparse K;
    system().stiffness(now.u + half * now.v, K);
    C_.coeffs() += stiffness * K.coeffs();
  }
  return &C_;
}

namespace {

class GeneralisedAlpha final : public Scheme {
 public:
  GeneralisedAlpha(Dynamics dynamics, double am, double af, double beta, double gamma)
      : Scheme(std::move(dynamics)), am_(am), af_(af), beta_(beta), gamma_(gamma) {}

  Status step(const SolidState& now, double dt, SolidState& next) override {
    const auto* C = damping_at(now, dt / 2);
    const Field p = now.u + dt * now.v + dt * dt * (0.5 - beta_) * now.a;
    const double to_a = 1 / (beta_ * dt * dt), to_v = gamma_ / (beta_ * dt);
    const Field v_known = now.v + dt * (1 - gamma_) * now.a;
    Stage stage{.mass = (1 - am_) * to_a, .damping = (1 - af_) * to_v, .force = 1 - af_, .p = p, .q = p};
    stage.g = (1 - af_) * dynamics_.load(now.t + dt) - am_ * (system().mass() * now.a);
    if (af_ != 0) stage.g += af_ * (dynamics_.load(now.t) - system().internal_force(now.u));
    if (C) stage.g -= *C * ((1 - af_) * v_known + af_ * now.v);
    next.t = now.t + dt;
    next.u = now.u + dt * now.v + dt * dt / 2 * now.a;
    if (auto status = solver_.solve(system(), stage, C, next.u); !status.ok()) return status;
    next.a = to_a * (next.u - p);
    next.v = v_known + to_v * (next.u - p);
    return {};
  }

 private:
  double am_, af_, beta_, gamma_;
};

/// One-step thetas one after the other.
class Thetas : public Scheme {
 public:
  /// Share of the step and weight of its end.
  struct Part {
    double share, weight;
  };
  using Scheme::Scheme;

  Status step(const SolidState& now, double dt, SolidState& next) override {
    const auto* C = damping_at(now, dt / 2);
    next = now;
    for (const auto& [share, weight] : parts(dt))
      if (auto status = part(share * dt, weight, C, next); !status.ok()) return status;
    next.t = now.t + dt;
    next.a = (next.v - now.v) / dt;
    return {};
  }

 protected:
  virtual std::vector<Part> parts(double dt) const = 0;

 private:
  Status part(double dt, double weight, const Sparse* C, SolidState& motion) {
    const double step = weight * dt, rest = 1 - weight;
    Stage stage{.mass = 1 / (step * step), .damping = 1 / step};
    stage.p = motion.u + dt * motion.v;
    stage.q = motion.u + rest * dt * motion.v;
    stage.g = dynamics_.load(motion.t + dt);
    if (rest != 0) {
      Field r = dynamics_.load(motion.t) - system().internal_force(motion.u);
      if (C) r -= *C * motion.v;
      stage.g += rest / weight * r;
    }
    const Field before = motion.u;
    motion.u = stage.p;
    if (auto status = solver_.solve(system(), stage, C, motion.u); !status.ok()) return status;
    motion.v = (motion.u - before) / step - rest / weight * motion.v;
    motion.t += dt;
    return {};
  }
};

class ImplicitEuler final : public Thetas {
  using Thetas::Thetas;
  std::vector<Part> parts(double) const override { return {{1, 1}}; }
};

class ShiftedCrankNicolson final : public Thetas {
 public:
  ShiftedCrankNicolson(Dynamics dynamics, double shift) : Thetas(std::move(dynamics)), shift_(shift) {}

 private:
  std::vector<Part> parts(double dt) const override { return {{1, std::min(1., 0.5 + shift_ * dt)}}; }
  double shift_;
};

class FractionalStepTheta final : public Thetas {
  using Thetas::Thetas;
  std::vector<Part> parts(double) const override {
    const double theta = 1 - std::sqrt(0.5), weight = (1 - 2 * theta) / (1 - theta);
    return {{theta, weight}, {1 - 2 * theta, 1 - weight}, {theta, weight}};
  }
};

class Midpoint final : public Thetas {
 public:
  using Thetas::Thetas;
  Status step(const SolidState& now, double dt, SolidState& next) override {
    if (auto status = Thetas::step(now, dt / 2, next); !status.ok()) return status;
    next.t = now.t + dt;
    next.u = 2 * next.u - now.u;
    next.v = 2 * next.v - now.v;
    next.a = (next.v - now.v) / dt;
    return {};
  }

 private:
  std::vector<Part> parts(double) const override { return {{1, 1}}; }
};

class Steady final : public Scheme {
 public:
  using Scheme::Scheme;
  Status accelerate(SolidState& motion) override {
    motion.a.setZero(motion.u.size());
    return {};
  }
  Status step(const SolidState& now, double dt, SolidState& next) override {
    const Field from = system().internal_force(now.u), to = dynamics_.load(now.t + dt);
    next = now;
    next.t = now.t + dt;
    double done = 0, part = 1;
    constexpr double least = 1. / 1024;  // of the load: snapping through is no matter of parts
    while (done < 1) {
      const double goal = std::min(1., done + part);
      Field u = next.u;
      const auto status = solver_.solve(system(), {.g = (1 - goal) * from + goal * to}, nullptr, u);
      if (status.ok()) {
        next.u = u;
        done = goal;
        part *= 2;
      } else if ((part /= 2) < least) {
        return status;
      }
    }
    next.v = (next.u - now.u) / dt;
    next.a.setZero(next.u.size());
    return {};
  }
};

void require(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(rule);
}

}  // namespace

std::unique_ptr<Scheme> generalised_alpha(Dynamics dynamics, double radius) {
  require(radius >= 0 && radius <= 1, "the spectral radius must be from 0 to 1");
  const double am = (2 * radius - 1) / (radius + 1), af = radius / (radius + 1), gap = af - am;
  return std::make_unique<GeneralisedAlpha>(std::move(dynamics), am, af, 0.25 * (1 + gap) * (1 + gap), 0.5 + gap);
}

std::unique_ptr<Scheme> newmark(Dynamics dynamics, double beta, double gamma) {
  require(beta > 0 && gamma >= 0.5, "Newmark's beta must be positive, gamma 1/2 or more");
  return std::make_unique<GeneralisedAlpha>(std::move(dynamics), 0, 0, beta, gamma);
}

std::unique_ptr<Scheme> shifted_crank_nicolson(Dynamics dynamics, double shift) {
  require(shift >= 0, "the shift must not be negative");
  return std::make_unique<ShiftedCrankNicolson>(std::move(dynamics), shift);
}
std::unique_ptr<Scheme> fractional_step_theta(Dynamics dynamics) {
  return std::make_unique<FractionalStepTheta>(std::move(dynamics));
}
std::unique_ptr<Scheme> implicit_euler(Dynamics dynamics) {
  return std::make_unique<ImplicitEuler>(std::move(dynamics));
}
std::unique_ptr<Scheme> midpoint(Dynamics dynamics) { return std::make_unique<Midpoint>(std::move(dynamics)); }
std::unique_ptr<Scheme> steady(Dynamics dynamics) { return std::make_unique<Steady>(std::move(dynamics)); }

}  // namespace splashdown::elastic
