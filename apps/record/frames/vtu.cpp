#include "apps/record/frames/vtu.hpp"

#include <algorithm>
#include <bit>
#include <fstream>
#include <pugixml.hpp>
#include <stdexcept>

#include "apps/record/frames/vtu_blocks.hpp"

namespace splashdown::apps {

namespace {

static_assert(std::endian::native == std::endian::little);
constexpr const char* header_type = "UInt64";
constexpr const char* compressor = "vtkZLibDataCompressor";

template <class Value>
constexpr const char* type_name = nullptr;
template <>
constexpr const char* type_name<double> = "Float64";
template <>
constexpr const char* type_name<int> = "Int32";
template <>
constexpr const char* type_name<unsigned char> = "UInt8";

template <class Value>
pugi::xml_node add(pugi::xml_node parent, const std::string& name, const std::vector<Value>& values, int components) {
  auto node = parent.append_child("DataArray");
  node.append_attribute("type") = type_name<Value>;
  if (!name.empty()) node.append_attribute("Name") = name.c_str();
  if (components > 1) node.append_attribute("NumberOfComponents") = components;
  node.append_attribute("format") = "binary";
  node.text() = blocks_of({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)}).c_str();
  return node;
}
void add(pugi::xml_node parent, const std::vector<VtuArray>& arrays, bool count_tuples) {
  for (const auto& array : arrays)
    std::visit(
        [&](const auto& values) {
          auto node = add(parent, array.name, values, array.components);
          if (count_tuples)
            node.append_attribute("NumberOfTuples") = values.size() / static_cast<std::size_t>(array.components);
        },
        array.values);
}

class Reader {
 public:
  explicit Reader(std::string_view file) {
    if (const auto parsed = document_.load_buffer(file.data(), file.size()); !parsed)
      throw std::runtime_error(file.find("<AppendedData encoding=\"raw\">") != file.npos
                                   ? "its arrays are raw bytes, as earlier versions wrote them; ParaView reads it"
                                   : std::string("damaged XML: ") + parsed.description());
    require_attribute("type", "UnstructuredGrid");
    require_attribute("byte_order", "LittleEndian");
    require_attribute("header_type", header_type);
    require_attribute("compressor", compressor);
  }

  pugi::xml_node grid() const { return root().child("UnstructuredGrid"); }

  template <class Value>
  std::vector<Value> values(pugi::xml_node array) const {
    if (array.attribute("type").value() != std::string_view(type_name<Value>))
      throw std::runtime_error(std::string("an array is not of type ") + type_name<Value>);
    std::string_view text = array.text().get();
    constexpr const char* blanks = " \t\r\n";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    text = text.substr(0, text.find_last_not_of(blanks) + 1);
    return read_blocks<Value>(text);
  }

  VtuArray array(pugi::xml_node node) const {
    VtuArray result{node.attribute("Name").value(), {}, node.attribute("NumberOfComponents").as_int(1)};
    const std::string_view type = node.attribute("type").value();
    if (type == type_name<double>)
      result.values = values<double>(node);
    else if (type == type_name<int>)
      result.values = values<int>(node);
    else
      result.values = values<unsigned char>(node);
    return result;
  }

 private:
  pugi::xml_node root() const { return document_.child("VTKFile"); }
  void require_attribute(const char* name, const std::string& expected) const {
    if (const std::string found = root().attribute(name).value(); found != expected)
      throw std::runtime_error(std::string(name) + " is \"" + found + "\", not \"" + expected + "\"");
  }

  pugi::xml_document document_;
};

void require(bool holds, const char* otherwise) {
  if (!holds) throw std::runtime_error(otherwise);
}

void check_cells(const VtuGrid& grid, std::size_t points) {
  require(grid.types.size() == grid.offsets.size(), "has not one type a cell");
  std::size_t begin = 0;
  for (const int end : grid.offsets) {
    require(end >= 0 && static_cast<std::size_t>(end) >= begin, "its cells are not in order");
    begin = static_cast<std::size_t>(end);
  }
  require(begin == grid.connectivity.size(), "its cells are not whole");
  for (const int point : grid.connectivity)
    require(point >= 0 && static_cast<std::size_t>(point) < points, "a cell has a point that does not exist");
}

VtuGrid parsed(std::string_view file) {
  const Reader reader(file);
  const auto piece = reader.grid().child("Piece");
  VtuGrid grid;
  grid.points = reader.values<double>(piece.child("Points").child("DataArray"));
  const auto points = piece.attribute("NumberOfPoints").as_ullong();
  require(grid.points.size() % 3 == 0 && grid.points.size() / 3 == points, "has not three coordinates a point");
  const auto cells = [&](const char* name) {
    return piece.child("Cells").find_child_by_attribute("DataArray", "Name", name);
  };
  grid.connectivity = reader.values<int>(cells("connectivity"));
  grid.offsets = reader.values<int>(cells("offsets"));
  grid.types = reader.values<unsigned char>(cells("types"));
  check_cells(grid, points);
  for (const auto node : piece.child("PointData").children("DataArray")) {
    grid.point_data.push_back(reader.array(node));
    const auto& array = grid.point_data.back();
    const auto count = std::visit([](const auto& values) { return values.size(); }, array.values);
    require(
        array.components >= 1 && array.components <= 9 && count == points * static_cast<std::size_t>(array.components),
        "has not one value a point");
  }
  for (const auto node : reader.grid().child("FieldData").children("DataArray"))
    grid.field_data.push_back(reader.array(node));
  grid.scalars = piece.child("PointData").attribute("Scalars").value();
  return grid;
}

}  // namespace

void VtuGrid::add_cell(VtuCell type, const int* corners, int count) {
  connectivity.insert(connectivity.end(), corners, corners + count);
  offsets.push_back(static_cast<int>(connectivity.size()));
  types.push_back(static_cast<unsigned char>(type));
}

void write_vtu(const std::filesystem::path& path, const VtuGrid& grid) {
  pugi::xml_document document;
  auto root = document.append_child("VTKFile");
  root.append_attribute("type") = "UnstructuredGrid";
  root.append_attribute("version") = "1.0";
  root.append_attribute("byte_order") = "LittleEndian";
  root.append_attribute("header_type") = header_type;
  root.append_attribute("compressor") = compressor;
  auto whole = root.append_child("UnstructuredGrid");
  if (!grid.field_data.empty()) add(whole.append_child("FieldData"), grid.field_data, true);
  auto piece = whole.append_child("Piece");
  piece.append_attribute("NumberOfPoints") = grid.points.size() / 3;
  piece.append_attribute("NumberOfCells") = grid.types.size();
  auto point_data = piece.append_child("PointData");
  if (!grid.scalars.empty()) point_data.append_attribute("Scalars") = grid.scalars.c_str();
  add(point_data, grid.point_data, false);
  add(piece.append_child("Points"), "Points", grid.points, 3);
  auto cells = piece.append_child("Cells");
  add(cells, "connectivity", grid.connectivity, 1);
  add(cells, "offsets", grid.offsets, 1);
  add(cells, "types", grid.types, 1);
  std::ofstream out(path, std::ios::binary);
  document.save(out, "  ");
  out.close();
  if (!out) throw std::runtime_error(path.string() + ": cannot write");
}

VtuGrid read_vtu(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(in), {}};
  try {
    return parsed(file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": is not a readable .vtu file: " + error.what());
  }
}

}  // namespace splashdown::apps
