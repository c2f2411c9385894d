// JSON Schema (draft 2020-12) of scenes and studies, made of what their readers ask for: editors complete keys, tell what they
// mean and mark mistakes while a file is written.
//
// A schema is weaker than `splashdown check`: it knows keys, types, words and ranges, not what one value means to another.
#pragma once

#include <string>

namespace splashdown::apps {

std::string scene_schema();
std::string study_schema();

}  // namespace splashdown::apps
