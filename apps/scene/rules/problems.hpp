// What is wrong with a scene, each message with its place, key, value, rule and cure.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace splashdown::apps {

/// Thrown once, with everything that was found.
class SceneError : public std::runtime_error {
 public:
  explicit SceneError(std::vector<std::string> messages);
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

/// Where a key stands: a line of the file, or a --set argument (line 0).
struct Place {
  std::string source;
  long line = 0;
};

/// Collects problems while a scene is read. Keys are dotted paths such as `body.wedge.mass`.
class Problems {
 public:
  explicit Problems(std::string file) : file_(std::move(file)) {}

  /// Remembers where a key stands and what it says, for problems that are found later. A place without a source: the program
  /// has chosen the value.
  void note(const std::string& key, Place place, std::string value);
  /// That the value in force is another one than the key says: messages tell it, and what made it.
  void note_in_force(const std::string& key, double value, double divisor);
  bool noted(const std::string& key) const { return notes_.contains(key); }

  /// `key = value: rule. cure`, at the key's place or at that of the nearest table around it.
  void add(const std::string& key, const std::string& rule, const std::string& cure);
  void add_missing(const std::string& key, const std::string& meaning, const std::string& cure);
  /// `elsewhere`: where the key exists; empty: nowhere.
  void add_unknown(const std::string& key, const std::vector<std::string>& valid, const std::string& elsewhere = {});
  /// A problem of the file as a whole, or of one of its lines.
  void add_at(const Place& place, const std::string& message);

  bool empty() const { return problems_.empty(); }
  /// Something is wrong with this key or with one below it, so its value means nothing.
  bool found_in(const std::string& key) const;
  /// In the order of the file, then those of --set arguments.
  std::vector<std::string> messages() const;
  void throw_if_any() const;

 private:
  struct Note {
    Place place;
    std::string value;
    std::string in_force = {};  ///< the value in force and what made it
  };
  struct Problem {
    std::string key;
    Place place;
    std::string text;
  };
  Place place_of(std::string key) const;

  std::string file_;
  std::map<std::string, Note> notes_;
  std::vector<Problem> problems_;
};

/// What divides sizes and times of the mesh: a key of the scene, and what --refine and --accuracy set.
inline constexpr const char* refine_key = "fluid.size.refine";

/// The valid word with the fewest edits away, or empty if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& valid);
/// 'a', 'b' or 'c'
std::string listing(const std::vector<std::string>& words);

}  // namespace splashdown::apps
