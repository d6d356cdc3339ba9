#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bare_workspace.sh FOLDER: 'catkin_make', as docs/ros.md has it, configures on a machine that has no more than
# 'install_dependencies.sh --ros' installs: in a mount namespace, from which the files of the other packages are taken.
# Status 77 where this machine allows no such namespace.
set -eu
sources=$(realpath "$(dirname "$0")/../..")
folder=$1

fail() { echo "$*" >&2; exit 1; }

if [ "${2:-}" != hidden ]; then
  unshare --map-root-user --mount true 2>/dev/null || { echo "no mount namespace here"; exit 77; }
  exec unshare --map-root-user --mount "$0" "$folder" hidden
fi

# What the lists of the script name, by its own words.
eval "$(sed -n '/^packages=/,/^case/p' "$sources/launch_scripts/install_dependencies.sh" | sed '$d')"
with_depends() {
  apt-cache depends --recurse --no-recommends --no-suggests --no-conflicts --no-breaks --no-replaces --no-enhances "$@" |
    sed -n 's/^\([a-z0-9][^ :]*\).*/\1/p' | sort -u
}
# What every machine has counts as needed, too.
# shellcheck disable=SC2046,SC2086,SC2154  # lists, of the script that is read above
needed=$(with_depends $packages $ros $(dpkg-query -W -f '${Package} ${Priority}\n' | sed -n 's/ \(required\|important\)$//p'))
# shellcheck disable=SC2086,SC2154
surplus=$(comm -23 <(with_depends $tests) <(printf '%s\n' "$needed"))
layer=$(mktemp -d)
mount -t tmpfs tmpfs "$layer"
mkdir "$layer/upper" "$layer/work"
mount -t overlay -o "lowerdir=/usr,upperdir=$layer/upper,workdir=$layer/work" overlay /usr 2>/dev/null ||
  { echo "no overlay file system here"; exit 77; }
# shellcheck disable=SC2086
removed=$(dpkg -L $surplus 2>/dev/null | grep '^/usr/\(include\|lib\|share\|src\)/' | sort -u |
  while read -r file; do [ -d "$file" ] || [ ! -e "$file" ] || { rm -f "$file"; echo .; }; done | wc -l)
echo "without $removed files of $(wc -w <<<"$surplus") packages"

rm -rf "$folder"
mkdir -p "$folder/src" "$folder/first"
ln -s "$sources" "$folder/src/cca_mrpt"
# A Python that knows none of the system's packages, as pyenv's and conda's, first in PATH.
printf '#!/bin/sh\nexec /usr/bin/python3 -S "$@"\n' >"$folder/first/python3"
chmod +x "$folder/first/python3"
ln -s python3 "$folder/first/python"
export PATH=$folder/first:/usr/bin:/bin HOME=$folder
unset PYTHONPATH CMAKE_PREFIX_PATH ROS_PACKAGE_PATH
cd "$folder"

# The target 'help' builds nothing: it is there once all is configured.
page=$(sed -n 's/.*`\(PATH=[^`]* catkin_make\)`.*/\1/p' "$sources/docs/ros.md")
[ -n "$page" ] || fail "docs/ros.md names no command for where another Python stands first in PATH"
eval "$page help" >configured.log 2>&1 || { cat configured.log; fail "$page: does not configure"; }
grep -q 'cca_mrpt_generate_messages' configured.log || fail "the messages are not built"
grep -q 'without the ROS 1 nodes' configured.log && fail "the nodes are not built"
if [ "$removed" -gt 0 ]; then
  [ "$(grep -c 'cca_mrpt: without the tests: ' configured.log)" = 1 ] || fail "it is not said that there are no tests"
fi

# Who asks for the tests is not left without.
if eval "$page -DCCA_BUILD_TESTS=ON help" >refused.log 2>&1; then fail "CCA_BUILD_TESTS=ON was passed over"; fi
grep -q 'but without the tests: they need GoogleTest' refused.log || { cat refused.log; fail "no word of what is missing"; }
rm -rf "$folder"
