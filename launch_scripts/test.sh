#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test.
set -eu
cd "$(dirname "$0")/.."
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
cmake -S . -B build -DPYTHON_EXECUTABLE=/usr/bin/python3 && cmake --build build -j"$(nproc)"
exec ctest --test-dir build --output-on-failure
