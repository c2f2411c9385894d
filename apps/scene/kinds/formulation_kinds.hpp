// The formulations of the fluid that a scene may name: a row each. What they are made of stands in apps/build/formulations.cpp.
#pragma once

#include <span>
#include <string_view>

#include "apps/scene/kinds/named.hpp"
#include "apps/scene/read/reader.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// What a formulation computes on.
enum class FluidMedium {
  particles,  ///< nodes of the particle finite element method
  grid,       ///< squares of a plane, without a free surface
  mesh        ///< elements between sides that stay, without a free surface; plane
};

/// A way to compute the fluid.
struct FormulationKind {
  std::string_view name;
  std::string_view about;                               ///< what `check` tells besides the name
  void (*read)(Reader& table, Fluid& fluid) = nullptr;  ///< reads [fluid.NAME]; null: it has no keys of its own
  FluidMedium medium = FluidMedium::particles;
};
/// The default comes first.
std::span<const FormulationKind> formulation_kinds();

}  // namespace splashdown::apps
