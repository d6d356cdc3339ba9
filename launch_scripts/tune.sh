#!/usr/bin/env bash
# Regenerates docs/tuning.md: tune.sh [options of 'cca-mrpt tune']
# Killed and started again with the same options it goes on where it was (build/tuning).
set -eu
cd "$(dirname "$0")/.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
./launch_scripts/install_dependencies.sh --tests
cmake -S . -B build -DPYTHON_EXECUTABLE=/usr/bin/python3 >/dev/null
cmake --build build --target cca-mrpt -j"$(nproc)"
program=$(find build -name cca-mrpt -type f -perm -u+x | head -1)
worlds=()
for truth in maps/*.truth.csv; do worlds+=("${truth%.truth.csv}.yaml"); done
"$program" tune "${worlds[@]}" --out build/tuning "$@" | tee build/tuning.txt
python3 launch_scripts/tuning_report.py build/tuning build/tuning.txt docs/tuning.md docs/images
