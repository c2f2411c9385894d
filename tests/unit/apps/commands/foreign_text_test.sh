#!/usr/bin/env bash
# Texts of a stranger's scene or study are data: gnuplot, the shell, Slurm, the terminal and the browser carry nothing
# of them out, and the figures are drawn all the same.
#   foreign_text_test.sh PATH_OF_SPLASHDOWN
. "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

# What shells and gnuplot would run, what would end their strings, what would be markup, in TOML's spelling.
evil='`touch PWNED` $(touch PWNED) '"'"'; system(\"touch PWNED\") #\" \\\" @PWNED {/Symbol a}_b^c \nset output \"PWNED\"\n! touch PWNED\n\u001b]0;x\u0007 \u009b31m </title><script>alert(1)</script> < touch PWNED |&'
clean() { # clean WHAT: nobody ran anything
  check "$1 runs nothing" test -z "$(find . -name 'PWNED*')"
}

titled() {  # titled TITLE: the wedge's scene with this title
  printf 'title = "%s"\n' "$1"
  wedge_scene 5 | tail -n +2
}
titled "$evil" >scene.toml
cat >>scene.toml <<'SCENE'
frames = 0.02
[[record]]
kind = "pressure"
name = "keel"
body = "wedge"
point = [0, 0]
[[record]]
kind = "maximum_pressure"
body = "wedge"
SCENE
check "a scene with a title like that runs" exits 0 "$splashdown" run scene.toml --out run
check "its title is one line without control characters" test "$(grep -c 'touch PWNED.* done 60 ms' stdout)" = 1
check "no terminal obeys it" test "$(tr -d '\n' <stdout | LC_ALL=C grep -c '[[:cntrl:]]')" = 0
check "nor does check's" exits 0 "$splashdown" check scene.toml
check "no control characters there either" test "$(head -n 1 stdout | LC_ALL=C grep -c '[[:cntrl:]]')" = 0
if command -v gnuplot >/dev/null; then
  check "its figures are drawn" test -s run/report/body_wedge_acceleration.svg -a -s run/report/probe_0.svg
fi
check "no browser obeys it" test "$(grep -c '<script>alert' run/report.html)" = 0
clean "a run"

refused() { # refused KEY=VALUE: told with the rule
  exits 2 "$splashdown" run scene.toml --out never --set "$1" &&
    grep -q 'name = .*: must be made of letters, digits, _ and -, .* Use letters, digits, _ and -, e.g. ' stderr
}
for record in pressure surface_elevation acceleration pressure_patch; do
  {
    titled plain
    printf '[[record]]\nkind = "%s"\nname = "%s"\n' "$record" "$evil"
  } >named.toml
  exits 2 "$splashdown" run named.toml --out never
  check "a $record record of that name is refused" grep -q 'record.*name = .*must be made of letters, digits, _ and -' stderr
done
check "so is a body" refused 'body.wedge.name="a b"'
clean "a refusal"

# A hull's file may have any name; it stands in messages only.
cp run/hull_wedge.vtu "run/hull_'; system(\"touch PWNED2\") #.vtu"
check "a report of a folder with such a file" exits 0 "$splashdown" report run
rm run/hull_*PWNED2*
clean "it"

titled plain >plain.toml
cat >study.toml <<STUDY
scene = "plain.toml"
title = "$evil"
[[axis]]
name = "mass"
label = "$evil"
key = "body.wedge.mass"
values = [60, 30]
[[axis]]
name = "words"
label = "$evil"
key = "title"
values = ["$evil", "plain"]
[[axis]]
name = "cases"
[[axis.case]]
name = "$evil"
set = ["time.end=0.002"]
[[quantity]]
name = "speed"
label = "$evil"
table = "bodies.csv:wedge"
quantity = "last(vy)"
unit = "$evil"
[chart]
x = "mass"
series = "words"
panels = "cases"
y = ["speed"]
STUDY
check "a study with texts like that" exits 0 "$splashdown" study study.toml --out study
if command -v gnuplot >/dev/null; then check "draws its chart" test -s study/study.svg -a -s study/study.png; fi
check "no terminal obeys it" test "$(tr -d '\n' <stdout | LC_ALL=C grep -c '[[:cntrl:]]')" = 0
check "no browser obeys it" test "$(grep -c '<script>alert\|alert(1)</script' study/report.html)" = 0  # the page has scripts of its own
clean "a study"

# A script in somebody else's folder is not carried out.
rm study/study.svg study/study.png
echo 'system("touch PWNED3")' >study/study.gnuplot
check "a report of a study without its chart" exits 0 "$splashdown" report study
check "says how to draw it" grep -q 'the chart, study.svg, is missing: splashdown study STUDY.toml --collect draws it' stderr
clean "it"

mkdir bin
printf '#!/usr/bin/env bash\nfor script in "$@"; do :; done\ncase "$*" in *--wrap*) bash -c "$script" >&2 ;; *) for t in 0 1 2 3; do SLURM_ARRAY_TASK_ID=$t bash "$script" >&2; done ;; esac\necho 7\n' >bin/sbatch
chmod +x bin/sbatch
cp study.toml $'study\n#SBATCH --output=PWNED\ntouch PWNED\n.toml'
check "the same on Slurm" exits 0 env PATH="$work/bin:$PATH" "$splashdown" study $'study\n#SBATCH --output=PWNED\ntouch PWNED\n.toml' --on slurm --out array
check "is made there" test "$(grep -c ',converged,' array/study.csv)" = 4
check "its script has no lines of others" test "$(grep -c '^touch\|^#SBATCH --output' array/study.sbatch)" = 0
rm study$'\n'*
clean "a job"

verdict
