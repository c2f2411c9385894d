// The folders of a study: names that are one safe component, and a mark in each that the study made. Nothing without the
// mark is ever removed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/study/study.hpp"

namespace splashdown::apps {

/// A folder's name of any text: letters, digits and . - + _ with neither a dot nor a dash in front, never empty, of a
/// length that every file system takes, and none of a study's own files.
std::string safe_component(const std::string& text);

/// What stands in the way of a study in this folder: files and folders that are not its own and that it would write over.
/// Each a message for users.
std::vector<std::string> foreign_places(const std::vector<StudyRun>& runs, const std::filesystem::path& folder);

/// Makes the study's folder and marks it.
void make_study_folder(const std::filesystem::path& folder);

/// Empties a run's folder of what another scene left there, and marks it. Finished and half-done runs stay. Throws
/// std::runtime_error rather than remove what bears no mark.
void prepare(const StudyRun& run, const std::filesystem::path& folder);

}  // namespace splashdown::apps
