# Sourced by cmake/run, cmake/test, cmake/lint and .ci/run: installs what is missing, configures and builds.
# POSIX sh. Everything it says goes to standard error, which leaves standard output to the program.

root=$(CDPATH= cd -- "$(dirname -- "$0")/.." && pwd)

# The one list of packages, by their names in Debian and Ubuntu. Least versions: cmake/dependencies.cmake.
# (openimageio-tools: the CMake files of libopenimageio-dev refuse to work without, though we do not use it.)
packages="
  cmake ninja-build g++ git
  libembree-dev libopenimageio-dev openimageio-tools libopenexr-dev libpng-dev libtbb-dev libxsimd-dev libcli11-dev
  nlohmann-json3-dev libtinyxml2-dev libxxhash-dev pkg-config libasio-dev
  catch2 libbenchmark-dev libxml2-utils python3 python3-jsonschema
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

# build PRESET TARGET...: configures once, then builds what changed; silent if that is nothing.
build() {
  preset=$1
  shift
  quiet=--quiet
  if [ ! -f "$root/build/$preset/build.ninja" ]; then
    (cd "$root" && cmake --preset "$preset") >&2 || return 1
    quiet=
  fi
  ninja -C "$root/build/$preset" $quiet "$@" >&2
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
