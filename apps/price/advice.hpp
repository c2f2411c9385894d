// What to do for an accuracy that no mesh has yet: a command that goes on from here, or why none does.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/price/price.hpp"

namespace splashdown::apps {

struct AccuracyWanted {
  std::filesystem::path scene;
  std::vector<std::string> set;
  double accuracy = 0;           ///< relative
  std::filesystem::path folder;  ///< of the price list; empty: there is none
};

/// Throws SceneError for a scene that cannot be read.
///   meshes of equal size differ by more     splashdown price --accuracy, which takes the mean of several runs
///   no list, or meshes left on its ladder   splashdown price --accuracy
///   the ladder is complete                  one that begins twice as fine, in a folder of its own
std::string advice_for(const Price& price, const AccuracyWanted& wanted);

/// The quantity that scatters by more than an accuracy between meshes of equal size, if it is the one that decides; null: none.
const PricedQuantity* scatters_too_much(const Price& price, double accuracy);

}  // namespace splashdown::apps
