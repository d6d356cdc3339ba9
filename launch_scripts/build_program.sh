#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs by apt what is missing, builds what has changed, and prints the path of cca-mrpt: the first
# step of the other scripts. build_program.sh [--evidence]: with evaluate, compare-* and tune, a third
# more to build, which stay once they are there. Where CCA_MRPT names a program, that one is printed and nothing is built.
# Needs no display and no ROS.
set -eu
if [ -n "${CCA_MRPT:-}" ]; then
  realpath -e "$CCA_MRPT"
  exit
fi
here=$(cd "$(dirname "$0")/.." && pwd)
# The packages' own programs and Python, whatever else stands first in PATH.
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH MAKEFLAGS=--no-print-directory

"$here/launch_scripts/install_dependencies.sh" >&2

build="$here/build-explore"
new="" evidence=""
[ -e "$build/CMakeCache.txt" ] || new="-G Ninja" evidence=-DCCA_WITH_EVIDENCE=OFF
[ "${1:-}" != --evidence ] || evidence=-DCCA_WITH_EVIDENCE=ON
mkdir -p "$build"
cmake -S "$here" -B "$build" -DCMAKE_BUILD_TYPE=Release \
  $new -DCCA_WITH_ROS=OFF $evidence -DCCA_BUILD_TESTS=OFF -DCCA_BUILD_BENCHMARKS=OFF >"$build/configure.log" 2>&1 ||
  { cat "$build/configure.log" >&2; exit 1; }
cmake --build "$build" --target cca-mrpt -j"$(nproc)" |
  { grep -E '[0-9]+[]%].* Building|error|warning' || true; } >&2
[ "${PIPESTATUS[0]}" -eq 0 ] || exit 1
ln -sf build-explore/src/apps/cca-mrpt "$here/cca-mrpt"  # ./cca-mrpt --help
find "$build" -name cca-mrpt -type f -perm -u+x | head -n 1
