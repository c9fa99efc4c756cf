# Sourced by cmake/test, after cmake/setup.sh: what the tests of the farms need besides. Where something of it cannot be
# had, its test is skipped.
# POSIX sh.

# OpenJD's program.
python_environment farm "$root/tests/farm/requirements.txt" ||
  say "openjd-cli cannot be installed: the test of the OpenJD templates will be skipped."

# Slurm's daemons. Only for root, for others cannot run them as the test does.
if [ "$(id -u)" != 0 ]; then
  say "Not root: the test of the Slurm scripts will be skipped."
else
  install_packages slurm-wlm munge ||
    say "Slurm cannot be installed: the test of its scripts will be skipped."
fi
