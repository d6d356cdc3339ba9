#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What noise costs an exploration: worlds of every kind of 'generate-world', each explored with a laser
# without noise (1 cm) and with one of 3 cm of range noise, half a degree of bearing noise and 1 %
# of dropouts, both of 20 m. A table, and how the whole ways compare, in $OUT (out/noise).
#
#   explore_in_noise.sh [options of 'cca-mrpt-bench compare-strategies']
#
# KINDS and SEEDS may be set, e.g. KINDS="random crowded" SEEDS="1 2"; else ten kinds, four seeds. Ends
# non-zero if a noisy run failed, collided, saw less than 97 %, or if noise cost more than 1.6.
set -eu
cd "$(dirname "$0")/../.."
bench=$(launch_scripts/build_program.sh --bench)
program=$(launch_scripts/build_program.sh)
out=${OUT:-out/noise}
kinds=${KINDS:-two_rooms corridor_loop maze gallery pillar_hall apartment random crowded office warehouse}
mkdir -p "$out"
worlds=()
for kind in $kinds; do
  for seed in ${SEEDS:-1 2 3 4}; do
    "$program" generate-world "$kind" --seed "$seed" --name "${kind}_$seed" --out "$out" --force >"$out/log"
    worlds+=("$out/${kind}_$seed.yaml")
  done
done
explore() { # FOLDER options
  "$bench" compare-strategies "${worlds[@]}" --strategies view_tour --starts 1 --laser.range 20 \
    --out "$out/$1" "${@:2}"
}
explore quiet "$@"
explore noisy --laser.range_noise 0.03 --laser.angle_noise_deg 0.5 --laser.dropout 0.01 "$@"

awk -F, -v OFS=' | ' '
  FNR == 1 { next }
  NR == FNR { quiet[$1] = $7; seen[$1] = $9; next }
  FNR == 2 {
    print "| world", "way without noise, m", "with noise, m", "ratio", "seen without, %", "with, %", "contacts |"
    print "|---|---|---|---|---|---|---|"
  }
  {
    ratio = $7 / quiet[$1]; n++; sum += log(ratio); contacts += $10; unfinished += !$11
    if (ratio > worst) { worst = ratio; where = $1 }
    if (least == "" || $9 < least) { least = $9; there = $1 }
    printf "| %s | %.1f | %.1f | %.2f | %.2f | %.2f | %d |\n", $1, quiet[$1], $7, ratio,
      100 * seen[$1], 100 * $9, $10
  }
  END {
    mean = exp(sum / n)
    printf "\n%d worlds: whole way with noise / without %.3f (geometric mean; %.2f at worst, %s); ",
      n, mean, worst, where
    printf "least seen %.2f %% (%s); %d contacts; %d did not end\n", 100 * least, there, contacts,
      unfinished
    exit !(mean <= 1.6 && least >= 0.97 && contacts == 0 && unfinished == 0)
  }' "$out/quiet/runs.csv" "$out/noisy/runs.csv" | tee "$out/noise.md"
exit "${PIPESTATUS[0]}"
