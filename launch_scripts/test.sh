#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests. Ends non-zero if any test failed or any part did
# not run; but the Python package's is passed over, and that is said, where pip can fetch nothing.
#
#   launch_scripts/test.sh               what a change can break: checks of the sources and the pages,
#                                        unit, command-line, exploration and node tests
#   launch_scripts/test.sh --all         also the long ones: random places, real logs, MRPT's programs,
#                                        rviz and the installed package, the Python package, programs that
#                                        measure times and must build, the unit tests under sanitizers in a build without ROS
#   launch_scripts/test.sh --all fuzz    the fuzzers, by a build of their own; they run only when named
#   launch_scripts/test.sh [--all] NAME  of these, the parts whose name holds NAME (see the end)
set -u
cd "$(dirname "$0")/.." || exit
# ROS's Python programs need the system's Python, whatever else stands first in PATH.
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH MAKEFLAGS=--no-print-directory
all=OFF
[ "${1:-}" != --all ] || { all=ON; shift; }
only=${1:-}
jobs=$(nproc)
results=() passed=0 failed=0
werror=OFF
[ -z "${CI:-}" ] || werror=ON
beside='' told=$(mktemp)
trap '[ -z "$beside" ] || kill -- -"$beside" 2>/dev/null; rm -f "$told"' EXIT
trap 'exit 130' INT TERM

is_asked_for() { case "$1" in *"$only"*) ;; *) return 1 ;; esac }

part() {  # part NAME COMMAND...: runs it, and keeps how it ended
  local name=$1 begin=$SECONDS status=passed
  shift
  is_asked_for "$name" || return 0
  printf '\n=== %s\n' "$name"
  "$@" || status=FAILED
  [ $status = passed ] && passed=$((passed + 1)) || failed=$((failed + 1))
  results+=("$(printf '%-28s %-6s %5d s' "$name" $status $((SECONDS - begin)))")
}

beside() {  # beside COMMAND...: begins what computes only, in what parts leave idle of the processors, until await()
  set -m  # a process group of its own, so that all of it can be ended
  { renice -n 19 "$BASHPID" >/dev/null; "$@"; } >"$told" 2>&1 </dev/null &
  beside=$!
  set +m
}

await() {  # also says what it said
  local status=0
  wait "$beside" || status=$?
  beside=
  cat "$told"
  return $status
}

configure_and_build() {  # DIR "TARGETS" OPTIONS...
  local dir=$1 targets
  read -ra targets <<<"$2"
  shift 2
  mkdir -p "$dir"
  # Make waits for all of a library before it compiles what links it; Ninja does not.
  [ -e "$dir/CMakeCache.txt" ] || set -- -G Ninja "$@"
  cmake -S . -B "$dir" -DCCA_BUILD_TESTS=ON -DCCA_WARNINGS_AS_ERRORS=$werror "$@" \
    >"$dir/configure.log" 2>&1 || { cat "$dir/configure.log"; return 1; }
  cmake --build "$dir" -j"$jobs" --target "${targets[@]}" 2>&1 |
    grep -vE '^\[[ 0-9/%]+\] (Built|Linking|Generating)|^Scanning'
  return "${PIPESTATUS[0]}"
}

release() {
  local what=all
  [ $all = OFF ] || what='all timing'
  configure_and_build build "$what" -DCCA_BUILD_BENCHMARKS=ON || return 1
  grep -q '^CCA_WITH_ROS:BOOL=ON' build/CMakeCache.txt && [ -x build/devel/lib/cca_mrpt/cca-mrpt ] ||
    { echo "the build has no ROS nodes"; return 1; }
}

# Many tests wait for a robot rather than for a processor: three at a time on each.
tests() { (cd build && ctest -j$((3 * jobs)) --output-on-failure --no-tests=error "$@"); }

# Also the proof that everything but the nodes builds where ROS is absent.
sanitized() {  # DIR TARGET OPTIONS...
  configure_and_build "$@" -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O1 \
    -DCCA_SANITIZE=ON -DCCA_WITH_ROS=OFF
}

sanitizers() {
  await || return 1
  (cd build-sanitize && LSAN_OPTIONS="suppressions=$PWD/../test/checks/leaks.supp:print_suppressions=0" \
    ctest -j"$jobs" --output-on-failure --no-tests=error -L unit)
}

fuzzers() {
  sanitized build-fuzz fuzzers -DCMAKE_CXX_COMPILER=clang++ -DCCA_BUILD_FUZZERS=ON -DCCA_BUILD_BENCHMARKS=OFF || return 1
  (cd build-fuzz && ctest -j"$jobs" --output-on-failure --no-tests=error -L fuzz)
}

part dependencies ./launch_scripts/install_dependencies.sh --tests
# It waits neither for a robot nor for the network, as tests and Python's part do.
if [ $all = ON ] && is_asked_for sanitizers-without-ros; then
  beside sanitized build-sanitize unit_tests -DCCA_BUILD_BENCHMARKS=ON
fi
part layers test/checks/layers.sh
part format test/checks/format.sh
part pages test/checks/pages.sh
part scripts test/checks/scripts.sh
part constants test/checks/constants.py
part tidy test/checks/tidy.sh
part build release
if [ $all = ON ]; then
  part tests tests
  part python python/test.sh
  part sanitizers-without-ros sanitizers
  case "$only" in fuzz*) part fuzzers fuzzers ;; esac
else
  part tests tests -LE long
fi

printf '\n'
printf '%s\n' "${results[@]}"
printf '\n%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
