# Sourced by benchmarks/compare, scaling and instruction_sets, after cmake/setup.sh: the Python that they run with.
# POSIX sh.

# Python's packages, in a folder of their own; one that cannot be installed does not keep out the others.
requirements=$root/benchmarks/comparison/requirements.txt
venv=$root/build/comparison/venv
if ! cmp -s "$requirements" "$venv/installed"; then
  python3 -m venv "$venv" >&2
  while read -r requirement; do
    "$venv/bin/pip" install --quiet "$requirement" >&2 || say "Going on without $requirement."
  done <"$requirements"
  cp "$requirements" "$venv/installed"
fi
