# Sourced by the scripts beside it: installs what is missing, configures and builds.
# POSIX sh. Everything it says goes to standard error, which leaves standard output to the program.

root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)

# The lists of packages, by their names in Debian and Ubuntu. Least versions: cmake/dependencies.cmake.
# What the program is built with. (openimageio-tools: the CMake files of libopenimageio-dev refuse to work without, though
# we do not use it.)
program_packages="
  cmake ninja-build g++ pkg-config
  libembree-dev libopenimageio-dev openimageio-tools libopenexr-dev libpng-dev libjpeg-dev libwebp-dev zlib1g-dev libtbb-dev
  libxsimd-dev libcli11-dev nlohmann-json3-dev libtinyxml2-dev libxxhash-dev libasio-dev
  libdraco-dev libmeshoptimizer-dev libassimp-dev
"
# What tests and benchmarks need besides.
packages="
  $program_packages
  git catch2 libbenchmark-dev libxml2-utils python3 python3-jsonschema
"

say() { printf '%s\n' "$*" >&2; }

# missing_packages NAME...: those that are not installed.
missing_packages() {
  for package in $(dpkg-query --show --showformat '${db:Status-Status}:${Package}\n' "$@" 2>/dev/null); do
    case $package in installed:*) set -- "$@" "${package#installed:}=installed" ;; esac
  done
  for package in "$@"; do
    case " $* " in *" ${package%=installed}=installed "*) ;; *) printf '%s ' "$package" ;; esac
  done
}

# install_packages NAME...: installs those that are missing where that can be done, else says what is needed.
install_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    # Not Debian: whoever has the libraries goes on; CMake checks each one and its version.
    if [ ! -f "$root/build/release/build.ninja" ]; then
      say "This is not Debian or Ubuntu, so nothing is installed here. Needed, under Debian's names:"
      say "$(printf '  %s\n' "$@")"
    fi
    return 0
  fi
  missing=$(missing_packages "$@")
  [ -n "$missing" ] || return 0
  as_root=
  if [ "$(id -u)" != 0 ]; then
    as_root=sudo
    if ! command -v sudo >/dev/null; then
      say "These packages are missing, and without root or sudo they cannot be installed: $missing"
      return 1
    fi
  fi
  say "Installing: $missing"
  # shellcheck disable=SC2086
  $as_root apt-get update -qq >&2 &&
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >&2 || {
    say "apt-get could not install: $missing"
    return 1
  }
}

# configure PRESET [cmake options]: once; sets `quiet` for the builds after the first.
configure() {
  quiet=--quiet
  if [ ! -f "$root/build/$1/build.ninja" ]; then
    (cd "$root" && cmake --preset "$@") >&2 || return 1
    quiet=
  fi
}

# build PRESET TARGET...: configures once, then builds what changed; silent if that is nothing.
build() {
  configure "$1" || return 1
  preset=$1
  shift
  ninja -C "$root/build/$preset" $quiet "$@" >&2
}

# labels_of TIER: a regular expression for ctest -L, of the labels that tests/budgets.txt has in a tier.
labels_of() {
  awk -v tier="$1" '$1 == "label" { for (i = 4; i <= NF; ++i) if ($i == tier) labels = labels "|" $2 }
    END { print "^(" substr(labels, 2) ")$" }' "$root/tests/budgets.txt"
}

# targets_of TIER: what must be built for its tests.
targets_of() {
  printf 'raytrace_program raytrace_manual fake_denoiser'
  for label in $(labels_of "$1" | tr '^(|)$' ' '); do
    for source in "$root/tests/$label"/*_test.cpp; do
      [ ! -f "$source" ] || { printf ' %s_tests' "$label" && break; }
    done
  done
}

# instruction_sets: the lowest that is built for this machine's kind of processor, and the best that it runs, as a CMake
# list; nothing where glibc does not say.
instruction_sets() {
  for loader in /lib64/ld-linux-x86-64.so.2 /lib/ld-linux-x86-64.so.2; do
    [ -x "$loader" ] || continue
    "$loader" --help | awk '$1 ~ /^x86-64-v[34]$/ && $2 ~ /supported/ { best = best == "" ? ";" $1 : best }
      $1 == "x86-64-v2" && $2 ~ /supported/ { print $1 best }'
    return
  done
}

# python_environment NAME REQUIREMENTS: Python packages in build/NAME/venv, which has a copy of the file REQUIREMENTS as
# "installed" once all of them are there.
python_environment() {
  environment=$root/build/$1/venv
  if ! cmp -s "$2" "$environment/installed"; then
    install_packages python3-venv && python3 -m venv "$environment" >&2 &&
      "$environment/bin/pip" install --quiet --retries 1 --requirement "$2" >&2 &&
      cp "$2" "$environment/installed"
  fi
}
