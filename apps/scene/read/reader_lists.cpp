// Values that are lists: words, numbers, times, points, matrices.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "apps/scene/read/reader.hpp"

namespace splashdown::apps {
namespace {

// Elements cannot follow more, and every point is held against others.
constexpr std::size_t most_points = 10'000;

}  // namespace

void Reader::texts(std::string_view name, Names& target, const std::string& cure, Need need) {
  note(name, {.type = Wanted::Type::texts, .hint = cure}, need);
  if (const auto* node = find(name, need, "a list of strings", cure)) {
    const auto* array = node->as_array();
    if (array && std::all_of(array->begin(), array->end(), [](const auto& n) { return n.is_string(); }))
      for (const auto& element : *array) target.push_back(*element.template value<std::string>());
    else
      context_->problems.add(key(name), "must be a list of strings", cure);
  }
  context_->echo.add(section_, name, toml_list(target));
}

void Reader::numbers(std::string_view name, std::vector<double>& target, const Rule& rule) {
  note(name, {.type = Wanted::Type::list, .rule = rule});
  if (const auto* node = find(name, Need::optional, {}, {}))
    target = list_of(*node, key(name), 0, rule).value_or(target);
  if (!target.empty()) context_->echo.add(section_, name, toml_list(target));
}

/// A time that was given with --set itself is left to the rules.
bool Reader::clipped(std::string_view name, double& time) {
  if (!context_->clip_to || time <= *context_->clip_to || place(name).line == 0) return false;
  context_->notes.push_back(fmt::format("{}: {:g} s lies after time.end = {:g} s of --set: taken at the end", key(name),
                                        time, *context_->clip_to));
  time = *context_->clip_to;
  return true;
}

void Reader::times(std::string_view name, std::vector<double>& target, const Rule& rule) {
  note(name, {.type = Wanted::Type::list, .rule = rule});
  if (const auto* node = find(name, Need::optional, {}, {})) {
    target = list_of(*node, key(name), 0, rule).value_or(target);
    for (double& time : target) clipped(name, time);
    const auto once = std::unique(target.begin(), target.end());  // those that were brought to the end
    if (context_->clip_to) target.erase(once, target.end());
  }
  if (!target.empty()) context_->echo.add(section_, name, toml_list(target));
}

void Reader::interval(std::string_view name, double& target, const Rule& rule) {
  note(name, {.type = Wanted::Type::number, .rule = rule});
  if (const auto* node = find(name, Need::optional, {}, {})) {
    target = number_of(*node, key(name), rule).value_or(target);
    clipped(name, target);
  }
  echo(name, target);
}

void Reader::point(std::string_view name, Point& target, const Rule& rule, Need need) {
  note(name, {.type = Wanted::Type::list, .rule = rule, .length = static_cast<std::size_t>(context_->dimension)}, need);
  const auto meaning = fmt::format("a list of {} numbers{}", context_->dimension, rule.in_unit());
  if (const auto* node = find(name, need, meaning, rule.cure))
    target = point_of(*node, key(name), rule).value_or(target);
  context_->echo.add(section_, name, echo_of(target));
}

void Reader::point(std::string_view name, std::optional<Point>& target, const Rule& rule) {
  note(name, {.type = Wanted::Type::list, .rule = rule, .length = static_cast<std::size_t>(context_->dimension)});
  if (const auto* node = find(name, Need::optional, {}, {})) target = point_of(*node, key(name), rule);
  if (target) context_->echo.add(section_, name, echo_of(*target));
}

void Reader::rows(std::string_view name, std::vector<std::vector<double>>& target, std::size_t columns,
                  const Rule& rule, Need need) {
  note(name, {.type = Wanted::Type::rows, .rule = rule, .length = columns}, need);
  const auto meaning = fmt::format("a list of lists of {} numbers{}", columns, rule.in_unit());
  if (const auto* node = find(name, need, meaning, rule.cure)) {
    if (const auto* array = node->as_array(); array && array->size() > most_points) {
      context_->problems.add(key(name), fmt::format("must have {} rows at most, not {}", most_points, array->size()),
                             "Leave out points that are nearer to each other than an element.");
    } else if (array) {
      for (const auto& element : *array) {
        auto row = list_of(element, key(name), columns, rule);
        if (!row) return;
        target.push_back(std::move(*row));
      }
    } else {
      wrong_type(key(name), meaning, *node, rule.cure);
    }
  }
  std::string text;
  for (const auto& row : target) text += (text.empty() ? "" : ", ") + toml_list(row);
  if (!target.empty()) context_->echo.add(section_, name, "[" + text + "]");
}

void Reader::curve(std::string_view name, std::vector<std::vector<double>>& target, std::size_t columns,
                   const Rule& rule) {
  const auto* node = table_->get(name);
  if (!visit_ && !node) return skip(name);
  const auto* list = node ? node->as_array() : nullptr;
  const bool is_table = list && !list->empty() && list->front().is_array();
  if (visit_ || is_table) {
    rows(name, target, columns, rule);
    for (std::size_t i = 1; i < target.size(); ++i)
      if (!(target[i][0] > target[i - 1][0]))
        return context_->problems.add(
            key(name),
            fmt::format("rows must ascend: row {} has {:g} after {:g}", i + 1, target[i][0], target[i - 1][0]),
            "Sort the rows.");
    if (is_table) return;
  }
  std::vector<double> constant(columns - 1);
  if (columns == 2)
    number(name, constant[0], rule);
  else {
    note(name, {.type = Wanted::Type::list, .rule = rule, .length = columns - 1});
    if (const auto* found = find(name, Need::optional, {}, {}))
      constant = list_of(*found, key(name), columns - 1, rule).value_or(constant);
    context_->echo.add(section_, name, toml_list(constant));
  }
  constant.insert(constant.begin(), 0.0);
  target = {constant};
}

void Reader::points(std::string_view name, std::vector<Point>& target, const Rule& rule) {
  std::vector<std::vector<double>> list;
  rows(name, list, static_cast<std::size_t>(context_->dimension), rule, Need::required);
  for (const auto& row : list) {
    Point point = Point::Zero();
    for (std::size_t i = 0; i < row.size(); ++i) point[static_cast<Eigen::Index>(i)] = row[i];
    target.push_back(point);
  }
}

void Reader::rotation(std::string_view name, Point& target, const Rule& rule) {
  if (context_->dimension == 2) return number(name, target.z(), rule);
  point(name, target, rule);
}

void Reader::inertia(std::string_view name, std::optional<Eigen::Matrix3d>& target, const Rule& rule) {
  if (!holds(name)) return skip(name);
  target = Eigen::Matrix3d::Zero();
  if (context_->dimension == 2) return number(name, (*target)(2, 2), rule);
  Rule entry = rule;  // beside the diagonal any sign is good
  entry.low = -std::numeric_limits<double>::infinity();
  if (visit_) matrix(name, *target, entry);
  const auto* list = table_->get(name) ? table_->get(name)->as_array() : nullptr;
  if (list && !list->empty() && list->front().is_array()) return matrix(name, *target, entry);
  Point diagonal = target->diagonal();
  point(name, diagonal, rule);
  target->diagonal() = diagonal;
}

void Reader::matrix(std::string_view name, Eigen::Matrix3d& target, const Rule& rule) {
  const auto d = static_cast<std::size_t>(context_->dimension);
  std::vector<std::vector<double>> list;
  rows(name, list, d, rule);
  if (list.empty()) return;
  if (list.size() != d) {
    context_->problems.add(key(name), fmt::format("must have {} rows, not {}", d, list.size()), rule.cure);
    return;
  }
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j < d; ++j) target(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = list[i][j];
}

}  // namespace splashdown::apps
