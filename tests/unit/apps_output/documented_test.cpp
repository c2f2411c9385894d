// docs/files.md lists every column that is written, in its order, and every code of the frames.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "apps/record/frames/frames.hpp"
#include "apps/record/passes.hpp"
#include "apps/record/sections/section_loads.hpp"
#include "apps/record/sections/velocity_lines.hpp"
#include "apps/record/tables/rows.hpp"

namespace splashdown::apps::documented_test {
namespace {

using Lines = std::vector<std::string>;

/// The lines below a heading, to the next one.
Lines section(const std::string& heading) {
  std::ifstream in(SPLASHDOWN_DOCS "/files.md");
  Lines lines;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## ")) inside = line == "## " + heading;
    if (inside) lines.push_back(line);
  }
  EXPECT_FALSE(lines.empty()) << heading;
  return lines;
}

/// Words in backquotes of the first cell of each row.
Lines documented(const std::string& heading) {
  Lines words;
  static const std::regex word("`([^`]+)`");
  for (const auto& line : section(heading)) {
    if (!line.starts_with("| `")) continue;
    const auto cell = line.substr(0, line.find('|', 1));
    for (auto it = std::sregex_iterator(cell.begin(), cell.end(), word); it != std::sregex_iterator(); ++it)
      words.push_back((*it)[1]);
  }
  return words;
}

Lines columns(const std::string& header) {
  Lines names;
  std::istringstream in(header);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

TEST(Documented, columns_of_tables_are_those_that_are_written) {
  EXPECT_EQ(documented("bodies.csv"), columns(bodies_header));
  EXPECT_EQ(documented("fluid.csv"), columns(fluid_header({})));
  EXPECT_EQ(documented("probes.csv"), columns(probes_header));
  EXPECT_EQ(documented("passes.csv"), columns(passes_header));
  EXPECT_EQ(documented("velocity_lines.csv"), columns(velocity_lines_header));
  EXPECT_EQ(documented("section_loads.csv"), columns(section_loads_header));
}

TEST(Documented, codes_of_nodes_are_those_of_the_frames) {
  Lines codes;
  for (const auto& line : section("frames and snapshots"))
    if (line.size() > 3 && line.starts_with("| ") && std::isdigit(static_cast<unsigned char>(line[2])))
      codes.push_back(line);
  const std::vector<std::pair<NodeKind, const char*>> kinds = {
      {NodeKind::interior, "interior"},     {NodeKind::free_surface, "free surface"},
      {NodeKind::wall, "slides on a wall"}, {NodeKind::wall_vertex, "corner of a wall"},
      {NodeKind::contact, "contact line"},  {NodeKind::drop, "drop"}};
  ASSERT_EQ(codes.size(), kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kinds[i].first), i);
    EXPECT_TRUE(codes[i].starts_with("| " + std::to_string(i) + " |")) << codes[i];
    EXPECT_NE(codes[i].find(kinds[i].second), std::string::npos) << codes[i];
  }
}

TEST(Documented, fields_of_frames_are_named) {
  const auto words = documented("frames and snapshots");
  for (const char* field : {"v", "p", "drop_diameter", "kind", "wall"})
    EXPECT_NE(std::ranges::find(words, field), words.end()) << field;
}

}  // namespace
}  // namespace splashdown::apps::documented_test
