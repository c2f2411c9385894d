# Writes version_built.hpp at build time; touches it only if it changed. Run as a script (cmake -P) with
# SOURCE, OUTPUT, VERSION and LIBRARIES ("name=number,name=number").
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --exclude * --abbrev=12
  OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(hash unknown)
endif()
string(REPLACE "," ";" pairs "${LIBRARIES}")
set(rows "")
foreach(pair IN LISTS pairs)
  string(REGEX REPLACE "^(.*)=(.*)$" "    {\"\\1\", \"\\2\"},\n" row "${pair}")
  string(APPEND rows "${row}")
endforeach()
file(WRITE ${OUTPUT}.new "#pragma once

#include <string>
#include <utility>

namespace splashdown::apps::built {

inline const std::string version = \"${VERSION}\";
inline const std::string git_hash = \"${hash}\";
inline const std::pair<std::string, std::string> libraries[] = {
${rows}};

}  // namespace splashdown::apps::built
")
file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
