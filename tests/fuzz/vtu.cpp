// Grids of .vtu files, as the report reads them of a run's folder.
#include "apps/record/frames/vtu.hpp"

#include <stdexcept>

#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace splashdown;
  fuzz::file_of("grid.vtu", data, size);
  try {
    const auto grid = apps::read_vtu(fuzz::folder() / "grid.vtu");
    for (const int point : grid.connectivity)
      if (point < 0 || static_cast<std::size_t>(point) >= grid.points.size() / 3) __builtin_trap();
    if (grid.offsets.size() != grid.types.size()) __builtin_trap();
  } catch (const std::runtime_error&) {
  }
  return 0;
}
