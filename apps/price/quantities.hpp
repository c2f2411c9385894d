// What a price is asked for: by default the loads, speeds and depths of a scene's bodies and what its records measure.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/scene/scene.hpp"
#include "apps/study/study.hpp"

namespace splashdown::apps {

struct PriceQuantity {
  std::string name;
  std::string unit = "-";
  /// Rows of the price list wait for it. Peaks of single steps are shown and not waited for: they need not converge.
  bool counts = true;
  bool asked = false;      ///< by the user, who is told if it has no value
  std::string path;        ///< of a number in summary.json; empty: `expression`
  StudyQuantity measured;  ///< its expression
  /// A number of summary.json below whose least the mesh is too coarse for a value; empty: there is none.
  std::string resolution = {};
  double least_resolution = 0;
  /// Of its error in summary.json, which a mesh knows by itself (core/goals/goal.hpp); empty: it does not.
  std::string told = {};
};

std::vector<PriceQuantity> default_quantities(const Scene& scene);

/// NAME=EXPRESSION [from TABLE] [where CONDITION]. Throws SceneError: rule and cure.
PriceQuantity parsed_quantity(const std::string& argument);

/// Throws SceneError for names that no run of this scene will have, and for names given twice.
void check_price_quantities(const std::vector<PriceQuantity>& quantities, const Scene& scene);

/// Of every step if every step was recorded, else by the mean of the rows.
double node_steps_in(const std::filesystem::path& folder);

/// The error that the run tells of itself; nan: none.
double told_error_in(const std::filesystem::path& folder, const PriceQuantity& quantity);

/// In the folder of a run that is done; nan where it has none, then `why` says it.
double value_in(const std::filesystem::path& folder, const PriceQuantity& quantity, std::string& why);

}  // namespace splashdown::apps
