#!/usr/bin/env bash
# Explores a simulated building and brings back its line map:
#   launch_scripts/explore.sh [WORLD.yaml] [options of 'cca-mrpt explore', see --help]
# Installs by apt what is missing, builds what has changed, explores (the office, if no world is
# named), and names the picture and the map at the end. Needs no display and no ROS.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
# The packages' own programs and Python, whatever else stands first in PATH.
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH

"$here/launch_scripts/install_dependencies.sh"

build="$here/build-explore"
mkdir -p "$build"
cmake -S "$here" -B "$build" -DCMAKE_BUILD_TYPE=Release -DPYTHON_EXECUTABLE=/usr/bin/python3 \
  -DCCA_WITH_ROS=OFF -DCCA_BUILD_TESTS=OFF -DCCA_BUILD_BENCHMARKS=OFF >"$build/configure.log" 2>&1 ||
  { cat "$build/configure.log" >&2; exit 1; }
cmake --build "$build" --target cca-mrpt -j"$(nproc)" -- --no-print-directory |
  { grep -E '^\[ *[0-9]+%\] Building|error|warning' || true; }
[ "${PIPESTATUS[0]}" -eq 0 ] || exit 1

case "${1:-}" in
  '' | -*) set -- "$here/maps/office.yaml" "$@" ;;
esac
exec "$(find "$build" -name cca-mrpt -type f -perm -u+x | head -n 1)" explore "$@"
