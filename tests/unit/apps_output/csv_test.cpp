#include "apps/files/csv.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "apps/record/tables/rows.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::csv_test {
namespace {

TEST(Csv, a_file_that_went_away_is_missed_and_can_be_copied_all_the_same) {
  const auto
      lose =
          std::vector<std::pair<const char*, void (*)(const std::filesystem::path&)>>{{"removed",
                                                                                       [](const auto& file) {
                                                                                         std::filesystem::remove(file);
                                                                                       }},
                                                                                      {"moved",
                                                                                       [](const auto& file) {
                                                                                         std::filesystem::rename(
                                                                                             file, file.string() +
                                                                                                       ".elsewhere");
                                                                                       }},
                                                                                      {"replaced",
                                                                                       [](const auto& file) {
                                                                                         std::filesystem::remove(file);
                                                                                         std::ofstream(file)
                                                                                             << "another";
                                                                                       }},
                                                                                      {"written over by a rename",
                                                                                       [](const auto& file) {
                                                                                         std::ofstream(file.string() +
                                                                                                       ".new")
                                                                                             << "another";
                                                                                         std::filesystem::rename(
                                                                                             file.string() + ".new",
                                                                                             file);
                                                                                       }}};
  for (const auto& [how, away] : lose) {
    ScratchFolder folder;
    const auto path = folder.path() / "a.csv";
    CsvFile file(path, "value");
    file.check_in_place();  // not even open
    file.create();
    file << 1.5;
    file.end_row();
    file.write();
    EXPECT_NO_THROW(file.check_in_place()) << how;
    away(path);
    file << 2.5;
    file.end_row();
    EXPECT_THROW(file.check_in_place(), FilesLost) << how;
    file.copy_to(folder.path() / "copy.csv");
    EXPECT_EQ(folder.text("copy.csv"), "value\n1.5\n2.5\n") << how;
  }
}

TEST(Csv, numbers_read_back_to_the_same_bits) {
  ScratchFolder folder;
  std::mt19937_64 random(7);
  std::vector<double> values{0.1 + 0.2, 1e-300, -0.0, std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::max()};
  for (int i = 0; i < 1000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  CsvFile file(folder.path() / "a.csv", "value");
  file.create();
  for (const double value : values) {
    file << value;
    file.end_row();
  }
  file.sync();
  const std::string text = folder.text("a.csv");
  const char* at = text.data() + text.find('\n') + 1;
  for (const double value : values) {
    double read = 0;
    at = std::from_chars(at, text.data() + text.size(), read).ptr + 1;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(Csv, text_with_separators_is_quoted) {
  ScratchFolder folder;
  CsvFile file(folder.path() / "a.csv", "name,value");
  file.create();
  file << std::string_view("left, \"upper\"") << 1;
  file.end_row();
  file.sync();
  EXPECT_EQ(folder.text("a.csv"), "name,value\n\"left, \"\"upper\"\"\",1\n");
}

TEST(Csv, reopening_cuts_what_came_after_the_given_length) {
  ScratchFolder folder;
  std::uint64_t length = 0;
  {
    CsvFile file(folder.path() / "a.csv", "value");
    file.create();
    file << 1;
    file.end_row();
    length = file.sync();
    file << 2;
    file.end_row();
  }
  EXPECT_EQ(folder.text("a.csv"), "value\n1\n2\n");
  CsvFile file(folder.path() / "a.csv", "value");
  file.reopen(length);
  file << 3;
  file.end_row();
  EXPECT_EQ(file.sync(), length + 2);
  EXPECT_EQ(folder.text("a.csv"), "value\n1\n3\n");
}

TEST(Csv, a_file_shorter_than_its_checkpoint_is_an_error) {
  ScratchFolder folder;
  {
    CsvFile file(folder.path() / "a.csv", "value");
    file.create();
  }
  CsvFile file(folder.path() / "a.csv", "value");
  EXPECT_THROW(file.reopen(100), std::runtime_error);
}

TEST(Csv, a_folder_that_cannot_be_written_is_an_error_that_names_the_file) {
  ScratchFolder folder;
  std::ofstream(folder.path() / "plain") << "not a folder";
  CsvFile file(folder.path() / "plain" / "a.csv", "value");
  EXPECT_THROW(file.create(), std::exception);
}

// The columns scripts are written against: docs, user guide.
TEST(Columns, bodies_begin_with_the_contract) {
  EXPECT_TRUE(std::string(bodies_header)
                  .starts_with("time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,ax,ay,az,alphax,alphay,alphaz,"
                               "fx,fy,fz,mx,my,mz,wetted"));
}

TEST(Columns, fluid_begins_with_the_contract_and_has_a_group_for_each_effect_present) {
  const std::string bare = fluid_header({});
  EXPECT_TRUE(
      bare.starts_with("time,dt,nodes,elements,volume,kinetic_energy,potential_energy,passes,residual,"
                       "wall_seconds"));
  EXPECT_EQ(bare.find("gravity"), std::string::npos);
  EXPECT_EQ(fluid_header({"gravity_energy", "viscosity_power"}), bare + ",gravity_energy,viscosity_power");
}

TEST(Columns, probes_are_the_contract) { EXPECT_STREQ(probes_header, "time,probe,value"); }

TEST(Columns, a_plane_row_fills_the_columns_of_a_spatial_one) {
  ScratchFolder folder;
  CsvFile file(folder.path() / "a.csv", bodies_header);
  file.create();
  Isometry<2> pose = Isometry<2>::Identity();
  pose.translation() = Vec<2>(1, 2);
  pose.linear() << 0, -1, 1, 0;  // a quarter turn
  WallLoad<2> load;
  load.physical << 10, 20, 30;
  load.repair << 1, 2, 3;
  load.wetted = 0.5;
  write_row(file, BodyRow<2>{0.25, "hull", pose, {3, 4, 5}, {6, 7, 8}, load, 0.125});
  file.sync();
  const std::string half = fmt::format("{}", std::cos(std::atan2(1.0, 0.0) / 2)),
                    other = fmt::format("{}", std::sin(std::atan2(1.0, 0.0) / 2));
  EXPECT_EQ(folder.text("a.csv"), std::string(bodies_header) + "\n0.25,hull,1,2,0," + half + ",0,0," + other +
                                      ",3,4,0,0,0,5,6,7,0,0,0,8,11,22,0,0,0,33,0.5,1,2,0,0,0,3,0,90,0,0.125\n");
}

}  // namespace
}  // namespace splashdown::apps::csv_test
