#!/usr/bin/env bash
# MRPT's own programs open what explore and map write: mrpt_programs_test.sh PROGRAM WORLD.yaml
set -u
program=$1 world=$2
command -v rawlog-edit >/dev/null && command -v icp-slam >/dev/null ||
  { echo "MRPT's programs (mrpt-apps) are not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
fail() { echo "FAILED: $1"; failed=1; }

"$program" explore "$world" --out "$work/run" --quiet >"$work/log" 2>&1 || { cat "$work/log"; fail explore; }
scans=$(rawlog-edit --info -i "$work/run/run.rawlog" 2>&1 | tee "$work/info" |
        awk -F '[:/]' '/^Sensor \(Label/ && $0 ~ /LASER/ { gsub(/ /, "", $0) } /Overall number of objects/ { print $2 / 2 }')
[ "${scans:-0}" -gt 10 ] 2>/dev/null || { cat "$work/info"; fail "rawlog-edit does not see the scans"; }
echo "rawlog-edit: $scans scans"

# icp-slam, with the configuration that MRPT installs for its own demo, without windows.
ini="$work/icp.ini"
sed -e 's/^\(SHOW_PROGRESS_3D_REAL_TIME\)[ \t]*=.*/\1=0/' -e "s|^logOutput_dir.*|logOutput_dir=$work/icp|" \
    -e 's/^SAVE_3D_SCENE.*/SAVE_3D_SCENE=0/' \
    /usr/share/mrpt/config_files/icp-slam/icp-slam_demo_classic.ini >"$ini"
timeout 200 icp-slam "$ini" "$work/run/run.rawlog" </dev/null >"$work/icp.log" 2>&1 || { tail -5 "$work/icp.log"; fail icp-slam; }
ls "$work"/icp/*.simplemap >/dev/null 2>&1 || fail "icp-slam left no simplemap"

# And the way back: what MRPT's SLAM made is a log for us.
for map in "$work"/icp/*.simplemap; do
  "$program" map "$map" --out "$work/back" --force --quiet || fail "the simplemap of icp-slam is not mapped"
done

[ $failed -eq 0 ] && echo "all passed"
exit $failed
