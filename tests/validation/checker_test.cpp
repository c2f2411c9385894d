// The checker on a stand-in for the splashdown command that leaves known numbers behind.
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "apps/quantity/table.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/validation/check.hpp"
#include "tests/validation/judge.hpp"
#include "tests/validation/report.hpp"
#include "tests/validation/runner.hpp"

namespace splashdown::validation {
namespace {

namespace fs = std::filesystem;

class Checker : public testing::Test, protected ScratchFolder {
 protected:
  Checker() {
    write(example_ / "reference.csv", "# exact\nseries,time,y\nup,0,9\ndown,0,0\ndown,1,-0.5\ndown,2,-2\n");
    // run SCENE --out DIR --threads 1 ...: two bodies, one of which falls with unit acceleration.
    write("command",
          "#!/bin/sh\n"
          "echo \"$@\"\n"
          "case \"$*\" in *broken=1*) echo 'it broke'; exit 3;; esac\n"
          "mkdir -p \"$4\" && cd \"$4\"\n"
          "printf 'time,body,y,vy\\n0,a,0,0\\n0,b,5,0\\n1,a,-0.5,-1\\n1,b,5,0\\n2,a,-2,-2\\n2,b,5,0\\n' > "
          "bodies.csv\n"
          "echo '{\"steps\": 2, \"bodies\": {\"a\": {\"impulse\": [0, 7.5]}}, \"status\": \"done\"}' > "
          "summary.json\n");
    fs::permissions(path() / "command", fs::perms::owner_all);
  }

  Example example(const std::string& checks) {
    write(example_ / "check.toml",
          "title = \"Falling\"\n[constants]\nspeed = 2\n"
          "[[run]]\nname = \"base\"\n"
          "[[run]]\nname = \"broken\"\nset = [\"broken=1\"]\nexit_code = 3\nlabel = \"nightly\"\n" +
              checks);
    return read_example(example_);
  }

  std::vector<Verdict> verdicts(const std::string& checks) {
    Judge judge(example(checks), Runner(path() / "command", path() / "scratch", false));
    std::vector<Verdict> result;
    for (const CheckSpec& check : judge.example().checks) result.push_back(judge.judge(check));
    return result;
  }

  const fs::path example_ = path() / "falling";
};

std::string check(const std::string& lines) { return "[[check]]\nname = \"c\"\nwhy = \"law\"\n" + lines + "\n"; }

TEST_F(Checker, columns_of_one_body_are_compared_with_one_series_of_the_reference) {
  const auto v =
      verdicts(check("table = \"bodies.csv:a\"\nreference = \"reference.csv:down\"\n"
                     "quantity = \"max(abs(y - interp(ref.time, ref.y, time)))\"\n"
                     "expected = 0\ntolerance_absolute = 1e-12"));
  EXPECT_TRUE(v[0].passed) << v[0].error;
}

TEST_F(Checker, tolerance_is_relative_and_its_edge_belongs_to_it) {
  const auto at = [&](const std::string& expected) {
    return verdicts(check("table = \"bodies.csv:a\"\nquantity = \"-last(vy)\"\nexpected = " + expected +
                          "\ntolerance = 0.25"))[0]
        .passed;
  };
  EXPECT_TRUE(at("1.6"));
  EXPECT_FALSE(at("1.59"));
  EXPECT_TRUE(at("\"speed\""));
}

TEST_F(Checker, where_selects_rows) {
  const auto v =
      verdicts(check("table = \"bodies.csv:a\"\nwhere = \"time > 0.5\"\nquantity = \"count(y)\"\n"
                     "at_least = 2\nat_most = 2"));
  EXPECT_TRUE(v[0].passed) << v[0].error;
}

TEST_F(Checker, summary_entries_and_earlier_checks_have_names) {
  const auto v = verdicts(check("quantity = \"summary.bodies.a.impulse.1\"") +
                          "[[check]]\nname = \"d\"\nwhy = \"law\"\nquantity = \"2*c + summary.steps\"\n"
                          "expected = 17\ntolerance = 0\n");
  EXPECT_FALSE(v[0].judged);
  EXPECT_DOUBLE_EQ(v[0].measured, 7.5);
  EXPECT_TRUE(v[1].passed) << v[1].error;
}

TEST_F(Checker, nan_never_passes) {
  const auto v = verdicts(check("quantity = \"0/0\"\nexpected = 1\ntolerance = 10") +
                          "[[check]]\nname = \"d\"\nwhy = \"law\"\nquantity = \"0/0\"\nat_most = 1\n");
  EXPECT_FALSE(v[0].passed);
  EXPECT_FALSE(v[1].passed);
}

TEST_F(Checker, expected_failure_of_a_run_is_a_result_and_an_unexpected_one_an_error) {
  const auto v = verdicts(check("run = \"broken\"\nquantity = \"exit_code\"\nexpected = 3\ntolerance = 0"));
  EXPECT_TRUE(v[0].passed) << v[0].error;
  write("command", "#!/bin/sh\necho 'no water'\nexit 2\n");
  const auto w = verdicts(check("quantity = \"1\"\nexpected = 1\ntolerance = 0"));
  EXPECT_FALSE(w[0].passed);
  EXPECT_NE(w[0].error.find("no water"), std::string::npos);
}

TEST_F(Checker, a_run_is_made_once_and_gets_its_arguments) {
  verdicts(check("quantity = \"1\"") + "[[check]]\nname = \"d\"\nwhy = \"law\"\nquantity = \"2\"\n" +
           "[[check]]\nname = \"e\"\nwhy = \"law\"\nrun = \"broken\"\nquantity = \"3\"\n");
  const std::string log = text(fs::path("scratch") / "falling" / "broken.log");
  EXPECT_NE(log.find("--set broken=1"), std::string::npos);
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 2);
}

TEST_F(Checker, a_check_of_a_nightly_run_is_nightly) {
  const Example read = example(check("quantity = \"1\"\nrun = \"broken\"") +
                               "[[check]]\nname = \"d\"\nwhy = \"law\"\nquantity = \"2\"\n" +
                               "[[check]]\nname = \"e\"\nwhy = \"law\"\nquantity = \"3\"\nlabel = \"nightly\"\n");
  EXPECT_EQ(read.checks[0].label, Label::nightly);
  EXPECT_EQ(read.checks[1].label, Label::ci);
  EXPECT_EQ(read.checks[2].label, Label::nightly);
}

TEST_F(Checker, misspelt_keys_and_missing_tolerances_are_refused_with_their_line) {
  for (const char* lines : {"quantity = \"1\"\ntolerence = 1", "quantity = \"1\"\nexpected = 1", "at_most = 1",
                            "quantity = \"1\"\ntolerance = 1", "quantity = \"1\"\nrun = \"nope\"", "quantity = 3",
                            "quantity = \"1\"\nat_most = \"x\""})
    EXPECT_THROW(example(check(lines)), std::runtime_error) << lines;
  try {
    example(check("quantity = \"1\"\ntolerence = 1"));
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("check.toml:15: unknown key 'tolerence'"), std::string::npos)
        << error.what();
  }
}

TEST_F(Checker, page_shows_the_newest_row_of_each_check_and_keeps_its_text) {
  const auto csv = path() / "validation.csv", page = path() / "page.md";
  write(page,
        "before\n<!-- validation table: begin -->\n| [falling](x) | old |\n| [rising](x) | d | 3 |\n"
        "<!-- validation table: end -->\nafter\n");
  Verdict verdict{.example = "falling",
                  .check = "c",
                  .run = "base",
                  .measured = 1,
                  .expected = "2",
                  .allowed = "1 %",
                  .unit = "m",
                  .why = "one, two",
                  .judged = true,
                  .passed = false,
                  .error = ""};
  append_row(csv, verdict);
  verdict.measured = 2;
  verdict.passed = true;
  append_row(csv, verdict);
  write_page(csv, page);
  const std::string written = text(page);
  EXPECT_EQ(written.find("before\n"), 0u);
  EXPECT_NE(written.find("\nafter\n"), std::string::npos);
  EXPECT_EQ(written.find("old"), std::string::npos);
  EXPECT_EQ(written.find("FAIL"), std::string::npos);
  EXPECT_NE(written.find("| [rising](x) | d | 3 |\n"), std::string::npos) << written;
  EXPECT_NE(written.find("| c | 2 | 2 | 1 % | m | pass | one; two |"), std::string::npos) << written;
}

TEST_F(Checker, torn_tables_are_refused_with_file_and_line) {
  write("torn.csv", "# note\na,b\n1,2\n3\n");
  try {
    quantity::read_table(path(), "torn.csv");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("torn.csv:4: 1 cells under 2"), std::string::npos);
  }
  EXPECT_THROW(quantity::read_table(path(), "none.csv"), std::runtime_error);
}

}  // namespace
}  // namespace splashdown::validation
