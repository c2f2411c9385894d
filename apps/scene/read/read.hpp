// scene.toml and --set arguments to a checked Scene.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <span>
#include <string>

#include "apps/scene/rules/problems.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

class Sketch;

struct SceneFile {
  Scene scene;
  std::vector<std::string> notes;   ///< what was understood otherwise than it was written
  std::vector<std::string> chosen;  ///< sizes that the scene left open, and why these: a line each
  std::string resolved;             ///< TOML with every value in force; reads to the same scene
  Problems places{""};              ///< where each key stands: for what is found wrong after reading
};

/// Words of a dotted key, at most: parsers and tables of TOML go one call deeper with each.
inline constexpr int most_key_words = 16;

/// What a file holds. Throws SceneError; `example` is named as a cure.
std::string read_text(const std::filesystem::path& file, const std::string& example);
/// Throws SceneError with place and reason if the text is not TOML.
toml::table read_toml(const std::string& text, const std::string& name);

/// `overrides`: texts `key.path=value`. Throws SceneError with every problem found.
SceneFile read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});
/// The same from text; `name` stands for the file in messages, and its folder is where names of files begin.
SceneFile read_scene_text(const std::string& text, const std::string& name,
                          std::span<const std::string> overrides = {});

/// What the reader of scenes of this dimension asks for.
void sketch_scene(Sketch& sketch, int dimension);

}  // namespace splashdown::apps
