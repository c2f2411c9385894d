#include "apps/record/frames/frames.hpp"

#include <fmt/format.h>

#include <cctype>
#include <pugixml.hpp>

#include "apps/files/csv.hpp"
#include "apps/record/frames/vtu.hpp"

namespace splashdown::apps {

namespace {

template <int d>
constexpr VtuCell cell_type = d == 2 ? VtuCell::triangle : VtuCell::tetrahedron;
template <int d>
constexpr VtuCell facet_type = d == 2 ? VtuCell::line : VtuCell::triangle;

/// Three numbers a vector; in the plane the third is 0.
template <int d>
void append(std::vector<double>& numbers, const Vec<d>& vector) {
  for (int k = 0; k < 3; ++k) numbers.push_back(k < d ? vector(k) : 0.0);
}

template <int d>
VtuArray vectors(const std::string& name, const std::vector<Vec<d>>& values) {
  std::vector<double> numbers;
  numbers.reserve(3 * values.size());
  for (const auto& value : values) append<d>(numbers, value);
  return {name, std::move(numbers), 3};
}

std::vector<VtuArray> time_value(double time) { return {{"TimeValue", std::vector<double>{time}}}; }

template <int d>
void write_fluid(const Frame<d>& frame, const std::filesystem::path& path) {
  VtuGrid grid;
  grid.points.reserve(3 * frame.x.size());
  for (const auto& x : frame.x) append<d>(grid.points, x);
  for (const auto& cell : frame.cells) grid.add_cell(cell_type<d>, cell.data(), d + 1);
  for (int i = 0; i < static_cast<int>(frame.kind.size()); ++i)
    if (frame.kind[static_cast<std::size_t>(i)] == NodeKind::drop) grid.add_cell(VtuCell::vertex, &i, 1);

  grid.point_data.push_back(vectors<d>("v", frame.v));
  grid.point_data.push_back({"p", frame.p});
  if (frame.drop_diameter.size() == frame.x.size()) grid.point_data.push_back({"drop_diameter", frame.drop_diameter});
  std::vector<unsigned char> kinds;
  for (const auto kind : frame.kind) kinds.push_back(static_cast<unsigned char>(kind));
  grid.point_data.push_back({"kind", std::move(kinds)});
  grid.point_data.push_back({"wall", frame.wall});
  grid.field_data = time_value(frame.time);
  grid.scalars = "p";
  write_vtu(path, grid);
}

std::string xml_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

const std::string index_head =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "  <Collection>\n";
const std::string index_foot = "  </Collection>\n</VTKFile>\n";

}  // namespace

std::string file_name_of(const std::string& name) {
  std::string safe = name;
  for (char& c : safe)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  return safe;
}

namespace {

/// A surface with its forward direction, without its values.
template <int d>
VtuGrid grid_of_surface(double time, const Surface<d>& surface, const PointData& data, const Vec<d>& forward,
                        const std::vector<Vec<d>>& v) {
  VtuGrid grid;
  const auto& [vertices, facets] = surface;
  for (Eigen::Index i = 0; i < vertices.cols(); ++i) append<d>(grid.points, vertices.col(i));
  for (Eigen::Index f = 0; f < facets.cols(); ++f) grid.add_cell(facet_type<d>, facets.col(f).data(), d);
  if (static_cast<Eigen::Index>(v.size()) == vertices.cols()) grid.point_data.push_back(vectors<d>("v", v));
  for (const auto& [name, values] : data) grid.point_data.push_back({name, values});
  grid.field_data = time_value(time);
  grid.field_data.push_back(vectors<d>("forward", std::vector<Vec<d>>{forward}));
  return grid;
}

template <int d>
PointData fields_of(const Outline<d>& outline) {
  PointData all;
  if (!outline.p.empty()) all.push_back({"p", outline.p});
  if (!outline.von_mises.empty()) all.push_back({"von_mises", outline.von_mises});
  return all;
}

template <int d>
void write_outline(const std::filesystem::path& path, double time, const Outline<d>& outline) {
  auto grid = grid_of_surface<d>(time, outline.surface, fields_of(outline), outline.forward, outline.v);
  if (!outline.u.empty()) grid.point_data.push_back(vectors<d>("u", outline.u));
  if (!outline.stress.empty()) {
    std::vector<double> rows;
    for (const auto& sigma : outline.stress) rows.insert(rows.end(), sigma.data(), sigma.data() + sigma.size());
    grid.point_data.push_back({"stress", std::move(rows), 9});
    grid.scalars = "von_mises";
  }
  write_vtu(path, grid);
}

}  // namespace

template <int d>
void write_surface(const std::filesystem::path& path, double time, const Surface<d>& surface, const PointData& data,
                   const Vec<d>& forward, const std::vector<Vec<d>>& v) {
  write_vtu(path, grid_of_surface<d>(time, surface, data, forward, v));
}

template <int d>
std::vector<std::pair<std::string, std::string>> write_pieces(const std::filesystem::path& directory,
                                                              const std::string& stem, const Frame<d>& frame) {
  std::filesystem::create_directories(directory);
  std::vector<std::pair<std::string, std::string>> pieces;
  if (!frame.x.empty()) {
    pieces.emplace_back("fluid", stem + ".vtu");
    write_fluid(frame, directory / pieces.back().second);
  }
  for (const auto& outline : frame.outlines) {
    pieces.emplace_back(outline.name, stem + "_" + file_name_of(outline.name) + ".vtu");
    write_outline<d>(directory / pieces.back().second, frame.time, outline);
  }
  return pieces;
}

template <int d>
void FrameSeries::add(const Frame<d>& frame) {
  const auto before = entries_.size();
  int index = 0;
  for (const auto& [part, file] : write_pieces(directory_ / "frames", fmt::format("{:06}", count_), frame))
    entries_.push_back({frame.time, index++, part, "frames/" + file});
  ++count_;
  extend_index(before);
}

std::string FrameSeries::lines_from(std::size_t first) const {
  std::string xml;
  for (std::size_t i = first; i < entries_.size(); ++i) {
    const auto& entry = entries_[i];
    xml += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", entry.time,
                       entry.index, xml_escaped(entry.part), xml_escaped(entry.file));
  }
  return xml;
}

void FrameSeries::write_index() {
  const auto xml = index_head + lines_from(0);
  write_file_atomically(directory_ / "frames.pvd", xml + index_foot);
  index_end_ = xml.size();
}

void FrameSeries::extend_index(std::size_t first) {
  const auto path = directory_ / "frames.pvd";
  std::error_code none;
  if (index_end_ == 0 || std::filesystem::file_size(path, none) != index_end_ + index_foot.size()) return write_index();
  const auto lines = lines_from(first);
  overwrite_end(path, index_end_, lines + index_foot);
  index_end_ += lines.size();
}

std::vector<ListedFrame> listed_frames(const std::filesystem::path& run) {
  std::vector<ListedFrame> frames;
  pugi::xml_document index;
  if (!index.load_file((run / "frames.pvd").c_str())) return frames;
  for (const auto& set : index.child("VTKFile").child("Collection").children("DataSet")) {
    const double time = set.attribute("timestep").as_double();
    if (frames.empty() || frames.back().time != time) frames.push_back({time, {}});
    frames.back().pieces.emplace_back(set.attribute("name").value(), set.attribute("file").value());
  }
  return frames;
}

template std::vector<std::pair<std::string, std::string>> write_pieces<2>(const std::filesystem::path&,
                                                                          const std::string&, const Frame<2>&);
template std::vector<std::pair<std::string, std::string>> write_pieces<3>(const std::filesystem::path&,
                                                                          const std::string&, const Frame<3>&);
template void write_surface<2>(const std::filesystem::path&, double, const Surface<2>&, const PointData&, const Vec<2>&,
                               const std::vector<Vec<2>>&);
template void write_surface<3>(const std::filesystem::path&, double, const Surface<3>&, const PointData&, const Vec<3>&,
                               const std::vector<Vec<3>>&);
template void FrameSeries::add<2>(const Frame<2>&);
template void FrameSeries::add<3>(const Frame<3>&);

}  // namespace splashdown::apps
