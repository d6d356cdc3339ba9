#!/usr/bin/env bash
# What shellcheck says of the shell scripts, by .shellcheckrc. Skipped where there is no shellcheck.
set -u
cd "$(dirname "$0")/../.." || exit
command -v shellcheck >/dev/null || { echo "scripts: SKIPPED (no shellcheck here: Debian's shellcheck)"; exit 0; }
mapfile -t scripts < <(git ls-files '*.sh' .ci/run)
shellcheck "${scripts[@]}" && echo "scripts: clean"
