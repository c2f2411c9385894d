// How the program ends: its exit codes, and what it says of errors.
#pragma once

#include <exception>
#include <string>

namespace splashdown::apps {

namespace exit_code {
inline constexpr int done = 0;
inline constexpr int bad_input = 2;      ///< command line or scene; nothing was run or written
inline constexpr int cannot_go_on = 3;   ///< the last good state is saved
inline constexpr int interrupted = 130;  ///< by a signal or a spent budget; a checkpoint is saved
}  // namespace exit_code

/// What an exception says, in the words of this program: those of the file system name path, reason and cure.
std::string trouble(const std::exception& error);

/// `error: ` and the text on the standard error stream; returns exit_code::bad_input.
int bad_input(const std::string& text);

}  // namespace splashdown::apps
