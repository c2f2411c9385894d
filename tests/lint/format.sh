#!/usr/bin/env bash
# Is the tree as .clang-format wants it?   Cure: clang-format -i FILE
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
find apps core coupling elastic fluid rigid tests \( -name '*.cpp' -o -name '*.hpp' \) -print0 | xargs -0 clang-format --dry-run -Werror
