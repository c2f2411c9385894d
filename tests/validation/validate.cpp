// Runs examples and holds them against their check.toml, one GoogleTest a check.
//
//   validate --command build/release/splashdown --label nightly examples/wedge_drop
//   validate --csv validation.csv --page docs/validation.md        (only writes the page's table)
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/validation/check.hpp"
#include "tests/validation/judge.hpp"
#include "tests/validation/report.hpp"
#include "tests/validation/runner.hpp"

namespace splashdown::validation {
namespace {

struct Options {
  std::string command, label = "ci";
  std::filesystem::path scratch = "validation", csv, page;
  std::vector<std::filesystem::path> examples;
  bool reuse = false;
};

class CheckTest : public testing::Test {
 public:
  CheckTest(std::shared_ptr<Judge> judge, CheckSpec check, std::filesystem::path csv)
      : judge_(std::move(judge)), check_(std::move(check)), csv_(std::move(csv)) {}

  void TestBody() override {
    const Verdict verdict = judge_->judge(check_);
    fmt::print("{}\n", line_of(verdict));
    std::fflush(stdout);
    if (!csv_.empty()) append_row(csv_, verdict);
    EXPECT_TRUE(verdict.error.empty()) << verdict.error;
    EXPECT_TRUE(!verdict.judged || verdict.passed) << check_.quantity << "\nwhy: " << check_.why;
  }

 private:
  std::shared_ptr<Judge> judge_;  // GoogleTest keeps the factories of all tests, and they keep this
  CheckSpec check_;
  std::filesystem::path csv_;
};

void register_example(const std::filesystem::path& folder, const Options& options) {
  // Canonical: a trailing slash would leave the folder without a name.
  const Example example = read_example(std::filesystem::canonical(folder));
  const bool nightly = options.label == "nightly";
  const auto judge = std::make_shared<Judge>(
      example,
      Runner(std::filesystem::absolute(options.command), std::filesystem::absolute(options.scratch), options.reuse));
  for (const CheckSpec& check : example.checks) {
    if (!nightly && check.label == Label::nightly) continue;
    testing::RegisterTest(example.folder.filename().string().c_str(), check.name.c_str(), nullptr, nullptr, __FILE__,
                          __LINE__, [judge, check, csv = options.csv]() -> CheckTest* {
                            return new CheckTest(judge, check, csv);  // owned by GoogleTest
                          });
  }
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("Runs examples and checks them against their references.");
  app.add_option("examples", options.examples, "example folders")->check(CLI::ExistingDirectory);
  app.add_option("--command", options.command, "the splashdown program")->check(CLI::ExistingFile);
  app.add_option("--label", options.label, "which runs")->check(CLI::IsMember({"ci", "nightly"}));
  app.add_option("--scratch", options.scratch, "where the runs leave their files");
  app.add_option("--csv", options.csv, "file the verdicts are appended to");
  app.add_option("--page", options.page, "page whose table is written from --csv");
  app.add_flag("--reuse", options.reuse, "judge runs that are already in --scratch");
  CLI11_PARSE(app, argc, argv);

  for (const auto& folder : options.examples) register_example(folder, options);
  const int result = options.examples.empty() ? 0 : RUN_ALL_TESTS();
  if (!options.page.empty()) write_page(options.csv, options.page);
  return result;
}

}  // namespace
}  // namespace splashdown::validation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  try {
    return splashdown::validation::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "validate: {}\n", error.what());
    return 2;
  }
}
