// Studies, without the scenes of their runs.
#include "apps/study/study.hpp"

#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace splashdown;
  try {
    static const auto scene = fuzz::file_of("scene.toml", nullptr, 0);
    const auto study = apps::read_study(fuzz::file_of("study.toml", data, size));
    std::size_t runs = 1;
    for (const auto& axis : study.axes) runs = std::min<std::size_t>(runs * axis.values.size(), 1001);
    if (runs <= 1000) apps::expand(study);
  } catch (const apps::SceneError&) {
  }
  return 0;
}
