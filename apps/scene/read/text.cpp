#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>

#include "apps/scene/read/read.hpp"
#include "apps/text/pattern.hpp"

namespace splashdown::apps {
namespace {

/// Lines and lengths of dotted keys in TOML, as far as strings and comments have to be known for them.
class KeyScan {
 public:
  explicit KeyScan(std::string_view text) : text_(text) {}

  /// The line of a key with more than `most` words; 0: there is none.
  long longer_than(int most) {
    int dots = 0;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skip_string(c);
        continue;
      }
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      if (c == '\n') ++line_;
      if (c == '.')
        ++dots;
      else if (std::string_view("\n=[]{},").find(c) != std::string_view::npos)
        dots = 0;
      if (dots >= most) return line_;
      ++at_;
    }
    return 0;
  }

 private:
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool many_lines = text_.substr(at_, 3) == three;
    at_ += many_lines ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') {
        ++line_;
        if (!many_lines) return;  // unfinished: the parser will say so
      }
      if (quote == '"' && text_[at_] == '\\') {
        ++at_;
      } else if (many_lines ? text_.substr(at_, 3) == three : text_[at_] == quote) {
        at_ += many_lines ? 3 : 1;
        return;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  long line_ = 1;
};

/// "1,5" where it stands alone behind an equals sign; nothing if the line has no such number.
std::string decimal_comma(const std::string& text, long line) {
  std::istringstream lines(text);
  std::string wanted;
  for (long i = 0; i < line && std::getline(lines, wanted); ++i) {
  }
  constexpr std::size_t longest = 1000;  // of a line that a person typed
  static const Pattern number("=[[:space:]]*([-+]?[0-9]+,[0-9]+)[[:space:]]*(#.*)?$");
  return wanted.size() < longest ? number.in<1>(wanted)[0] : std::string();
}

}  // namespace

toml::table read_toml(const std::string& text, const std::string& name) {
  // What is nested deeper than this overflows the stack of the parser, which bounds brackets only.
  if (const long line = KeyScan(text).longer_than(most_key_words))
    throw SceneError(
        {fmt::format("{}:{}: a key has more than {} words between dots. The longest keys of scenes and "
                     "studies have four, e.g. body.wedge.shape.breadth.",
                     name, line, most_key_words)});
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const auto& place = error.source().begin;
    if (const auto comma = decimal_comma(text, static_cast<long>(place.line)); !comma.empty()) {
      auto point = comma;
      std::ranges::replace(point, ',', '.');
      throw SceneError({fmt::format("{}:{}: not TOML: {} has a comma. Numbers have a point: did you mean {}?", name,
                                    place.line, comma, point)});
    }
    throw SceneError({fmt::format("{}:{}: not TOML: {} (column {}). See https://toml.io for the syntax.", name,
                                  place.line, error.description(), place.column)});
  }
}

std::string read_text(const std::filesystem::path& path, const std::string& example) {
  namespace fs = std::filesystem;
  const auto refuse = [&](const std::string& why) -> SceneError {
    return SceneError({fmt::format("{}: cannot be read: {}. Name {}.", path.string(), why, example)});
  };
  std::error_code unknown;  // what cannot be asked for cannot be opened either
  const auto kind = fs::status(path, unknown).type();
  if (kind == fs::file_type::directory) throw refuse("it is a folder");
  if (kind == fs::file_type::character || kind == fs::file_type::block) throw refuse("it is a device");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw refuse(std::strerror(errno));
  constexpr std::size_t most = 16'000'000;  // a hundred times the longest outline that is read
  std::string text;
  std::array<char, 65536> piece;
  while (text.size() <= most && (stream.read(piece.data(), piece.size()) || stream.gcount() > 0))
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
  if (text.size() > most) throw refuse(fmt::format("it has more than {} MB", most / 1'000'000));
  return text;
}

}  // namespace splashdown::apps
