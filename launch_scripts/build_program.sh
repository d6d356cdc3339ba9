#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs by apt what is missing, builds what has changed, and prints the path of cca-mrpt, or with --bench that of
# cca-mrpt-bench: the first step of the other scripts. Where CCA_MRPT (CCA_MRPT_BENCH) names a program, that one is
# printed and nothing is built. Needs no display and no ROS.
set -eu
name=cca-mrpt built=${CCA_MRPT:-}
[ "${1:-}" != --bench ] || name=cca-mrpt-bench built=${CCA_MRPT_BENCH:-}
if [ -n "$built" ]; then
  realpath -e "$built"
  exit
fi
here=$(cd "$(dirname "$0")/.." && pwd)
# The packages' own programs and Python, whatever else stands first in PATH.
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH MAKEFLAGS=--no-print-directory

"$here/launch_scripts/install_dependencies.sh" >&2

build="$here/build-explore"
options=(-DCMAKE_BUILD_TYPE=Release -DCCA_WITH_ROS=OFF -DCCA_BUILD_TESTS=OFF)
[ -e "$build/CMakeCache.txt" ] || options+=(-G Ninja)
[ $name = cca-mrpt ] || options+=(-DCCA_BUILD_BENCHMARKS=ON)
mkdir -p "$build"
cmake -S "$here" -B "$build" "${options[@]}" >"$build/configure.log" 2>&1 ||
  { cat "$build/configure.log" >&2; exit 1; }
cmake --build "$build" --target $name -j"$(nproc)" |
  { grep -E '[0-9]+[]%].* Building|error|warning' || true; } >&2
[ "${PIPESTATUS[0]}" -eq 0 ] || exit 1
[ $name != cca-mrpt ] || ln -sf build-explore/src/apps/cca-mrpt "$here/cca-mrpt"  # ./cca-mrpt --help
find "$build" -name $name -type f -perm -u+x | head -n 1
