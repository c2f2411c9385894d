// Scripts that stand in a page: those of libraries that are on this machine, and the page's own.
#pragma once

#include <filesystem>
#include <string>

namespace splashdown::apps {

/// The text of a library's file, e.g. of Debian's libjs packages (classic scripts: a page that is opened from disk may not hold
/// modules); nothing if it is not there.
std::string library_text(const std::filesystem::path& path);

/// A <script> element. A text "</script" in it does not end it.
std::string script_element(const std::string& script);

/// JSON in such an element: texts in it begin no other.
std::string json_in_script(const std::string& json);

}  // namespace splashdown::apps
