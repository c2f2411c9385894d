# As root, from a machine with compilers alone and the packages loaded; disk and time as README says. Sourced by run.sh.
machine root compilers
before=$(megabytes_of_packages root) before_disk=$(megabytes_on_disk root)
TIMEFORMAT='%R %U %S'
{ time check "README's first command, as root" first_command root $at/examples/run_wedge_drop.sh; } 2>"$work/time"
read -r wall user sys < <(tail -n 1 "$work/time")
check "it has built, run and reported" has_landed root
packages=$(($(megabytes_of_packages root) - before))
cpu_minutes=$(awk -v u="$user" -v s="$sys" 'BEGIN {printf "%.1f", (u + s) / 60}')
echo "packages beyond build-essential: $packages MB as apt counts, $(($(megabytes_on_disk root) - before_disk)) MB of blocks on this disk"
echo "build: $(du -sm "$work/root$at/build" | cut -f 1) MB"
echo "first command: $cpu_minutes minutes of processor time, $(awk -v w="$wall" 'BEGIN {printf "%.1f", w / 60}') of wall time on $(nproc) cores"
check "packages take at most $most_megabytes MB" test "$packages" -le "$most_megabytes"
check "it takes at most $most_cpu_minutes minutes of processor time" awk -v c="$cpu_minutes" -v m="$most_cpu_minutes" 'BEGIN {exit !(c <= m)}'
check "a second call installs nothing" bash -c '! grep -q "^installing" <<<"$1"' _ "$(in_machine root $at/scripts/build.sh)"
