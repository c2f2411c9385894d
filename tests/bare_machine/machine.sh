# Machines of the bare machine test: folders with a Debian in them. To be sourced.

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

machine() {  # machine NAME LIKE: a new one, a copy of another
  drop_machine "$1"
  end_machine "$2"
  cp -ax --reflink=auto "$work/$2" "$work/$1"  # -x: never what is mounted there
}

in_machine() {  # in_machine NAME COMMAND...
  local root=$work/$1
  shift
  mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
  mountpoint -q "$root/dev" || devices "$root/dev"
  cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
  chroot "$root" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} DEBIAN_FRONTEND=noninteractive "$@"
}

devices() {  # devices FOLDER: nodes of its own, never those of this machine
  local node name major minor
  mount -t tmpfs -o mode=755 tmpfs "$1"
  for node in null:1:3 zero:1:5 full:1:7 random:1:8 urandom:1:9 tty:5:0; do
    IFS=: read -r name major minor <<<"$node"
    mknod -m 666 "$1/$name" c "$major" "$minor"
  done
  ln -s /proc/self/fd "$1/fd"
  ln -s fd/0 "$1/stdin"
  ln -s fd/1 "$1/stdout"
  ln -s fd/2 "$1/stderr"
  mkdir -m 1777 "$1/shm"
  mkdir "$1/pts"
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$1/pts"
  ln -s pts/ptmx "$1/ptmx"
}

end_machine() {  # end_machine NAME: nothing of this machine is mounted there any more
  local part
  for part in proc dev/pts dev; do
    ! mountpoint -q "$work/$1/$part" || umount "$work/$1/$part"
  done
}

end_machines() {
  local root
  for root in "$work"/*/; do end_machine "$(basename "$root")"; done
  [[ -n $keep ]] || rm -rf --one-file-system "$work"
}

drop_machine() {  # drop_machine NAME
  [[ ! -d $work/$1 ]] || { end_machine "$1" && rm -rf --one-file-system "${work:?}/$1"; }
}

put_sources() {  # put_sources NAME: unpacked, as git has them here
  mkdir -p "$work/$1$at"
  git -C "$source_dir" ls-files -z | tar -C "$source_dir" --null -T - -c | tar -C "$work/$1$at" -x --no-same-owner
}

take_over_build() {  # take_over_build NAME: of the machine `root`, its packages not
  [[ -x $work/root$at/build/release/splashdown ]] || { echo "run the variant root before, with --keep" && exit 2; }
  cp -a "$work/root$at/build" "$work/$1$at/"
}

megabytes_of_packages() {  # as apt counts
  in_machine "$1" dpkg-query -W -f='${db:Status-Status} ${Installed-Size}\n' | awk '$1 == "installed" {sum += $2} END {print int(sum * 1.024e-3 + 0.5)}'
}

megabytes_on_disk() {  # in files, without lists and loaded packages
  du -smx --exclude="$work/$1/var/lib/apt" --exclude="$work/$1/var/cache/apt" --exclude="$work/$1$at" "$work/$1" | cut -f 1
}

first_command() {  # first_command NAME COMMAND...: README's; its words go to NAME.log
  local name=$1
  shift
  in_machine "$name" "$@" >"$work/$name.log" 2>&1 || {
    tail -n 30 "$work/$name.log"
    return 1
  }
}

has_landed() {  # has_landed NAME [FOLDER]: a wedge dropped on water, and its report is there
  local out=$work/$1${2:-$at/out/wedge_drop}
  grep -q '"status": "done"' "$out/summary.json" && grep -q '<svg\|\.svg' "$out/report.html" && [[ -s $out/frames.pvd || -s $out/snapshots/end.vtu ]]
}
