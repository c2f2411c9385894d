# Checks of the command's shell tests; to be sourced. Count what failed in `failures`.
failures=0

check() {  # check DESCRIPTION COMMAND...
  local what=$1
  shift
  if "$@"; then
    echo "ok    $what"
  else
    echo "FAIL  $what"
    failures=$((failures + 1))
  fi
}

exits() {  # exits CODE COMMAND...: the command ends with this code
  local expected=$1
  shift
  "$@" >stdout 2>stderr
  local code=$?
  ((code == expected)) && return 0
  echo "exit code $code instead of $expected: $*"
  cat stdout stderr
  return 1
}
