// An effect on the fluid's momentum: present in a scene or absent, never switched.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fluid/mesh.hpp"
#include "fluid/nodes.hpp"
#include "fluid/types.hpp"

namespace splashdown::fluid {

template <int d>
class Term {
 public:
  virtual ~Term() = default;
  virtual std::string name() const = 0;
  /// Adds the effect of one kick to the predicted velocities v [m/s] of all nodes.
  virtual void predict(const Nodes<d>& nodes, const Mesh<d>& mesh, std::span<const double> lumped_volume,
                       double kick, std::span<Vec<d>> v) = 0;
  /// Potential energy per unit mass at a point [J/kg]; 0 for effects that have none.
  virtual double potential(const Vec<d>& /*x*/) const { return 0; }
  /// Largest stable dt [s]; infinity for effects that set none.
  virtual double stable_dt() const;
};

template <int d>
class Gravity final : public Term<d> {
 public:
  explicit Gravity(const Vec<d>& acceleration) : g_(acceleration) {}
  std::string name() const override { return "gravity"; }
  void predict(const Nodes<d>&, const Mesh<d>&, std::span<const double>, double kick,
               std::span<Vec<d>> v) override;
  double potential(const Vec<d>& x) const override { return -g_.dot(x); }

 private:
  Vec<d> g_;  ///< [m/s^2]
};

}  // namespace splashdown::fluid
