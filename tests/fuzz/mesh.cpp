// Meshes of Gmsh: the first byte says whether the rest is read in space.
#include <sstream>

#include "elastic/mesh/gmsh_file.hpp"
#include "reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace splashdown;
  if (size == 0) return 0;
  std::istringstream text(std::string(reinterpret_cast<const char*>(data + 1), size - 1));
  try {
    if (data[0] == '3')
      elastic::read_gmsh<3>(text, "body.msh");
    else
      elastic::read_gmsh<2>(text, "body.msh");
  } catch (const elastic::MeshError&) {
  }
  return 0;
}
