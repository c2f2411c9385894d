// One step of a scene, tried and then committed or dropped. Each stepper holds exactly the parts it drives.
#pragma once

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace splashdown::coupling {

/// What an attempt came to.
struct StepReport {
  std::string cause;                        ///< why the step must be refused; empty: it may be committed
  int passes = 0;                           ///< coupling passes
  double residual = 0;                      ///< of the interface velocities, relative [-]
  bool of_fluid = false;                    ///< the sides agree, and it is the fluid that may not go on like this
  std::vector<double> pass_residuals = {};  ///< `residual` as each pass left it; none of steps of one part
  /// Whether the attempt may be committed.
  bool ok() const { return cause.empty(); }
};

/// attempt, then commit or another attempt.
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual double time() const = 0;            ///< t_n [s]
  virtual double stable_dt() const = 0;       ///< largest dt that its parts allow from t_n [s]
  virtual StepReport attempt(double dt) = 0;  ///< begin + solve, always from t_n
  /// After an attempt that was refused `of_fluid` and that no smaller dt cured: FluidPart::release_fragment.
  virtual bool release_fragment() { return false; }
  virtual void commit() = 0;  ///< accepts the last attempt
  /// Seconds spent so far, by the name of the phase.
  virtual std::vector<std::pair<std::string, double>> phase_seconds() const = 0;
  virtual void save(std::ostream& out) const = 0;  ///< bit-exact state of parts and scheme at t_n
  virtual void load(std::istream& in) = 0;         ///< throws std::runtime_error for other bytes
};

}  // namespace splashdown::coupling
