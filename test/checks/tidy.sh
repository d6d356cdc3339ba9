#!/usr/bin/env bash
# What clang-tidy says of the algorithm layers, by .clang-tidy: tidy.sh [LAYER...]. Without layers: of those of which it
# has nothing to say any more.
#
# Sources are read eight at a time, as they are compiled: each file alone reads Eigen once more, which takes longer than
# all else. Skipped where there is no clang-tidy.
set -u
cd "$(dirname "$0")/../.." || exit
command -v clang-tidy >/dev/null || { echo "tidy: SKIPPED (no clang-tidy here: Debian's clang-tidy)"; exit 0; }
layers=("$@")
[ $# -gt 0 ] || layers=(geometry motion sensing localisation mapping)
units=$(mktemp -d)
trap 'rm -rf "$units"' EXIT
for layer in "${layers[@]}"; do
  grep -oE '[a-z0-9_/]+\.cpp' "src/$layer/CMakeLists.txt" | sed "s|.*|#include \"$layer/&\"|" |
    split -l 8 --additional-suffix=.cpp - "$units/$layer-"
done
# Files come in as headers here.
find "$units" -name '*.cpp' -print0 | sort -z |
  xargs -0 -I '{}' -P "$(nproc)" clang-tidy --quiet --config-file=.clang-tidy --warnings-as-errors='*' \
    --checks=-bugprone-suspicious-include --header-filter="$PWD/(src|include)/.*" '{}' -- \
    -std=c++17 -I"$PWD/include" -I"$PWD/src" -isystem /usr/include/eigen3 >"$units/said" 2>"$units/counts"
status=$?
grep -v '^[0-9]* warnings generated\|^Suppressed\|^Use -header-filter' "$units/said" "$units/counts" -h
[ $status -eq 0 ] && echo "tidy: clean"
exit $status
