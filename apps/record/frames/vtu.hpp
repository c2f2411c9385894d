// VTK's XML format for unstructured grids, .vtu, as ParaView, VisIt and meshio read it, in one piece.
//
// Each array stands in its element in base64: UInt64 [blocks, bytes a block, bytes of the last block if it is shorter, else 0,
// compressed bytes of each block], and, encoded anew, a zlib stream a block. Source: Kitware, "VTK XML Formats". Arrays appended
// as raw bytes would be a quarter smaller, but no XML, and meshio mixes up their offsets. Assumes a little-endian machine.
// Cost: zlib's, on all threads; the same bytes for any number of them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace splashdown::apps {

struct VtuArray {
  std::string name;
  std::variant<std::vector<double>, std::vector<int>, std::vector<unsigned char>> values;
  int components = 1;  ///< numbers a point
};

/// VTK's numbers of the cells that are written here.
enum class VtuCell : unsigned char { vertex = 1, line = 3, triangle = 5, tetrahedron = 10 };

struct VtuGrid {
  std::vector<double> points;        ///< three coordinates a point [m]
  std::vector<int> connectivity;     ///< points of all cells, one cell after the other
  std::vector<int> offsets;          ///< where each cell ends in connectivity
  std::vector<unsigned char> types;  ///< VtuCell of each cell
  std::vector<VtuArray> point_data;
  std::vector<VtuArray> field_data;
  std::string scalars;  ///< the point data that is shown at first; may be empty

  void add_cell(VtuCell type, const int* corners, int count);
};

/// Throws std::runtime_error if it cannot be written.
void write_vtu(const std::filesystem::path& path, const VtuGrid& grid);

/// Throws std::runtime_error if it cannot be read or is not as write_vtu writes: the file and what is wrong with it.
/// Point data have a tuple a point, cells name points that exist.
VtuGrid read_vtu(const std::filesystem::path& path);

}  // namespace splashdown::apps
