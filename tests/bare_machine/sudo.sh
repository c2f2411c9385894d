# As a user who may use sudo. Sourced by run.sh.
machine sudo compilers
take_over_build sudo
in_machine sudo sh -c "apt-get install -y -qq --no-install-recommends sudo >/dev/null 2>&1 && useradd --create-home --shell /bin/bash sailor &&
  echo 'sailor ALL=(ALL) NOPASSWD: ALL' >/etc/sudoers.d/sailor && chown -R sailor $at"
check "README's first command, with sudo" first_command sudo su - sailor -c $at/examples/run_wedge_drop.sh
check "it has built, run and reported" has_landed sudo
