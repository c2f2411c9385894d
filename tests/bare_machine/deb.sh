# Packages that cpack makes: the program on a machine without compilers, the libraries on root's. Sourced by run.sh.
in_machine root sh -c 'apt-get install -y -qq --no-install-recommends file >/dev/null 2>&1'  # cpack asks it what links with what
check "cpack makes packages" in_machine root sh -c "cd $at && cpack --config build/release/CPackConfig.cmake >/dev/null"
debs=$work/root$at/build/release/packages
machine deb bare
cp "$debs"/splashdown_*.deb "$work/deb/root/"
# With what it recommends: gnuplot.
check "the program's installs" in_machine deb sh -c 'apt-get install -y -qq /root/splashdown_*.deb >/root/install.log 2>&1 || { tail /root/install.log; false; }'
check "and runs" first_command deb sh -c 'cd /root && splashdown run /usr/share/splashdown/examples/wedge_drop/scene.toml --out out'
check "and reports" has_landed deb /root/out
check "in space, with a multigrid, too" first_command deb sh -c 'cd /root && splashdown run /usr/share/splashdown/examples/sphere_entry/scene.toml --refine draft --until 0.002 --out ball'
cp "$debs"/splashdown-dev_*.deb "$work/root/root/"
check "that of the libraries installs" in_machine root sh -c 'apt-get install -y -qq --no-install-recommends /root/splashdown-dev_*.deb >/dev/null 2>&1'
check "a program of its own finds them" in_machine root sh -c "cmake -S $at/examples/library -B /root/library >/dev/null && cmake --build /root/library >/dev/null && /root/library/wedge_load >/dev/null"
in_machine root apt-get purge -y -qq splashdown-dev >/dev/null
