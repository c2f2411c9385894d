#include "core/surface/facet_count.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "core/surface/surface_file.hpp"

namespace splashdown {
namespace {

const std::string decimate =
    "Coarsen it, e.g. MeshLab: Filters > Remeshing > Quadric Edge Collapse Decimation; 10000 to "
    "100000 facets make a good hull.";
const std::string export_again = "Export it again as STL or OBJ.";

void refuse_too_many(long facets, const char* more) {
  if (facets > most_facets)
    throw SurfaceFileError(fmt::format("has {}{} facets; {} are the most that are read", facets, more, most_facets),
                           decimate);
}

std::string_view word_of(std::string_view& text) {
  const auto begin = std::min(text.find_first_not_of(" \t\r"), text.size());
  const auto end = std::min(text.find_first_of(" \t\r", begin), text.size());
  const auto word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

bool is_finite_number(std::string_view word) {
  const std::string text(word);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

bool is_point(std::string_view rest) {
  for (int k = 0; k < 3; ++k)
    if (!is_finite_number(word_of(rest))) return false;
  return true;
}

/// Triangles of a line; -1: no such line.
int stl_facets(std::string_view line) {
  const auto key = word_of(line);
  if (key == "vertex") return is_point(line) ? 0 : -1;
  if (key == "facet") return word_of(line) == "normal" ? 1 : -1;
  constexpr std::array<std::string_view, 5> others{"outer", "endloop", "endfacet", "solid", "endsolid"};
  return key.empty() || std::find(others.begin(), others.end(), key) != others.end() ? 0 : -1;
}

int obj_facets(std::string_view line) {
  const auto key = word_of(line);
  if (key == "v") return is_point(line) ? 0 : -1;
  if (key == "f") {
    int corners = 0;
    while (!word_of(line).empty()) ++corners;
    return corners >= 3 ? corners - 2 : -1;
  }
  constexpr std::array<std::string_view, 10> others{"vn", "vt", "vp", "o", "g", "s", "usemtl", "mtllib", "l", "p"};
  const bool known = key.empty() || key.front() == '#' || std::find(others.begin(), others.end(), key) != others.end();
  return known ? 0 : -1;
}

/// What a reader of lines sees of a line that is none: its beginning, as far as it can be printed.
std::string shown(std::string_view line) {
  constexpr std::size_t longest = 40;
  std::string text(line.substr(0, longest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  return text + (line.size() > longest ? "..." : "");
}

long count_lines(std::istream& file, int (*facets_of)(std::string_view), const char* format) {
  std::array<char, 4096> buffer{};  // no line of a mesh is longer; a file without lines must not fill the memory
  long facets = 0, number = 0;
  while (file.getline(buffer.data(), buffer.size()) || file.gcount() > 0) {
    ++number;
    const std::string_view line(buffer.data());
    const int found = file.fail() ? -1 : facets_of(line);
    if (found < 0)
      throw SurfaceFileError(
          fmt::format("is not a mesh: line {}, '{}', is no line of {} (numbers with a point, not a comma)", number,
                      shown(line), format),
          export_again);
    facets += found;
    refuse_too_many(facets, " or more");
  }
  return facets;
}

}  // namespace

FacetCount count_facets(const std::filesystem::path& path) {
  auto extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension != ".stl" && extension != ".obj")
    throw SurfaceFileError(fmt::format("must be an .stl or .obj file, not '{}'", extension), export_again);
  const char* const cure = "Name a file; relative names begin at the folder of the scene.";
  std::error_code no_error;  // what cannot be asked for cannot be opened either
  const auto kind = std::filesystem::status(path, no_error).type();
  using enum std::filesystem::file_type;
  if (kind == directory) throw SurfaceFileError("cannot be read: it is a folder", cure);
  if (kind == fifo || kind == character || kind == block || kind == socket)  // may never end, or never begin
    throw SurfaceFileError("cannot be read: it is a pipe or a device, not a file", cure);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw SurfaceFileError(fmt::format("cannot be read: {}", std::strerror(errno)), cure);
  if (extension == ".obj") return {SurfaceFormat::obj, count_lines(file, obj_facets, "OBJ")};

  constexpr std::uintmax_t header = 84, record = 50;
  const auto size = std::filesystem::file_size(path);
  std::array<char, header> head{};
  std::uint32_t facets = 0;
  if (file.read(head.data(), head.size())) std::memcpy(&facets, head.data() + 80, sizeof facets);  // little endian
  const bool whole = size >= header && size == header + record * facets;
  const bool text = std::string_view(head.data(), 5) == "solid";
  if (whole) {
    refuse_too_many(facets, "");
    return {SurfaceFormat::stl_binary, facets};
  }
  file.clear();
  file.seekg(0);
  // Binary files, too, begin with "solid" at times; their bytes are no text.
  const bool printable =
      std::none_of(head.begin(), head.begin() + std::min(size, header), [](char c) { return c == '\0'; });
  if (text || printable) return {SurfaceFormat::stl_ascii, count_lines(file, stl_facets, "STL")};
  throw SurfaceFileError(fmt::format("is not a mesh: as a binary STL of {} facets it would have {} bytes, not {}",
                                     facets, header + record * facets, size),
                         export_again);
}

}  // namespace splashdown
