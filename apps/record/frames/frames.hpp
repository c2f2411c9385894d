// Pictures of a state for ParaView: one .vtu for the fluid, one for each wall, listed in frames.pvd.
//
// Fluid point data: v [m/s], p [Pa], kind (NodeKind), wall (index, -1: none), drop_diameter [m] (0: no drop). Separated
// drops are vertex cells. Wall point data: v [m/s], p [Pa] (0: dry); of elastic bodies, which are drawn as they are deformed, u [m],
// von_mises [Pa] and stress [Pa], Cauchy's, nine numbers by rows. 2D points have z = 0.
// docs/files.md.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace splashdown::apps {

enum class NodeKind : unsigned char {
  interior = 0,
  free_surface = 1,
  wall = 2,
  wall_vertex = 3,
  contact = 4,
  drop = 5
};

/// A wall in the world frame.
template <int d>
struct Outline {
  std::string name;
  Surface<d> surface;
  Vec<d> forward = Vec<d>::UnitX();          ///< where the x axis of its frame points
  std::vector<Vec<d>> v = {};                ///< of its vertices [m/s]
  std::vector<double> p = {};                ///< of the water at its vertices, 0 where it is dry [Pa]
  std::vector<Vec<d>> u = {};                ///< displacements of the vertices of an elastic body [m]
  std::vector<Eigen::Matrix3d> stress = {};  ///< the same of Cauchy's stress [Pa]
  std::vector<double> von_mises = {};        ///< of it [Pa]
};

template <int d>
struct Frame {
  double time = 0;
  std::vector<Vec<d>> x, v;
  std::vector<double> p;
  std::vector<double> drop_diameter;  ///< of the disc or ball of its volume; 0: no drop [m]
  std::vector<NodeKind> kind;
  std::vector<int> wall;
  std::vector<std::array<int, d + 1>> cells;
  std::vector<Outline<d>> outlines;
};

/// DIR/STEM.vtu (unless there is no node) and DIR/STEM_WALL.vtu; gives (part, file name) of each.
template <int d>
std::vector<std::pair<std::string, std::string>> write_pieces(const std::filesystem::path& directory,
                                                              const std::string& stem, const Frame<d>& frame);

using PointData = std::vector<std::pair<std::string, std::vector<double>>>;  ///< name and one value a vertex
/// `forward` is kept as field data; `v`: of the vertices, if there is one a vertex.
template <int d>
void write_surface(const std::filesystem::path& path, double time, const Surface<d>& surface,
                   const PointData& data = {}, const Vec<d>& forward = Vec<d>::UnitX(),
                   const std::vector<Vec<d>>& v = {});

/// frames.pvd with frames/000000.vtu, frames/000000_WALL.vtu, ...
class FrameSeries {
 public:
  struct Entry {
    double time;
    int index;
    std::string part, file;
    template <class Archive>
    void serialize(Archive& archive) {
      archive(time, index, part, file);
    }
  };

  explicit FrameSeries(std::filesystem::path directory) : directory_(std::move(directory)) {}

  template <int d>
  void add(const Frame<d>& frame);
  void write_index();  ///< also after load: drops the frames that came after the checkpoint

  template <class Archive>
  void serialize(Archive& archive) {
    archive(count_, entries_);
  }

 private:
  std::string lines_from(std::size_t first) const;
  void extend_index(std::size_t first);

  std::filesystem::path directory_;
  long count_ = 0;
  std::vector<Entry> entries_;
  std::size_t index_end_ = 0;  // of the entries in frames.pvd [bytes]; 0: there is none yet
};

/// A frame as frames.pvd lists it: (part, file in the run's folder) of each piece, the fluid's first.
struct ListedFrame {
  double time = 0;  ///< [s]
  std::vector<std::pair<std::string, std::string>> pieces;
};
/// Of a run's folder; none where there is no frames.pvd, or none that can be read.
std::vector<ListedFrame> listed_frames(const std::filesystem::path& run);

/// A name that is safe as part of a file name: letters, digits, - and _ stay, the rest becomes _.
std::string file_name_of(const std::string& name);

}  // namespace splashdown::apps
