// Meshes by name: what fluid.size.refine may be besides a number. docs/performance.md has what they cost and are good for.
#pragma once

#include <array>
#include <string_view>

namespace splashdown::apps {

struct Preset {
  std::string_view name;
  double refine;
};

/// In the plane a fifth to a third and three to four and a half times of what the scene's own sizes take, as measured.
inline constexpr std::array<Preset, 3> presets = {{{"draft", 0.35}, {"standard", 1}, {"reference", 2}}};

}  // namespace splashdown::apps
