// Hulls: the first byte says which format the rest is called.
#include "core/surface/surface_file.hpp"
#include "reader.hpp"
#include "rigid/shapes/mass_properties.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace splashdown;
  if (size == 0) return 0;
  const auto* const name = data[0] == 'o' ? "hull.obj" : "hull.stl";
  try {
    const auto file = read_surface_file(fuzz::file_of(name, data + 1, size - 1));
    rigid::mass_properties<3>({file.surface.vertices, file.surface.facets});
  } catch (const SurfaceFileError&) {
  }
  return 0;
}
