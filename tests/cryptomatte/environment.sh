# Sourced by cmake/test, after cmake/setup.sh: another program's reader of Cryptomatte. Where it cannot be had, its test
# is skipped.
# POSIX sh.
python_environment cryptomatte "$root/tests/cryptomatte/requirements.txt" ||
  say "cryptomatte-api cannot be installed: the test with that reader will be skipped."
