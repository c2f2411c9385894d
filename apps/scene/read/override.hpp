// --set key.path=value: changes one value of a scene's TOML before it is read.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "apps/scene/rules/problems.hpp"

namespace splashdown::apps {

/// What the user wrote, and what it sets. Options of their own are given as "--refine 2: fluid.size.refine=2".
struct Override {
  std::string source, argument;  ///< of messages; key.path=value
};
Override override_of(const std::string& given);

/// Elements of arrays of tables are chosen by name or by index, entries of lists by index, both from 0: body.wedge.mass,
/// body.0.mass, body.wedge.velocity.1. Tables that are absent are created, so an effect can be added; an empty value
/// removes a key, a table or an element of an array of tables, whose later elements move up. The value is TOML; a bare
/// word is a string. An argument that another option than --set stands for begins with it, "--refine 2: fluid.size.refine=2":
/// messages name it by that.
void apply_override(toml::table& root, const std::string& argument, Problems& problems);

}  // namespace splashdown::apps
