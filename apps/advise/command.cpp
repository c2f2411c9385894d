#include "apps/advise/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/advise/advise.hpp"
#include "apps/process/exit.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/text/number_text.hpp"
#include "apps/text/plain_text.hpp"
#include "apps/text/shell_word.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string number_text(const AdviceNumber& number) {
  if (number.unit == "-") return fmt::format("{} = {:.3g}", number.name, number.value);
  return fmt::format(
      "{} = {}", number.name,
      number.unit == "deg" ? fmt::format("{:.3g} deg", number.value) : with_unit(number.value, number.unit));
}

std::string numbers_text(const std::vector<AdviceNumber>& numbers) {
  std::string text;
  for (const auto& number : numbers) text += (text.empty() ? "" : "; ") + number_text(number);
  return text;
}

/// One digit, since an estimate has no more.
std::string change_text(const std::optional<double>& change) {
  if (!change) return "-";
  const double percent = 100 * std::abs(*change);
  if (percent < 0.1) return "< 0.1 %";
  const double digit = std::pow(10., std::floor(std::log10(percent)));
  return fmt::format("{:g} %", std::round(percent / digit) * digit);
}

void print_effect(const AdvisedEffect& effect) {
  const auto& advice = effect.advice;
  const char* const has = !effect.available ? "-" : effect.present ? "yes" : "no";
  fmt::print("  {:<16} {:<5} {:<9} {:>9} {:>9}  {}\n", effect.name, has, word(advice.advised),
             change_text(advice.change.peak), change_text(advice.change.motion), numbers_text(advice.numbers));
  fmt::print("    {}{}\n", advice.reason, advice.source.empty() ? "" : fmt::format(" [{}]", advice.source));
  if (advice.set.empty() || advice.advised == Advised::off) return;
  std::string words;
  for (const auto& argument : advice.set) words += " --set " + shell_word(argument);
  fmt::print("    add it with{}\n", words);
}

void print_advice(const SceneAdvice& advice) {
  fmt::print("  numbers   {}\n", numbers_text(advice.numbers));
  if (!advice.entry.empty()) fmt::print("  entry     {}\n", advice.entry);
  fmt::print("\n  {:<16} {:<5} {:<9} {:>9} {:>9}  {}\n", "effect", "there", "advice", "peak load", "motion", "numbers");
  for (const auto& effect : advice.effects) print_effect(effect);
}

Json json_of(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json json_of(const std::vector<AdviceNumber>& numbers) {
  Json list = Json::array();
  for (const auto& number : numbers)
    list.push_back({{"name", number.name}, {"value", json_of(std::optional(number.value))}, {"unit", number.unit}});
  return list;
}

Json json_of(const AdvisedEffect& effect) {
  const auto& advice = effect.advice;
  return {{"name", effect.name},
          {"available", effect.available},
          {"present", effect.present},
          {"advice", word(advice.advised)},
          {"change", {{"peak_load", json_of(advice.change.peak)}, {"motion", json_of(advice.change.motion)}}},
          {"numbers", json_of(advice.numbers)},
          {"reason", advice.reason},
          {"source", advice.source},
          {"set", advice.set}};
}

void print_json(const std::string& scene, const std::string& title, const SceneAdvice& advice) {
  Json root = {{"scene", scene}, {"title", title}, {"numbers", json_of(advice.numbers)}, {"entry", advice.entry}};
  root["effects"] = Json::array();
  for (const auto& effect : advice.effects) root["effects"].push_back(json_of(effect));
  fmt::print("{}\n", root.dump(2, ' ', false, Json::error_handler_t::replace));
}

/// Effects whose advice the scene does not follow.
std::string next_text(const SceneAdvice& advice) {
  std::string add, leave;
  for (const auto& effect : advice.effects) {
    if (!effect.available) continue;
    if (effect.present && effect.advice.advised == Advised::off) leave += (leave.empty() ? "" : ", ") + effect.name;
    if (!effect.present && effect.advice.advised == Advised::on) add += (add.empty() ? "" : ", ") + effect.name;
  }
  std::string text;
  if (!add.empty()) text += fmt::format("advised and absent: {}. ", add);
  if (!leave.empty()) text += fmt::format("present and not advised: {}. ", leave);
  return text;
}

}  // namespace

int advise_command(const AdviseOptions& options) {
  try {
    const auto file = read_scene(options.scene, options.set);
    const auto advice = advice_of(file.scene);
    if (options.json) {
      print_json(options.scene.string(), file.scene.title, advice);
      return exit_code::done;
    }
    fmt::print("{}: {}\n", options.scene.string(),
               file.scene.title.empty() ? "(no title)" : one_line(file.scene.title));
    print_advice(advice);
    fmt::print(
        "\nEstimates are right within a factor of three; - under `there`: no scene can have it yet.\n{}What they do is "
        "measured by: splashdown ablate {}\n",
        next_text(advice), options.scene.string());
    return exit_code::done;
  } catch (const SceneError& error) {
    return bad_input(error.what());
  } catch (const std::exception& error) {
    return bad_input(fmt::format("{}: {}", options.scene.string(), error.what()));
  }
}

}  // namespace splashdown::apps
