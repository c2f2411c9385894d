#include "apps/report/look/scripts.hpp"

#include <fstream>
#include <iterator>

namespace splashdown::apps {
namespace {

/// Every `of` in a text replaced.
std::string substituted(std::string text, const std::string& of, const std::string& instead) {
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + instead.size()))
    text.replace(at, of.size(), instead);
  return text;
}

}  // namespace

std::string library_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string script_element(const std::string& script) {
  return "<script>" + substituted(script, "</script", "<\\/script") + "</script>\n";
}

std::string json_in_script(const std::string& json) { return substituted(json, "<", "\\u003c"); }

}  // namespace splashdown::apps
