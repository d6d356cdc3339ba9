#!/usr/bin/env bash
# The Python package as its user meets it: python/test.sh [PYTHON]
#
# Does what docs/python.md says, word for word, in a copy of the sources and an environment of its own that sees
# nothing of the system's: installs, runs the examples; then the package's tests. What was compiled is kept for the
# next time. Says so and ends well where pip can fetch no packages: the build tools are on PyPI alone.
set -eu
cd "$(dirname "$0")/.."
python=$(command -v "${1:-/usr/bin/python3}")
where=$PWD/build-python/$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
# Elsewhere, for roslaunch takes each launch file below the package for its own.
copy=$(mktemp -d)/cca_mrpt
mkdir -p "$where" "$copy"
trap 'rm -rf "$(dirname "$copy")"' EXIT
git ls-files -z --cached --others --exclude-standard | tar --null --ignore-failed-read -T - -cf - 2>/dev/null | tar -xf - -C "$copy"

export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_QUIET=1 MPLBACKEND=Agg
"$python" -m venv --clear "$where/probe"
if ! "$where/probe/bin/pip" download --timeout 10 --retries 1 --no-deps -d "$where/probe" nanobind 2>"$where/pip.log"; then
  cat "$where/pip.log"
  echo "python: SKIPPED (pip cannot fetch what builds the package)"
  exit 0
fi

# Hardly optimised: compiling takes most of the time here, and the C++ tests see what is optimised.
export SKBUILD_BUILD_DIR=$where/build SKBUILD_CMAKE_BUILD_TYPE=None CXXFLAGS=-O1 CMAKE_BUILD_PARALLEL_LEVEL
CMAKE_BUILD_PARALLEL_LEVEL=$(nproc)
export SKBUILD_CMAKE_DEFINE="CCA_WARNINGS_AS_ERRORS=${CI:+ON}"
PATH="$(dirname "$python"):$PATH" "$python" python/run_page.py docs/python.md "$copy" install

# The package's commands come first, then the programs, where they were built before.
export PATH="$copy/venv/bin:$PWD/build/devel/lib/cca_mrpt:$PWD/build/src/apps:$PWD/build/benchmarks:$PATH"
pip install pytest pytest-xdist mypy ruff distributed gymnasium rosbags mcap
mkdir "$where/examples" 2>/dev/null || rm -rf "$where"/examples/*
python python/tests/room_log.py "$where/examples/intel.log.gz"
python python/run_page.py docs/python.md "$where/examples" examples
python python/run_page.py docs/python_batch.md "$where/examples" examples
ruff check --no-cache python test benchmarks launch_scripts
python -m pytest -q -n "$(nproc)" -p no:cacheprovider python/tests
