// Colours of the pages, for light screens and dark ones.
//
// A page names its colours by CSS variables. Pictures are drawn for light ground; on a page their colours become variables too.
#pragma once

#include <string>
#include <string_view>

namespace splashdown::apps {

/// Style rules that define the variables; prints are light.
std::string theme_style();

/// The variable of a colour "#rrggbb" of pictures, "--c-red"; nothing if it is one for both grounds.
std::string_view colour_variable(std::string_view colour);

/// An <svg> element with variables in place of such colours. What stands in an <svg> within it stays as it is.
std::string themed(const std::string& svg);

}  // namespace splashdown::apps
