// The accelerators and interface terms that a scene may name: a row each (apps/build/coupling_kinds.cpp).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "apps/scene/kinds/named.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::coupling {
class Accelerator;
class InterfaceTerm;
}  // namespace splashdown::coupling

namespace splashdown::apps {

/// A way to the fixed point.
struct AcceleratorKind {
  std::string_view name;
  std::unique_ptr<coupling::Accelerator> (*make)(const Coupling& coupling);
  int staggered_passes = 1;  ///< of a step that is not iterated
  std::string (*details)(const Coupling& coupling) =
      nullptr;  ///< what `check` tells besides name and relaxation; null: nothing
};
std::span<const AcceleratorKind> accelerator_kinds();

/// How a body stands in the pressure equation.
struct InterfaceKind {
  std::string_view name;
  /// Null: the structure is solved for with the fluid, and nothing is iterated.
  std::unique_ptr<coupling::InterfaceTerm> (*make)();
};
std::span<const InterfaceKind> interface_kinds();

}  // namespace splashdown::apps
