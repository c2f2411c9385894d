#include "apps/scene/sketch.hpp"

#include <set>

namespace splashdown::apps {

Sketch::Key& Sketch::Visit::at(std::string_view name) {
  const auto found = keys.find(name);
  if (found != keys.end()) return found->second;
  order.emplace_back(name);
  return keys[std::string(name)];
}

Sketch::Visit& Sketch::open(const std::string& header) { return visits_[header].emplace_back(); }

std::size_t Sketch::decide(const std::string& what, std::size_t count, std::size_t usual) {
  met_.emplace(what, Options{count, usual});
  const auto found = decided_.find(what);
  return found == decided_.end() ? usual : found->second;
}

void Sketch::explore(const std::function<void()>& read) {
  std::set<std::string> known;
  std::vector<std::map<std::string, std::size_t>> readings{{}};
  for (std::size_t i = 0; i < readings.size(); ++i) {
    decided_ = readings[i];
    met_.clear();
    read();
    for (const auto& [what, options] : met_) {
      if (!known.insert(what).second) continue;
      for (std::size_t option = 0; option < options.count; ++option) {
        if (option == options.usual) continue;
        auto other = readings[i];  // what led here stays: a decision may exist because of another
        other[what] = option;
        readings.push_back(std::move(other));
      }
    }
  }
}

}  // namespace splashdown::apps
