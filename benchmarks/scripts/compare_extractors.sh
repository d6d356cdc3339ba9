#!/usr/bin/env bash
# Regenerates docs/comparison.md and writes the tables of all figures to out/comparison/comparison_tables.md:
# compare_extractors.sh [LOG...]
# Without logs: the one that mrpt-common installs, and CARMEN logs in $CCA_SHARED_DATA/logs.
set -eu
cd "$(dirname "$0")/../.."
./launch_scripts/install_dependencies.sh --tests
program=$(launch_scripts/build_program.sh --bench)

worlds=()
for truth in maps/*.truth.csv; do worlds+=("${truth%.truth.csv}.yaml"); done
logs=("$@")
if [ ${#logs[@]} -eq 0 ]; then
  shared=${CCA_SHARED_DATA:-../shared/data}
  for log in "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog" \
    "$shared"/logs/*.log.gz; do
    [ -f "$log" ] && logs+=("$log")
  done
fi
out=out/comparison
"$program" compare-extractors "${worlds[@]}" ${logs[@]+"${logs[@]}"} --scans 20 --polygons 60 \
  --noise 0,0.01,0.03,0.1 --out "$out"
/usr/bin/python3 benchmarks/scripts/comparison_report.py "$out" docs/comparison.md docs/images
