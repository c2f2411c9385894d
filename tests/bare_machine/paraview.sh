# With ParaView there before: it stays, and reads what is written. Sourced by run.sh.
machine paraview compilers
take_over_build paraview
in_machine paraview sh -c 'apt-get install -y -qq --no-install-recommends paraview python3-paraview >/dev/null 2>&1'
in_machine paraview dpkg-query -W -f='${Package} ${Version}\n' >"$work/paraview.before"
check "README's first command, beside ParaView" first_command paraview $at/examples/run_wedge_drop.sh --set output.frames=0.01
check "it has built, run and reported" has_landed paraview
in_machine paraview dpkg-query -W -f='${Package} ${Version}\n' >"$work/paraview.after"
check "nothing that was there is gone" test -z "$(comm -23 <(sort "$work/paraview.before") <(sort "$work/paraview.after"))"
check "ParaView's Python is there" in_machine paraview /usr/bin/python3 -c 'import paraview.simple'
check "pvpython reads frames and hulls" in_machine paraview pvpython --force-offscreen-rendering $at/tests/unit/frames/read_with_paraview.py $at/out/wedge_drop
