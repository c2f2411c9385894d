# Debian packages: which are missing, and installing them. To be sourced by bash.

no_packages=100  # exit code, apt-get's own

missing_packages() {  # missing_packages LIST...: those named in the files that are not installed, one a line
  local package
  while read -r package; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || echo "$package"
  done < <(grep -hv '^#' "$@")
}

# Nothing that is there is removed for them: --no-remove.
installing=(apt-get install -y -qq --no-install-recommends --no-remove -o APT::Keep-Downloaded-Packages=false)

packages_are_missing() {  # packages_are_missing WORDS CURE PACKAGE...: says what stands in the way, and gives up
  local words=$1 cure=$2
  shift 2
  {
    echo "error: these packages are missing and cannot be installed:"
    echo "  $*"
    [[ -z $words ]] || printf 'what stands in the way:\n%s\n' "$words"
    echo "what to do: $cure"
  } >&2
  return "$no_packages"
}

in_short() {  # in_short FILE: the lines of apt-get and sudo that tell what is wrong
  { grep -E '^(E:|Err:|sudo:|doas:)|Depends:|Conflicts:|Breaks:|PreDepends:|not allowed|not in the sudoers' "$1" || tail -n 5 "$1"; } |
    cut -c 1-200 | awk '!seen[$0]++' | head -n 12 | sed 's/^ */  /'
}

cure_for() {  # cure_for WORDS PACKAGE...
  local words=$1 by_hand
  shift
  by_hand="apt-get install --no-install-recommends $*"
  case $words in
    *"remove is disabled"*)
      echo "apt-get would have to remove packages that you have: '$by_hand -s' lists them. Remove them yourself if you can do without, or build in a container: Containerfile." ;;
    *"unmet dependencies"* | *"held broken"* | *"Resolve generated breaks"* | *"Unable to correct"*)
      echo "these packages do not go together with what is installed. '$by_hand' as root shows all of it; remove or update what it names, or build in a container: Containerfile." ;;
    *"resolv"* | *"Failed to fetch"* | *"Unable to fetch"* | *"Unable to connect"* | *"onnection "* | *"Network is unreachable"*)
      echo "connect this machine to a network in which its package sources can be reached (/etc/apt/sources.list*), and run this again." ;;
    *"Unable to locate"* | *"no installation candidate"*)
      echo "these are names of Debian 12's section main: add it to /etc/apt/sources.list*, or run 'apt-get update' as root. On another system install what they contain, and build by hand: docs/guide.md." ;;
    *"get lock"*) echo "another program is installing packages: wait until it is done, and run this again." ;;
    *"free space"* | *"No space left"*) echo "make room on the disk, and run this again." ;;
    *"dpkg was interrupted"*) echo "'dpkg --configure -a' as root ends what was interrupted; then run this again." ;;
    *sudo* | *"not allowed"*) echo "ask who may do so to run '$by_hand' as root, and run this again." ;;
    *) echo "'$by_hand' as root shows all of it." ;;
  esac
}

install_packages() {  # install_packages PACKAGE...; ends with no_packages if it cannot
  local as_root=() log status
  command -v apt-get >/dev/null || {
    packages_are_missing "  there is no apt-get here: this system is no Debian" \
      "install what they contain, and build by hand: docs/guide.md. Or build in a container: Containerfile." "$@"
    return
  }
  if (($(id -u) != 0)); then
    command -v sudo >/dev/null || {
      packages_are_missing "  you are not root, and there is no sudo" \
        "as root: apt-get install --no-install-recommends $*" "$@"
      return
    }
    as_root=(sudo)
  fi
  echo "installing: $*"
  log=$(mktemp)
  # A list that cannot be renewed may still do.
  "${as_root[@]}" env LC_ALL=C apt-get update -qq >"$log" 2>&1 || true
  status=0
  "${as_root[@]}" env LC_ALL=C DEBIAN_FRONTEND=noninteractive "${installing[@]}" "$@" >>"$log" 2>&1 || status=$?
  if ((status != 0)); then
    local words
    words=$(in_short "$log")
    packages_are_missing "$words" "$(cure_for "$words" "$@")" "$@" || status=$?
  fi
  rm -f "$log"
  return "$status"
}
