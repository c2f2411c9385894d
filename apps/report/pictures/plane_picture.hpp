// A recorded state as a plane picture: a 2D mesh as it is, a 3D mesh cut by an upright plane, through the middle
// of the first body and along its heading; x then runs along that heading.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::apps {

using PlanePoint = std::array<double, 2>;
using Segment = std::array<PlanePoint, 2>;

struct PlaneOutline {
  std::vector<Segment> segments;
  bool encloses_solid = true;  ///< a body; false: a tank
};

struct PlanePicture {
  double time = 0;
  std::vector<PlanePoint> points;
  std::vector<double> pressure;  ///< at the points [Pa]
  std::vector<std::array<int, 3>> triangles;
  std::vector<Segment> edges;     ///< of the mesh; the cut cells' in 3D
  std::vector<Segment> surface;   ///< outline of the water
  std::vector<PlanePoint> drops;  ///< nodes without a cell
  std::vector<PlaneOutline> outlines;
  std::size_t nodes = 0, cells = 0;  ///< of the whole mesh
};

/// Reads FOLDER/STEM.vtu and FOLDER/STEM_*.vtu. Throws std::runtime_error if they cannot be read.
PlanePicture read_picture(const std::filesystem::path& folder, const std::string& stem);

/// Linear interpolation on a grid of pixel centres, rows from the bottom; nan outside the mesh.
struct Raster {
  int width = 0, height = 0;
  PlanePoint low{}, high{};  ///< corners of the view [m]
  std::vector<float> values;
};
Raster rasterise(const PlanePicture& picture, PlanePoint low, PlanePoint high, int width, int height);

}  // namespace splashdown::apps
