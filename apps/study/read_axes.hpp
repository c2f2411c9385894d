// Reads the axes of a study. For read.cpp alone.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/read/reader.hpp"
#include "apps/study/study.hpp"

namespace splashdown::apps {

inline constexpr const char* set_texts_cure = "Write --set texts, e.g. set = [\"time.end=0.1\"].";

/// Names of columns and constants, each of which may stand once.
class Columns {
 public:
  explicit Columns(Problems& problems);
  /// The name that the reader's table has; a problem if it is none, or taken.
  void take(const Reader& reader, const std::string& name);

 private:
  Problems& problems_;
  std::vector<std::string> taken_;
};

/// All [[axis]]; random ones are drawn together.
void read_axes(Reader& root, Study& study, Columns& columns);

}  // namespace splashdown::apps
