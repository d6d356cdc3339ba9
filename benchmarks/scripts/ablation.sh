#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Regenerates the table of docs/ablation.md: ablation.sh [LOG...]
# Without logs: CARMEN logs in $CCA_SHARED_DATA/logs. OPTIONS are those of 'cca-mrpt-bench ablate'; by default they take some
# ten minutes with five logs.
set -eu
cd "$(dirname "$0")/../.."
program=$(launch_scripts/build_program.sh --bench)
worlds=()
for truth in maps/*.truth.csv; do worlds+=("${truth%.truth.csv}.yaml"); done
logs=("$@")
if [ ${#logs[@]} -eq 0 ]; then
  for log in "${CCA_SHARED_DATA:-../shared/data}"/logs/*.log.gz; do
    [ -f "$log" ] && logs+=("$log")
  done
fi
table=$(mktemp)
trap 'rm -f "$table"' EXIT
[ ${#logs[@]} -eq 0 ] || options=(--log "${logs[@]}")
# shellcheck disable=SC2086  # several words
"$program" ablate "${worlds[@]}" ${options[@]+"${options[@]}"} ${OPTIONS:---seeds 4 --scans 30 --poses 120 --shakes 4} | tee "$table"
sed -i -e '/<!-- begin table -->/,/<!-- end table -->/{//!d}' -e "/<!-- begin table -->/r $table" docs/ablation.md
