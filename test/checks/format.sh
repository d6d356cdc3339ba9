#!/usr/bin/env bash
# Every C++ file stands as clang-format would set it, and begins with its licence.
set -u
cd "$(dirname "$0")/../.." || exit
mapfile -t files < <(git ls-files '*.hpp' '*.cpp')
failed=0
clang-format --dry-run --Werror "${files[@]}" || failed=1
for file in "${files[@]}"; do
  head -1 "$file" | grep -qx '// SPDX-License-Identifier: BSD-3-Clause' || { echo "$file: no licence line"; failed=1; }
done
[ $failed -eq 0 ] && echo "format: clean"
exit $failed
