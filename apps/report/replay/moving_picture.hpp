// Frames as plain triangles and segments, and as bytes.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::apps {

/// A part of a frame. Points have three coordinates [m]; in the plane the third is zero.
struct MovingPart {
  std::vector<std::array<double, 3>> points;
  std::vector<int> cells;        ///< three points a triangle; of bodies in the plane two a segment
  std::vector<double> pressure;  ///< at the points [Pa]; zero where a file has none
};

struct MovingFrame {
  double time = 0;  ///< [s]
  MovingPart water;
  std::vector<MovingPart> bodies;
};

struct MovingPicture {
  int dimension = 2;
  std::vector<std::string> names;  ///< of the bodies
  std::vector<MovingFrame> frames;
};

/// Reads frames.pvd and what it names, at most so many frames. Empty without frames. Throws std::runtime_error for damaged ones.
MovingPicture moving_picture(const std::filesystem::path& run, std::size_t most_frames);

/// {"dimension", "names", "low", "high" [m], "pressure" [Pa], "frames": [{"time", "water": {"points", "cells"}, "bodies": ...}]}: numbers of
/// points and cells; what they are is in the bytes, in this order: points as uint16 by axis, pressures as uint8, cells as uint32. Each
/// array as differences from number to number, modulo 2^bits, all their first bytes, then all second ones and so on. Cells of bodies
/// stand in the first frame alone.
struct PackedPicture {
  std::string json;
  std::string bytes;  ///< little-endian
  double limit = 0;   ///< where the colours end [Pa]
};
PackedPicture packed(const MovingPicture& picture);

}  // namespace splashdown::apps
