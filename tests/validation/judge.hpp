// Evaluates an example's checks on what its runs left behind.
#pragma once

#include <map>
#include <string>

#include "tests/validation/check.hpp"
#include "tests/validation/runner.hpp"

namespace splashdown::validation {

struct Verdict {
  std::string example, check, run;
  double measured = 0;
  std::string expected;  ///< as text: a number, "<= 0.02", or empty
  std::string allowed;   ///< as text: "1 %", "0.02", or empty
  std::string unit, why;
  bool judged = true;  ///< false: reported only
  bool passed = false;
  std::string error;  ///< why there is no number
};

class Judge {
 public:
  Judge(Example example, Runner runner) : example_(std::move(example)), runner_(std::move(runner)) {}
  const Example& example() const { return example_; }
  /// Makes the run if it has not been made. Checks are to be judged in the order of the file.
  Verdict judge(const CheckSpec& check);

 private:
  double measure(const CheckSpec& check, Verdict& verdict);

  Example example_;
  Runner runner_;
  std::map<std::string, double> measured_;  ///< by earlier checks
};

}  // namespace splashdown::validation
