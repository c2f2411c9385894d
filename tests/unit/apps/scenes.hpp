// Scenes that the tests of this folder start from.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "apps/scene/read/read.hpp"

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

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << "the test's own text is out of date: " << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

/// The same with one piece of text replaced by another.
inline std::string wedge_drop_with(const std::string& from, const std::string& to) {
  return replaced(wedge_drop, from, to);
}

/// What `read` is refused with; none: it is not.
template <class Read>
std::vector<std::string> refusal_of(Read read) {
  try {
    read();
  } catch (const SceneError& error) {
    return error.messages();
  }
  return {};
}

inline std::vector<std::string> messages_of(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  return refusal_of([&] { read_scene_text(scene, "scene.toml", overrides); });
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

/// The first message tells the mistake, in one line. `file`: as messages name it.
inline void expect_told(const std::vector<std::string>& messages, const std::string& file, const Mistake& mistake) {
  ASSERT_FALSE(messages.empty()) << "was accepted";
  const auto& message = messages[0];
  const auto start = file + ":" + std::to_string(mistake.line) + ": " + mistake.key;
  EXPECT_TRUE(message.starts_with(start)) << message << "\nshould start with " << start;
  EXPECT_NE(message.find(mistake.rule), std::string::npos) << message << "\nshould contain " << mistake.rule;
  EXPECT_TRUE(std::string(".?'").find(message.back()) != std::string::npos) << "no cure: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

/// A scene with one mistake is refused with this message alone.
inline void expect_refused(const std::string& scene, const Mistake& mistake) {
  const auto messages = messages_of(scene);
  EXPECT_EQ(messages.size(), 1u) << ::testing::PrintToString(messages);
  expect_told(messages, "scene.toml", mistake);
}

}  // namespace splashdown::apps::testing
