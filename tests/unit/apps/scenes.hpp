// Scenes that the tests of this folder start from.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace splashdown::apps::testing {

/// A free wedge over a tank of water. Line numbers in tests refer to this text.
inline const std::string wedge_drop = R"(title = "wedge"
[time]
end = 0.02
[gravity]
acceleration = [0, -9.81]
[tank]
min = [-2, -1]
max = [2, 1]
[fluid]
density = 1000
[fluid.size]
surface = 0.01
far = 0.2
[[fluid.region]]
shape = "box"
min = [-2, -1]
max = [2, 0]
[[body]]
name = "wedge"
mass = 241
position = [0, 0.01]
velocity = [0, -6.15]
free = ["y"]
size = 0.005
shape = { type = "wedge", deadrise_deg = 30, breadth = 0.5 }
[output]
interval = 0.001
[[record]]
kind = "pressure"
name = "keel"
body = "wedge"
point = [0, 0]
)";

/// The same with one piece of text replaced by another.
inline std::string wedge_drop_with(const std::string& from, const std::string& to) {
  std::string text = wedge_drop;
  return text.replace(text.find(from), from.size(), to);
}

/// A mistake in a good text, and what the message about it has to say.
struct Mistake {
  const char* name;
  const char* from;  ///< text of the good file ...
  const char* to;    ///< ... and what stands in its place
  int line;          ///< where the problem is
  const char* key;   ///< as the message begins after the place
  const char* rule;  ///< part of the rule or the cure
};

inline void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

/// `file`: as messages name it.
inline void expect_told(const std::string& message, const std::string& file, const Mistake& mistake) {
  const auto start = file + ":" + std::to_string(mistake.line) + ": " + mistake.key;
  EXPECT_TRUE(message.starts_with(start)) << message << "\nshould start with " << start;
  EXPECT_NE(message.find(mistake.rule), std::string::npos) << message << "\nshould contain " << mistake.rule;
  EXPECT_TRUE(std::string(".?'").find(message.back()) != std::string::npos) << "no cure: " << message;
}

}  // namespace splashdown::apps::testing
