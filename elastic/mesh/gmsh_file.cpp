#include "elastic/mesh/gmsh_file.hpp"

#include <cmath>
#include <fstream>
#include <sstream>
#include <unordered_map>

namespace splashdown::elastic {
namespace {

/// Types of elements of the file format: straight and quadratic simplices of a dimension.
template <int d>
inline constexpr int straight_type = d == 2 ? 2 : 4;
template <int d>
inline constexpr int quadratic_type = d == 2 ? 9 : 11;
/// Number of nodes and dimension of a type: points, lines, triangles, quadrangles, tetrahedra.
struct ElementType {
  int type, nodes, dimension;
};
constexpr ElementType element_types[] = {{15, 1, 0}, {1, 2, 1},  {8, 3, 1},  {2, 3, 2}, {9, 6, 2},
                                         {3, 4, 2},  {10, 9, 2}, {16, 8, 2}, {4, 4, 3}, {11, 10, 3}};

/// Lines with their numbers.
class Lines {
 public:
  Lines(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}
  /// False at the end.
  bool next() {
    std::string line;
    while (std::getline(in_, line)) {
      ++number_;
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      words_ = std::istringstream(line);
      text_ = line.substr(0, line.find_last_not_of(" \t\r") + 1);
      return true;
    }
    return false;
  }
  void need_next(const char* what) {
    if (!next()) fail(std::string("the file ends where ") + what + " should follow");
  }
  const std::string& text() const { return text_; }
  template <class T>
  T take(const char* what) {
    T value{};
    if (!(words_ >> value)) fail(std::string("expected ") + what);
    return value;
  }
  [[noreturn]] void fail(const std::string& what,
                         const std::string& cure = "Export it from Gmsh anew, as text of version 2.2 or 4.1.") const {
    throw MeshError(name_ + ":" + std::to_string(number_) + ": " + what, cure);
  }

 private:
  std::istream& in_;
  std::string name_, text_;
  std::istringstream words_;
  long number_ = 0;
};

/// What a file has told so far.
template <int d>
class Content {
 public:
  Content(Lines& lines, double scale) : lines_(lines), scale_(scale) {}

  void add_node(long tag) {
    Eigen::Vector3d x;
    for (double& value : x) value = scale_ * lines_.template take<double>("a coordinate");
    if (!x.allFinite()) lines_.fail("a coordinate is not finite");
    if (!number_.try_emplace(tag, static_cast<int>(nodes_.size())).second)
      lines_.fail("node " + std::to_string(tag) + " occurs twice");
    nodes_.push_back(x);
  }

  /// The element on the line, whose words left are its nodes.
  void add_element(int type) {
    const ElementType* known = nullptr;
    for (const auto& row : element_types)
      if (row.type == type) known = &row;
    const bool is_simplex = type == straight_type<d> || type == quadratic_type<d>;
    if (!known || known->dimension > d || (known->dimension == d && !is_simplex))
      lines_.fail("elements of type " + std::to_string(type) + " are no " + (d == 2 ? "triangles" : "tetrahedra"),
                  d == 2 ? "Mesh the outline with triangles (in Gmsh: no Recombine), in the plane z = 0."
                         : "Mesh the solid with tetrahedra (in Gmsh: no Recombine, no hexahedra or prisms).");
    if (!is_simplex) return;
    if (type_ != 0 && type_ != type) lines_.fail("straight and quadratic elements are mixed");
    type_ = type;
    auto& cell = cells_.emplace_back();
    for (int a = 0; a < known->nodes; ++a) {
      const long tag = lines_.template take<long>("the number of a node");
      const auto node = number_.find(tag);
      if (node == number_.end())
        lines_.fail("an element has node " + std::to_string(tag) + ", which is not in the file");
      cell[a] = node->second;  // the order of `cell_edges` is Gmsh's
    }
  }

  SolidMesh<d> mesh() const {
    if (cells_.empty())
      lines_.fail(std::string("the file has no ") + (d == 2 ? "triangles" : "tetrahedra"),
                  "Export the mesh of the solid itself: in Gmsh a physical group of it, or Save All.");
    Points<d> nodes(d, nodes_.size());
    for (std::size_t a = 0; a < nodes_.size(); ++a) {
      nodes.col(a) = nodes_[a].template head<d>();
      if (d == 2 && std::abs(nodes_[a].z() - nodes_[0].z()) > 1e-9 * (1 + nodes_[a].norm()))
        lines_.fail("the mesh is not plane: z differs from node to node", "Draw the body in the plane z = 0.");
    }
    try {
      if (type_ == quadratic_type<d>) return solid_mesh<d>(nodes, cells_);
      Simplices<d> simplices(cells_.size());
      for (std::size_t c = 0; c < cells_.size(); ++c) std::copy_n(cells_[c].begin(), d + 1, simplices[c].begin());
      return quadratic_mesh<d>(nodes, simplices);
    } catch (const MeshError& error) {
      lines_.fail(error.what(), error.cure);
    }
  }

 private:
  Lines& lines_;
  double scale_;
  int type_ = 0;
  std::unordered_map<long, int> number_;
  std::vector<Eigen::Vector3d> nodes_;
  std::vector<std::array<int, cell_nodes<d>>> cells_;
};

template <int d>
void read_nodes(Lines& lines, bool in_blocks, Content<d>& content) {
  lines.need_next("the number of nodes");
  const long blocks = lines.take<long>("a number of nodes");
  for (long block = 0; !in_blocks && block < blocks; ++block) {
    lines.need_next("a node");
    content.add_node(lines.take<long>("the number of a node"));
  }
  for (long block = 0; in_blocks && block < blocks; ++block) {
    lines.need_next("a block of nodes");
    for (int skipped = 0; skipped < 3; ++skipped) lines.take<long>("dimension, number and parameters of an entity");
    const long count = lines.take<long>("how many nodes the block has");
    std::vector<long> tags;
    for (long k = 0; k < count; ++k) {
      lines.need_next("the number of a node");
      tags.push_back(lines.take<long>("the number of a node"));
    }
    for (const long tag : tags) {
      lines.need_next("a node");
      content.add_node(tag);
    }
  }
}

template <int d>
void read_elements(Lines& lines, bool in_blocks, Content<d>& content) {
  lines.need_next("the number of elements");
  const long blocks = lines.take<long>("a number of elements");
  for (long block = 0; !in_blocks && block < blocks; ++block) {
    lines.need_next("an element");
    lines.take<long>("the number of an element");
    const int type = lines.take<int>("the type of an element");
    const int tags = lines.take<int>("how many tags an element has");
    for (int skipped = 0; skipped < tags; ++skipped) lines.take<long>("a tag");
    content.add_element(type);
  }
  for (long block = 0; in_blocks && block < blocks; ++block) {
    lines.need_next("a block of elements");
    for (int skipped = 0; skipped < 2; ++skipped) lines.take<long>("dimension and number of an entity");
    const int type = lines.take<int>("the type of the block's elements");
    const long count = lines.take<long>("how many elements the block has");
    for (long k = 0; k < count; ++k) {
      lines.need_next("an element");
      lines.take<long>("the number of an element");
      content.add_element(type);
    }
  }
}

void pass_over(Lines& lines, const std::string& section) {
  const std::string end = "$End" + section.substr(1);
  while (lines.text() != end)
    if (!lines.next()) lines.fail("the file ends within " + section);
}

}  // namespace

template <int d>
SolidMesh<d> read_gmsh(std::istream& text, const std::string& name, double scale) {
  Lines lines(text, name);
  if (!lines.next() || lines.text() != "$MeshFormat")
    lines.fail("is no mesh of Gmsh: it does not begin with $MeshFormat");
  lines.need_next("the version");
  const double version = lines.take<double>("the version");
  const bool in_blocks = version == 4.1;
  if (version != 2.2 && !in_blocks) lines.fail("version " + lines.text() + " is not read");
  if (lines.take<int>("0 for text, 1 for binary") != 0)
    lines.fail("the file is binary", "Export it as text (in Gmsh: Mesh.Binary = 0).");
  Content<d> content(lines, scale);
  pass_over(lines, "$MeshFormat");
  while (lines.next()) {
    const std::string section = lines.text();
    if (section.front() != '$') lines.fail("expected the beginning of a section, $...");
    if (section == "$Nodes") read_nodes(lines, in_blocks, content);
    if (section == "$Elements") read_elements(lines, in_blocks, content);
    pass_over(lines, section);
  }
  return content.mesh();
}

template <int d>
SolidMesh<d> read_gmsh(const std::filesystem::path& file, double scale) {
  std::ifstream text(file);
  if (!text) throw MeshError(file.string() + ": cannot be read", "Name a file that exists.");
  return read_gmsh<d>(text, file.string(), scale);
}

template SolidMesh<2> read_gmsh<2>(std::istream&, const std::string&, double);
template SolidMesh<3> read_gmsh<3>(std::istream&, const std::string&, double);
template SolidMesh<2> read_gmsh<2>(const std::filesystem::path&, double);
template SolidMesh<3> read_gmsh<3>(const std::filesystem::path&, double);

}  // namespace splashdown::elastic
