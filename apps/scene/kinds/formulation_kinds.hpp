// The formulations of the fluid that a scene may name: a row each. What they are made of stands in apps/build/formulations.cpp.
#pragma once

#include <span>
#include <string_view>

#include "apps/scene/kinds/named.hpp"
#include "apps/scene/read/reader.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// A way to compute the fluid.
struct FormulationKind {
  std::string_view name;
  std::string_view about;                               ///< what `check` tells besides the name
  void (*read)(Reader& table, Fluid& fluid) = nullptr;  ///< reads [fluid.NAME]; null: it has no keys of its own
  bool on_grid = false;  ///< squares of a plane without a free surface, not the particle finite element method
};
/// The default comes first.
std::span<const FormulationKind> formulation_kinds();

}  // namespace splashdown::apps
