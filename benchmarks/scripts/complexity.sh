#!/usr/bin/env bash
# Measures what each step of the mapping costs, and draws it: docs/images/complexity_*.svg.
# Usage: complexity.sh [BUILD_FOLDER]
set -eu
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
cd "$(dirname "$0")/../.."
build=${1:-build}
[ -f "$build/CMakeCache.txt" ] || cmake -S . -B "$build" -DCCA_BUILD_BENCHMARKS=ON -DPYTHON_EXECUTABLE=/usr/bin/python3
for what in line_extraction line_map; do
  name=${what}_benchmark
  cmake --build "$build" --target "$name" -j"$(nproc)"
  "$build/benchmarks/$name" --benchmark_min_time=0.1 --benchmark_out="$build/$name.json" \
    --benchmark_out_format=json
  /usr/bin/python3 benchmarks/scripts/plot_complexity.py "$build/$name.json" \
    "docs/images/complexity_$what.svg"
done
