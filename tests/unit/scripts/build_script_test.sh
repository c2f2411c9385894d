#!/usr/bin/env bash
# scripts/build.sh where apt-get cannot: a table of what stands in the way, with stand-ins for the system's programs.
#   build_script_test.sh SOURCE_DIR
set -uo pipefail
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# Only what the script may use.
bin=$work/bin
mkdir "$bin"
for program in bash env cat grep awk sed cut head tail mktemp rm dirname nproc sort printf; do ln -s "$(type -P $program)" "$bin/"; done
stand_in() {  # stand_in PROGRAM: its script comes from standard input
  { echo '#!/usr/bin/env bash' && cat; } >"$bin/$1"
  chmod +x "$bin/$1"
}
stand_in cmake <<<'exit 0'

machine() {  # machine USER_ID PACKAGES_ARE WORDS EXIT_CODE: PACKAGES_ARE: installed, missing
  rm -f "$bin/sudo" "$work/calls"
  stand_in id <<<"echo $1"
  stand_in dpkg-query <<<"[[ $2 == installed ]] && echo installed"
  printf '%s\n' "$3" >"$work/words"
  stand_in apt-get <<<"echo \"\$*\" >>'$work/calls'; [[ \$1 == update ]] || { cat '$work/words' >&2; exit $4; }"
}

try() { PATH=$bin bash "$root/scripts/build.sh" no_such_preset >"$work/out" 2>"$work/err"; }

expect() {  # expect WHAT EXIT_CODE TEXT...: the script ends so and says all of it
  local what=$1 code=$2 status text
  shift 2
  try
  status=$?
  ((status == code)) || { echo "FAIL  $what: exit code $status instead of $code" && cat "$work/err" && failures=$((failures + 1)); }
  for text in "$@"; do
    grep -qF -- "$text" "$work/err" "$work/out" && continue
    echo "FAIL  $what: does not say '$text'" && cat "$work/out" "$work/err"
    failures=$((failures + 1))
  done
  (($(wc -l <"$work/err") <= 18)) || { echo "FAIL  $what: $(wc -l <"$work/err") lines" && failures=$((failures + 1)); }
  echo "      $what"
}

machine 0 installed "" 0
expect "nothing is missing: apt-get is not called" 0
[[ ! -e $work/calls ]] || { echo "FAIL  apt-get was called: $(cat "$work/calls")" && failures=$((failures + 1)); }

machine 0 missing "" 0
expect "all that is missing is installed" 0 "installing: build-essential cmake"
grep -q -- '--no-remove' "$work/calls" || { echo "FAIL  packages that users have may be removed" && failures=$((failures + 1)); }

missing="error: these packages are missing and cannot be installed:"
machine 0 missing "Err:1 mirror bookworm InRelease
  Temporary failure resolving 'mirror'
E: Failed to fetch mirror/pool/x.deb  Temporary failure resolving 'mirror'
E: Unable to fetch some archives, maybe run apt-get update or try with --fix-missing?" 100
expect "no network" 100 "$missing" "build-essential" "E: Failed to fetch" "what to do: connect this machine to a network"

machine 0 missing "Starting pkgProblemResolver with broken count: 1
$(for i in {1..200}; do echo "Investigating ($i) libsomething"; done)
The following packages have unmet dependencies:
 python3-paraview : Conflicts: python3-vtk9 but 9.1.0 is to be installed
E: Error, pkgProblemResolver::Resolve generated breaks, this may be caused by held packages." 100
expect "a conflict" 100 "$missing" "python3-paraview : Conflicts: python3-vtk9" "Resolve generated breaks" "what to do: these packages do not go together" "Containerfile"

machine 0 missing "E: Packages need to be removed but remove is disabled." 100
expect "packages would be removed" 100 "remove is disabled" "what to do: apt-get would have to remove packages that you have"

machine 0 missing "E: Unable to locate package libcli11-dev" 100
expect "another release" 100 "Unable to locate package libcli11-dev" "what to do: these are names of Debian 12's section main"

machine 0 missing "E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 17 (apt)" 100
expect "another apt-get is at work" 100 "held by process 17" "what to do: another program is installing packages"

machine 0 missing "E: You don't have enough free space in /var/cache/apt/archives/." 100
expect "no room" 100 "enough free space" "what to do: make room on the disk"

machine 0 missing "E: dpkg was interrupted, you must manually run 'dpkg --configure -a' to correct the problem." 100
expect "an installation was interrupted" 100 "what to do: 'dpkg --configure -a' as root"

machine 0 missing "something that nobody has foreseen" 1
expect "words that nobody has foreseen" 100 "something that nobody has foreseen" "what to do: 'apt-get install --no-install-recommends build-essential"

machine 1000 missing "" 0
expect "no root and no sudo" 100 "$missing" "you are not root, and there is no sudo" "what to do: as root: apt-get install --no-install-recommends build-essential"

machine 1000 missing "" 0
stand_in sudo <<<'echo "sudo: a terminal is required to read the password" >&2; exit 1'
expect "sudo refuses" 100 "$missing" "sudo: a terminal is required" "what to do: ask who may do so"

machine 1000 missing "" 0
stand_in sudo <<<'exec "$@"'
expect "sudo may" 0 "installing: build-essential cmake"

machine 0 missing "" 0
rm "$bin/apt-get"
expect "no Debian" 100 "$missing" "there is no apt-get here" "what to do: install what they contain"

echo "$failures failures"
((failures == 0))
