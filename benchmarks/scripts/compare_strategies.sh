#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every exploration strategy on the same worlds, starts and seeds: a table, and the curves of
# coverage over distance with their 95 % bands, in $OUT (out/strategies).
#
#   compare_strategies.sh [WORLD.yaml ...] [options of 'cca-mrpt-bench compare-strategies']
#   MOVED="0.021 0.034" compare_strategies.sh ../shared/data/worlds/dare/dare_*.yaml --starts 1 --laser.range 7.5
#
# Without worlds: those of maps/, and five random ones. With MOVED their lower left corners lie there (m), off the lines
# of the 5 cm grid; a worlds.json beside a world tells its start.
set -eu
cd "$(dirname "$0")/../.."
bench=$(launch_scripts/build_program.sh --bench)
program=$(launch_scripts/build_program.sh)
out=${OUT:-out/strategies}
worlds=()
while [ $# -gt 0 ] && [[ $1 == *.yaml ]]; do
  worlds+=("$1")
  shift
done
mkdir -p "$out"
if [ ${#worlds[@]} -eq 0 ]; then
  for truth in maps/*.truth.csv; do worlds+=("${truth%.truth.csv}.yaml"); done
  for seed in 1 2 3 4 5; do
    "$program" generate-world random --seed "$seed" --name "random_$seed" --out "$out" --force
    worlds+=("$out/random_$seed.yaml")
  done
fi
if [ -n "${MOVED:-}" ]; then
  # shellcheck disable=SC2086  # two words
  mapfile -t worlds < <(/usr/bin/python3 benchmarks/scripts/move_worlds.py "$out" $MOVED "${worlds[@]}")
  [ ${#worlds[@]} -gt 0 ]
fi
"$bench" compare-strategies "${worlds[@]}" --out "$out" "$@"
/usr/bin/python3 benchmarks/scripts/plot_strategies.py "$out"
