#!/usr/bin/env bash
# Builds the Python package in an environment of its own and runs its tests: python/test.sh [PYTHON]
# Says so and ends well where pip can fetch no packages: the build tools are on PyPI alone.
set -eu
cd "$(dirname "$0")/.."
python=${1:-/usr/bin/python3}
where=build-python/$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
pip="$where/venv/bin/pip --disable-pip-version-check -q"

[ -x "$where/venv/bin/pip" ] || "$python" -m venv --system-site-packages "$where/venv"
if ! $pip install --timeout 10 --retries 1 'scikit-build-core>=0.10' 'nanobind>=2.4' 'pytest>=7' 'distributed>=2021.9' 'gymnasium>=0.29' numpy 2>"$where/pip.log"; then
  cat "$where/pip.log"
  echo "python: SKIPPED (pip cannot fetch what builds the package)"
  exit 0
fi
# Hardly optimised: compiling takes most of the time here, and the C++ tests see what is optimised.
CMAKE_BUILD_PARALLEL_LEVEL=$(nproc) $pip install --no-build-isolation --no-deps --force-reinstall \
  --config-settings=build-dir="$where/build" \
  --config-settings=cmake.build-type=None \
  --config-settings=cmake.define.CMAKE_CXX_FLAGS=-O1 \
  --config-settings=cmake.define.CMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" \
  --config-settings=cmake.define.CCA_WARNINGS_AS_ERRORS="${CI:+ON}" .
# What runs the program itself needs one that was built before.
PATH="$PWD/build/devel/lib/cca_mrpt:$PWD/build/src/apps:$PATH" "$where/venv/bin/python" -m pytest -q -p no:cacheprovider python/tests
