#include "apps/price/advice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/price/command.hpp"
#include "apps/scene/choose/refine.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/statistics/verdict/share.hpp"
#include "apps/text/shell_word.hpp"

namespace splashdown::apps {
namespace {

std::string command_of(const AccuracyWanted& wanted, const std::vector<std::string>& set,
                       const std::filesystem::path& folder) {
  auto text = fmt::format("splashdown price {}", shell_word(wanted.scene.string()));
  for (const auto& word : set) text += " --set " + shell_word(word);
  text += fmt::format(" --accuracy {:g}%", 100 * wanted.accuracy);
  return folder.empty() ? text : text + " --out " + shell_word(folder.string());
}

/// Finer meshes that a ladder about `own` has beyond those made.
bool goes_on(const Price& price, const AccuracyWanted& wanted, double own) {
  const auto all = rung_refines(most_rungs, own);
  return std::ranges::any_of(all, [&](double refine) {
    return refine > price.finest() && scene_at(wanted.scene, wanted.set, refine).has_value();
  });
}

}  // namespace

const PricedQuantity* scatters_too_much(const Price& price, double accuracy) {
  const auto found = std::ranges::find_if(price.quantities, [&](const PricedQuantity& quantity) {
    if (!quantity.what.counts || !quantity.scatter) return false;
    const auto differs = ratio_of(2 * *quantity.scatter, quantity.value);
    return differs && *differs > accuracy;
  });
  return found == price.quantities.end() ? nullptr : &*found;
}

std::string advice_for(const Price& price, const AccuracyWanted& wanted) {
  const double own = refine_of(read_scene(wanted.scene, wanted.set).scene);
  if (wanted.folder.empty() || goes_on(price, wanted, own)) {
    const auto command = command_of(wanted, wanted.set, wanted.folder);
    const auto* quantity = scatters_too_much(price, wanted.accuracy);
    if (quantity == nullptr) return command + " goes on with finer meshes";
    return fmt::format("meshes of equal size differ by {} in {}. {} makes several runs and takes their mean",
                       share_text(ratio_of(*quantity->scatter, quantity->value)), quantity->what.name, command);
  }
  const double finer = 2 * own;
  auto set = wanted.set;
  for (const auto& key : refine_keys_of(wanted.scene, wanted.set)) {
    std::erase_if(set, [&](const std::string& word) { return word.starts_with(key + "="); });
    set.push_back(fmt::format("{}={:.3g}", key, finer));
  }
  if (!scene_at(wanted.scene, set, 2 * price.finest()))
    return "the scene allows no finer mesh: ask for less, or name what matters with --quantity";
  const auto folder = wanted.folder.string() + "_finer";
  return fmt::format(
      "the ladder is complete. {} builds one that begins twice as fine; then splashdown run {} --price {}",
      command_of(wanted, set, folder), shell_word(wanted.scene.string()), shell_word(folder));
}

}  // namespace splashdown::apps
