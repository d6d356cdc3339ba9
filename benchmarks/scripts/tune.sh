#!/usr/bin/env bash
# Regenerates docs/tuning.md: tune.sh [options of 'cca-mrpt-bench tune']
# Killed and started again with the same options it goes on where it was (out/tuning).
set -eu
cd "$(dirname "$0")/../.."
./launch_scripts/install_dependencies.sh --tests
program=$(launch_scripts/build_program.sh --bench)
worlds=()
for truth in maps/*.truth.csv; do worlds+=("${truth%.truth.csv}.yaml"); done
"$program" tune "${worlds[@]}" --out out/tuning "$@"
/usr/bin/python3 benchmarks/scripts/tuning_report.py out/tuning docs/tuning.md docs/images
