// The tables of effects that a scene holds: present or absent, known by their type.
#pragma once

#include <any>
#include <map>
#include <typeindex>
#include <utility>

namespace splashdown::apps {

/// One table of each type at most, by value: copies of a scene are independent. Who owns a type (apps/effects) reads, checks and
/// builds it; nobody else names it.
class Effects {
 public:
  /// The table, or null: the effect is absent.
  template <class Table>
  const Table* find() const {
    const auto found = tables_.find(typeid(Table));
    return found == tables_.end() ? nullptr : std::any_cast<Table>(&found->second);
  }
  /// The table, made with its defaults where it was absent.
  template <class Table>
  Table& table() {
    return *std::any_cast<Table>(&tables_.try_emplace(typeid(Table), Table{}).first->second);
  }
  template <class Table>
  void remove() {
    tables_.erase(typeid(Table));
  }
  bool empty() const { return tables_.empty(); }

 private:
  std::map<std::type_index, std::any> tables_;
};

}  // namespace splashdown::apps
