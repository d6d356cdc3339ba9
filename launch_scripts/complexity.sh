#!/usr/bin/env bash
# Measures what each step of the mapping costs, and draws it: docs/images/complexity_*.svg.
# Usage: complexity.sh [BUILD_FOLDER]
set -eu
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
cd "$(dirname "$0")/.."
build=${1:-build}
[ -f "$build/CMakeCache.txt" ] || cmake -S . -B "$build" -DPYTHON_EXECUTABLE=/usr/bin/python3
for benchmark in test/benchmark/*_benchmark.cpp; do
  name=$(basename "$benchmark" .cpp)
  cmake --build "$build" --target "$name" -j"$(nproc)"
  "$build/test/benchmark/$name" --benchmark_min_time=0.1 --benchmark_out="$build/$name.json" \
    --benchmark_out_format=json
  /usr/bin/python3 launch_scripts/plot_complexity.py "$build/$name.json" \
    "docs/images/complexity_${name%_benchmark}.svg"
done
