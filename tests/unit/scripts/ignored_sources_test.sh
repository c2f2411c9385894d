#!/usr/bin/env bash
# .gitignore leaves out what builds and runs leave at the top, and no file beside sources, whatever its folder is called.
#   ignored_sources_test.sh SOURCE_DIR
set -uo pipefail
cd "$1" || exit 1
git rev-parse --is-inside-work-tree >/dev/null 2>&1 || { echo "skipped: no repository" && exit 77; }
failures=0
# A new file of each folder that has some.
ignored=$(git ls-files -z | xargs -0 -n 1 dirname | sort -u | sed 's|$|/a_new_file.cpp|' | git check-ignore --no-index --stdin)
[[ -z $ignored ]] || { echo "FAIL  ignored: $ignored" && failures=1; }
for left in build/release/x out/wedge_drop/report.html .cache/x; do
  git check-ignore --no-index -q "$left" || { echo "FAIL  not ignored: $left" && failures=1; }
done
exit $failures
