#!/usr/bin/env bash
# README's first command on a bare Debian 12, in folders that are thrown away: needs root and debootstrap, 8 GB of disk and a mirror.
#   tests/bare_machine/run.sh [--work DIR] [--keep] [root] [deb] [sudo] [paraview]     default: all, in this order
# root      as root; measures disk and time
# deb       the packages that cpack makes of that build: the program on a machine without compilers, the libraries beside them
# sudo      as a user who may use sudo
# paraview  with Debian's ParaView there before, which stays; it reads what was written
# The others take over root's build: they install and run, and compile nothing. Exit code 77: cannot be tried here.
set -euo pipefail
# In a mount namespace of its own: what it mounts is gone when it ends, however it ends.
[[ -n ${SPLASHDOWN_OWN_MOUNTS:-} || $(id -u) != 0 ]] || SPLASHDOWN_OWN_MOUNTS=yes exec unshare --mount --propagation private "$0" "$@"
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
release=bookworm
most_megabytes=650    # README: 0.65 GB
most_cpu_minutes=8    # four on each of two cores
at=/srv/splashdown                    # the sources in the machines
work= keep= variants=()
while (($#)); do
  case $1 in
    --work) work=$2 && shift ;;
    --keep) keep=yes ;;
    *) variants+=("$1") ;;
  esac
  shift
done
((${#variants[@]})) || variants=(root deb sudo paraview)
(($(id -u) == 0)) && command -v debootstrap >/dev/null || { echo "skipped: needs root and debootstrap" && exit 77; }
work=${work:-$(mktemp -d)}
mkdir -p "$work"
failures=0
here=$(dirname "${BASH_SOURCE[0]}")
# shellcheck source=tests/bare_machine/machine.sh
source "$here/machine.sh"
trap end_machines EXIT

# Mirrors as this machine's apt has them.
mapfile -t sources < <(apt-get indextargets --format 'deb $(SITE) $(RELEASE) main' 'Created-By: Packages' 'Component: main' | grep " $release" | sort -u)
mirror=$(printf '%s\n' "${sources[@]}" | awk -v release=$release '$3 == release {print $2; exit}')
[[ -n $mirror ]] || { echo "skipped: this machine's apt knows no $release" && exit 77; }

if [[ ! -d $work/bare ]]; then
  debootstrap --variant=minbase "$release" "$work/bare.part" "$mirror" >"$work/debootstrap.log" 2>&1 || {
    tail -n 20 "$work/debootstrap.log"
    exit 1
  }
  printf '%s\n' "${sources[@]}" >"$work/bare.part/etc/apt/sources.list"
  [[ ! -s /etc/apt/apt.conf ]] || cp /etc/apt/apt.conf "$work/bare.part/etc/apt/"
  mv "$work/bare.part" "$work/bare"
  in_machine bare apt-get update -qq
fi
if [[ ! -d $work/compilers ]]; then
  machine compilers.part bare
  in_machine compilers.part apt-get install -y -qq --no-install-recommends build-essential >/dev/null 2>&1
  put_sources compilers.part
  # Packages are loaded now: what is measured does not depend on the network.
  in_machine compilers.part sh -c "apt-get install -y -qq --no-install-recommends --download-only \$(grep -hv '^#' $at/scripts/packages.txt) >/dev/null"
  end_machine compilers.part
  mv "$work/compilers.part" "$work/compilers"
fi

rm -rf --one-file-system "${work:?}/compilers$at"  # machines that were kept have the sources of then
put_sources compilers

for variant in "${variants[@]}"; do
  echo "== $variant"
  # shellcheck source=/dev/null
  source "$here/$variant.sh"
  [[ -n $keep || $variant == root ]] || drop_machine "$variant"
done
echo "$failures failures"
((failures == 0))
