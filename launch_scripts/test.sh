#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test: checks of the sources, unit, acceptance and
# command-line tests, rostest with its own master, rviz off-screen, and the unit tests under sanitizers in
# a build without ROS. Ends non-zero if any test failed or any part did not run.
#
#   launch_scripts/test.sh          all of it
#   launch_scripts/test.sh NAME     only the parts whose name holds NAME (see the table at the end)
set -u
cd "$(dirname "$0")/.."
# ROS's Python programs need the system's Python, whatever else stands first in PATH.
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH MAKEFLAGS=--no-print-directory
only=${1:-}
jobs=$(nproc)
results=() passed=0 failed=0
werror=OFF
[ -z "${CI:-}" ] || werror=ON

part() {  # part NAME COMMAND...: runs it, and keeps how it ended
  local name=$1 begin=$SECONDS status=passed
  shift
  case "$name" in *"$only"*) ;; *) return 0 ;; esac
  printf '\n=== %s\n' "$name"
  "$@" || status=FAILED
  [ $status = passed ] && passed=$((passed + 1)) || failed=$((failed + 1))
  results+=("$(printf '%-28s %-6s %5d s' "$name" $status $((SECONDS - begin)))")
}

configure_and_build() {  # DIR OPTIONS...
  local dir=$1
  shift
  mkdir -p "$dir"
  cmake -S . -B "$dir" -DCCA_WARNINGS_AS_ERRORS=$werror "$@" \
    >"$dir/configure.log" 2>&1 || { cat "$dir/configure.log"; return 1; }
  cmake --build "$dir" -j"$jobs" 2>&1 | grep -vE '^\[ *[0-9]+%\] (Built|Linking|Generating)|^Scanning'
  return "${PIPESTATUS[0]}"
}

release() {
  configure_and_build build || return 1
  grep -q '^CCA_WITH_ROS:BOOL=ON' build/CMakeCache.txt && [ -x build/devel/lib/cca_mrpt/cca-mrpt ] ||
    { echo "the build has no ROS nodes"; return 1; }
}

tests() { (cd build && ctest -j"$jobs" --output-on-failure --no-tests=error "$@"); }

# Also the proof that everything but the nodes builds where ROS is absent.
sanitizers() {
  configure_and_build build-sanitize -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O1 -DCCA_SANITIZE=ON \
    -DCCA_WITH_ROS=OFF -DCCA_BUILD_BENCHMARKS=OFF || return 1
  (cd build-sanitize && LSAN_OPTIONS="suppressions=$PWD/../test/checks/leaks.supp:print_suppressions=0" \
    ctest -j"$jobs" --output-on-failure --no-tests=error -L unit)
}

part dependencies ./launch_scripts/install_dependencies.sh --tests
part layers test/checks/layers.sh
part format test/checks/format.sh
part build release
part tests tests
part python python/test.sh
part sanitizers-without-ros sanitizers

printf '\n'
printf '%s\n' "${results[@]}"
printf '\n%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
