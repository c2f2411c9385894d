// Reads one table of a scene, key by key, into plain values.
//
// A key that is absent leaves its target alone, so a default stands once: as a member initialiser. Every
// key asked for is echoed with the value in force; keys nobody asked for are reported as unknown when the
// reader goes out of scope, so that no early return can skip the report.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/choose/presets.hpp"
#include "apps/scene/read/echo.hpp"
#include "apps/scene/rules/problems.hpp"
#include "apps/scene/rules/rules.hpp"
#include "apps/scene/scene.hpp"
#include "apps/scene/sketch.hpp"

namespace splashdown::apps {

enum class Need { optional, required };

struct ReadContext {
  Problems& problems;
  Echo& echo;
  int dimension = 2;
  std::filesystem::path folder = {};  ///< of the scene file: what relative file names begin at
  Sketch* sketch = nullptr;           ///< set: nothing is read, what is asked for is noted
  /// Where --set ends the run: times of the file that lie after it are brought to it, with a note.
  std::optional<double> clip_to = {};
  std::vector<std::string> notes = {};
};

Place place_of(const toml::node& node);
/// False for whole numbers that doubles cannot hold.
bool is_exact(const toml::node& node);
/// A value as the user wrote it, near enough.
std::string written(const toml::node& node);
/// The same, short enough for a message; nothing for tables.
std::string written_short(const toml::node& node);

class Reader {
 public:
  using Names = std::vector<std::string>;

  /// `path` is the table's dotted name in messages, `header` its name in a TOML header.
  Reader(ReadContext& context, const toml::table& table, std::string path, std::string header, bool in_array = false);
  Reader(Reader&& other) noexcept;
  Reader& operator=(Reader&&) = delete;
  ~Reader();

  std::string key(std::string_view name) const;
  bool holds(std::string_view name) const;
  ReadContext& context() const { return *context_; }
  Place place(std::string_view name) const {
    const auto* node = table_->get(name);
    return node ? place_of(*node) : place_of(*table_);
  }
  /// A key that is valid here but has no part in this scene.
  void skip(std::string_view name);
  /// A key that would mislead beside the others: a problem if it is there.
  void refuse(std::string_view name, const std::string& rule, const std::string& cure);
  /// A key that is neither judged nor recommended.
  void ignore(std::string_view name);
  /// Nothing here can be judged, because the key that decides which keys are valid is wrong.
  void skip_all();
  const std::string& path() const { return path_; }

  void number(std::string_view name, double& target, const Rule& rule, Need need = Need::optional);
  void number(std::string_view name, std::optional<double>& target, const Rule& rule);
  /// What others are divided by, a number or the name of one, 1 if it is absent. Their echo is what came of it, hence its own
  /// is 1.
  double divisor(std::string_view name, const Rule& rule, std::span<const Preset> named);
  void integer(std::string_view name, int& target, const Rule& rule);
  void text(std::string_view name, std::string& target, const std::string& cure, Need need = Need::optional);
  /// The name of a file, made absolute: relative ones begin at the scene's folder.
  void file(std::string_view name, std::string& target, const std::string& cure);
  /// False if what is given (or missing) is not valid.
  bool choice(std::string_view name, std::string& target, const Names& valid, Need need = Need::optional);
  void choices(std::string_view name, Names& target, const Names& valid);
  /// The same for words that the file itself defines elsewhere, such as names of bodies.
  bool reference(std::string_view name, std::string& target, const Names& valid, Need need = Need::optional);
  void references(std::string_view name, Names& target, const Names& valid);
  void numbers(std::string_view name, std::vector<double>& target, const Rule& rule);
  /// The same for times within the run; those that `clip_to` cuts off become it.
  void times(std::string_view name, std::vector<double>& target, const Rule& rule);
  void interval(std::string_view name, double& target, const Rule& rule);
  void point(std::string_view name, Point& target, const Rule& rule, Need need = Need::optional);
  void point(std::string_view name, std::optional<Point>& target, const Rule& rule);
  void points(std::string_view name, std::vector<Point>& target, const Rule& rule);
  /// About an axis: a number in two dimensions (the last entry), as many as axes in three.
  void rotation(std::string_view name, Point& target, const Rule& rule);
  /// Moments of inertia: a number in two dimensions (the last entry), in three the diagonal or a full matrix.
  void inertia(std::string_view name, std::optional<Eigen::Matrix3d>& target, const Rule& rule);
  void matrix(std::string_view name, Eigen::Matrix3d& target, const Rule& rule);
  /// A list of lists, each with `columns` numbers.
  void rows(std::string_view name, std::vector<std::vector<double>>& target, std::size_t columns, const Rule& rule,
            Need need = Need::optional);

  /// What may be a number (of `columns` - 1 values: a list of them) or change over what the first column is: rows with ascending
  /// first entries. A constant becomes one row that begins with 0. Nothing if the key is absent.
  void curve(std::string_view name, std::vector<std::vector<double>>& target, std::size_t columns, const Rule& rule);

  /// A list of strings.
  void texts(std::string_view name, Names& target, const std::string& cure, Need need = Need::optional);
  /// The node itself, for values that only the caller can judge, `wanted` as far as a type can say it; null when absent.
  const toml::node* node(std::string_view name, Need need, const std::string& meaning, const std::string& cure,
                         std::vector<Wanted::Type> wanted = {Wanted::Type::anything});
  /// A table of numbers under names that the user chooses.
  void numbers_by_name(std::string_view name, std::map<std::string, double>& target, const std::string& example);
  /// A key that the user named elsewhere.
  const toml::node* named_node(const std::string& name);

  std::optional<Reader> table(std::string_view name, Need need = Need::optional, std::string cure = {});
  /// The table, or one that is empty, so that its defaults are read and echoed.
  Reader table_or_defaults(std::string_view name);
  /// Each element of an array of tables. Those with a name are called by it: `body.wedge`.
  void each_table(std::string_view name, const std::function<void(Reader&)>& read);

 private:
  /// The node, with its place and value noted; nothing, and a problem if it was needed, when absent.
  const toml::node* find(std::string_view name, Need need, const std::string& meaning, const std::string& cure);
  std::optional<double> number_of(const toml::node& node, const std::string& key, const Rule& rule);
  std::optional<std::vector<double>> list_of(const toml::node& node, const std::string& key, std::size_t length,
                                             const Rule& rule);
  std::optional<Point> point_of(const toml::node& node, const std::string& key, const Rule& rule);
  void wrong_type(const std::string& key, const std::string& wanted, const toml::node& node, const std::string& cure);
  std::string echo_of(const Point& point) const;
  /// For the sketch, if there is one: what the key has to be. What is wanted first counts, further calls add to it.
  void note(std::string_view name, Wanted wanted, Need need = Need::optional);
  template <class Value>
  void echo(std::string_view name, const Value& value) {
    context_->echo.add(section_, name, toml_text(value));
  }
  std::string header_of(std::string_view name) const;
  bool clipped(std::string_view name, double& time);
  /// Of a word that is not valid; `near`: the valid one that resembles it, if any.
  std::string cure_of_word(std::string_view name, const std::string& word, const std::string& near,
                           const std::string& cure) const;
  std::string cure_of_words(std::string_view name, const Names& words, const std::string& cure) const;

  ReadContext* context_;
  const toml::table* table_;  // null: moved from
  std::string path_, header_;
  Echo::Section section_;
  Sketch::Visit* visit_ = nullptr;  // of the sketch, if there is one
  std::set<std::string, std::less<>> known_, ignored_;
};

}  // namespace splashdown::apps
