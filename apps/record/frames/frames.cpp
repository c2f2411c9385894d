#include "apps/record/frames/frames.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cctype>
#include <stdexcept>

#include "apps/record/tables/csv.hpp"

namespace splashdown::apps {

namespace {

template <int d>
constexpr int cell_type = d == 2 ? VTK_TRIANGLE : VTK_TETRA;
template <int d>
constexpr int facet_type = d == 2 ? VTK_LINE : VTK_TRIANGLE;

template <int d, class Vector>
void set_tuple(vtkDoubleArray& array, vtkIdType i, const Vector& value) {
  for (int k = 0; k < 3; ++k) array.SetTypedComponent(i, k, k < d ? value(k) : 0.0);
}

template <int d, class Range>
void set_points(vtkUnstructuredGrid& grid, const Range& points, vtkIdType count) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) set_tuple<d>(*coordinates, i, points(i));
  vtkNew<vtkPoints> vtk_points;
  vtk_points->SetDataTypeToDouble();
  vtk_points->SetData(coordinates);
  grid.SetPoints(vtk_points);
}

template <class Array, class Value>
void add_scalar(vtkUnstructuredGrid& grid, const char* name, const std::vector<Value>& values) {
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    array->SetValue(static_cast<vtkIdType>(i), static_cast<typename Array::ValueType>(values[i]));
  grid.GetPointData()->AddArray(array);
}

template <int d>
void add_velocity(vtkUnstructuredGrid& grid, const std::vector<Vec<d>>& values) {
  const auto count = static_cast<vtkIdType>(values.size());
  vtkNew<vtkDoubleArray> velocity;
  velocity->SetName("v");
  velocity->SetNumberOfComponents(3);
  velocity->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) set_tuple<d>(*velocity, i, values[static_cast<std::size_t>(i)]);
  grid.GetPointData()->AddArray(velocity);
}

void write(vtkUnstructuredGrid& grid, double time, const std::filesystem::path& path) {
  vtkNew<vtkDoubleArray> time_value;
  time_value->SetName("TimeValue");
  time_value->InsertNextValue(time);
  grid.GetFieldData()->AddArray(time_value);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(&grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  // Digits hardly compress: zlib makes frames a quarter smaller than LZ4 and is most of what they cost.
  writer->SetCompressorTypeToLZ4();
  if (writer->Write() != 1) throw std::runtime_error(path.string() + ": cannot write");
}

template <int d>
void write_fluid(const Frame<d>& frame, const std::filesystem::path& path) {
  vtkNew<vtkUnstructuredGrid> grid;
  const auto count = static_cast<vtkIdType>(frame.x.size());
  set_points<d>(
      *grid, [&](vtkIdType i) { return frame.x[static_cast<std::size_t>(i)]; }, count);

  std::vector<char> used(frame.x.size(), 0);
  grid->AllocateExact(static_cast<vtkIdType>(frame.cells.size()), d + 1);
  for (const auto& cell : frame.cells) {
    vtkIdType ids[d + 1];
    for (std::size_t k = 0; k < d + 1; ++k) {
      ids[k] = cell[k];
      used[static_cast<std::size_t>(cell[k])] = 1;
    }
    grid->InsertNextCell(cell_type<d>, d + 1, ids);
  }
  for (vtkIdType i = 0; i < count; ++i)
    if (!used[static_cast<std::size_t>(i)]) grid->InsertNextCell(VTK_VERTEX, 1, &i);

  add_velocity<d>(*grid, frame.v);
  add_scalar<vtkDoubleArray>(*grid, "p", frame.p);
  if (frame.drop_diameter.size() == frame.x.size())
    add_scalar<vtkDoubleArray>(*grid, "drop_diameter", frame.drop_diameter);
  add_scalar<vtkUnsignedCharArray>(*grid, "kind", frame.kind);
  add_scalar<vtkIntArray>(*grid, "wall", frame.wall);
  grid->GetPointData()->SetActiveScalars("p");
  write(*grid, frame.time, path);
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

template <int d>
void write_surface(const std::filesystem::path& path, double time, const Surface<d>& surface, const PointData& data,
                   const Vec<d>& forward, const std::vector<Vec<d>>& v) {
  vtkNew<vtkUnstructuredGrid> grid;
  const auto& [vertices, facets] = surface;
  set_points<d>(
      *grid, [&](vtkIdType i) { return vertices.col(i); }, vertices.cols());
  grid->AllocateExact(facets.cols(), d);
  for (Eigen::Index f = 0; f < facets.cols(); ++f) {
    vtkIdType ids[d];
    for (int k = 0; k < d; ++k) ids[k] = facets(k, f);
    grid->InsertNextCell(facet_type<d>, d, ids);
  }
  if (static_cast<Eigen::Index>(v.size()) == vertices.cols()) add_velocity<d>(*grid, v);
  for (const auto& [name, values] : data) add_scalar<vtkDoubleArray>(*grid, name.c_str(), values);
  vtkNew<vtkDoubleArray> direction;
  direction->SetName("forward");
  direction->SetNumberOfComponents(3);
  direction->SetNumberOfTuples(1);
  set_tuple<d>(*direction, 0, forward);
  grid->GetFieldData()->AddArray(direction);
  write(*grid, time, path);
}

template <int d>
PointData fields_of(const Outline<d>& outline) {
  if (outline.p.empty()) return {};
  return {{"p", outline.p}};
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
    write_surface<d>(directory / pieces.back().second, frame.time, outline.surface, fields_of(outline), outline.forward,
                     outline.v);
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
