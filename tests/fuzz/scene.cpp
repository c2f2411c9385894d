// Scenes, with every check but the simulation.
#include "apps/scene/read/read.hpp"
#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace splashdown;
  try {
    // What was read has to read again to the same.
    const auto name = (fuzz::folder() / "scene.toml").string();
    const auto once = apps::read_scene_text(fuzz::text_of(data, size), name);
    const auto again = apps::read_scene_text(once.resolved, name);
    if (once.resolved != again.resolved) __builtin_trap();
  } catch (const apps::SceneError&) {
  }
  return 0;
}
