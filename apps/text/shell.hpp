// Commands as a POSIX shell takes them.
#pragma once

#include <string>
#include <vector>

namespace splashdown::apps {

/// A word between single quotes: the shell takes it as it is.
std::string shell_word(const std::string& word);
/// Such words with spaces between them.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace splashdown::apps
