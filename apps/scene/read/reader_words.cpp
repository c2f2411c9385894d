// Words, and names of files.
#include <fmt/format.h>

#include <algorithm>

#include "apps/scene/read/dimensions.hpp"
#include "apps/scene/read/reader.hpp"

namespace splashdown::apps {

void Reader::text(std::string_view name, std::string& target, const std::string& cure, Need need) {
  note(name, {.type = Wanted::Type::text, .hint = cure}, need);
  if (const auto* node = find(name, need, "a string", cure)) {
    if (node->is_string())
      target = *node->value<std::string>();
    else
      wrong_type(key(name), "a string", *node, cure);
  }
  echo(name, target);
}

void Reader::file(std::string_view name, std::string& target, const std::string& cure) {
  note(name, {.type = Wanted::Type::text, .hint = cure}, Need::required);
  if (const auto* node = find(name, Need::required, "the name of a file", cure)) {
    if (node->is_string())
      target = std::filesystem::absolute(context_->folder / *node->value<std::string>()).lexically_normal().string();
    else
      wrong_type(key(name), "a string", *node, cure);
  }
  echo(name, target);
}

bool Reader::choice(std::string_view name, std::string& target, const Names& valid, Need need) {
  if (visit_) {
    note(name, {.type = Wanted::Type::word, .words = valid}, need);
    const auto found = std::find(valid.begin(), valid.end(), target);
    const std::size_t usual = found == valid.end() ? 0 : static_cast<std::size_t>(found - valid.begin());
    const auto picked = context_->sketch->decide("word " + header_of(name), valid.size(), usual);
    visit_->usual[std::string(name)] = need == Need::optional && picked == usual;
    visit_->picked[std::string(name)] = target = valid[picked];
    return true;
  }
  const auto cure = "Use " + listing(valid) + ".";
  const auto* node = find(name, need, "one of " + listing(valid), cure);
  bool good = need == Need::optional;
  if (node) {
    const auto word = node->value<std::string>();
    good = node->is_string() && std::find(valid.begin(), valid.end(), *word) != valid.end();
    const auto near = node->is_string() ? nearest(*word, valid) : std::string();
    if (good)
      target = *word;
    else if (!node->is_string())
      wrong_type(key(name), "a string", *node, cure);
    else
      context_->problems.add(key(name), "must be " + listing(valid), cure_of_word(name, *word, near, cure));
  }
  echo(name, target);
  return good;
}

std::string Reader::cure_of_word(std::string_view name, const std::string& word, const std::string& near,
                                 const std::string& cure) const {
  if (const auto where = word_elsewhere(context_->dimension, header_, name, word); !where.empty())
    return fmt::format("'{}' exists {}. {}", word, where, cure);
  return near.empty() ? cure : "Did you mean '" + near + "'?";
}

void Reader::choices(std::string_view name, Names& target, const Names& valid) {
  note(name, {.type = Wanted::Type::words, .words = valid});
  const auto cure = "Use a list of " + listing(valid) + ".";
  if (const auto* node = find(name, Need::optional, {}, {})) {
    Names words;
    bool good = node->is_array();
    if (good)
      for (const auto& element : *node->as_array()) {
        const auto word = element.value<std::string>();
        good = good && word && std::find(valid.begin(), valid.end(), *word) != valid.end() &&
               std::find(words.begin(), words.end(), *word) == words.end();
        if (word) words.push_back(*word);
      }
    if (good)
      target = words;
    else
      context_->problems.add(key(name), "must be a list of " + listing(valid) + ", each once",
                             cure_of_words(name, words, cure));
  }
  context_->echo.add(section_, name, toml_list(target));
}

std::string Reader::cure_of_words(std::string_view name, const Names& words, const std::string& cure) const {
  for (const auto& word : words)
    if (const auto where = word_elsewhere(context_->dimension, header_, name, word); !where.empty())
      return fmt::format("'{}' exists {}. {}", word, where, cure);
  return cure;
}

bool Reader::reference(std::string_view name, std::string& target, const Names& valid, Need need) {
  if (!visit_) return choice(name, target, valid, need);
  note(name, {.type = Wanted::Type::text}, need);
  return false;
}

void Reader::references(std::string_view name, Names& target, const Names& valid) {
  if (!visit_) return choices(name, target, valid);
  note(name, {.type = Wanted::Type::texts});
}

}  // namespace splashdown::apps
