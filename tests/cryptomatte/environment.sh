# Sourced by cmake/test, after cmake/setup.sh: another program's reader of Cryptomatte, in a folder of its own. Where it
# cannot be had, its test is skipped.
# POSIX sh.
requirements=$root/tests/cryptomatte/requirements.txt
venv=$root/build/cryptomatte/venv
if ! cmp -s "$requirements" "$venv/installed"; then
  install_packages python3-venv && python3 -m venv "$venv" >&2 &&
    "$venv/bin/pip" install --quiet --retries 1 --requirement "$requirements" >&2 &&
    cp "$requirements" "$venv/installed" ||
    say "cryptomatte-api cannot be installed: the test with that reader will be skipped."
fi
