#!/usr/bin/env bash
# The table of docs/slam.md: poses by wheels, by MRPT's ICP and by line SLAM, against the poses that the
# logs themselves hold.   benchmarks/scripts/slam_table.sh LOG...   (CARMEN logs with corrected poses)
set -eu
[ $# -gt 0 ] || { sed -n '2,3s/^# //p' "$0"; exit 2; }
here=$(cd "$(dirname "$0")/../.." && pwd)
program=$("$here/launch_scripts/build_program.sh")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

figure() { awk -F '[:,]' -v key="\"$1\"" '$1 ~ key {gsub(/ /, "", $2); print $2; exit}' "$2"; }

printf '| log | scans | wheels, m rms | MRPT ICP-SLAM | line SLAM | loops | lines |\n|---|---|---|---|---|---|---|\n'
for log in "$@"; do
  row="| $(basename "$log" -corrected.log.gz)"
  for pose in odometry icp slam; do
    "$program" map "$log" --pose $pose --out "$work/map" --force --quiet ||
      [ $? -eq 3 ]  # wheels contradict the map that they make
    summary=$work/map/summary.json
    [ $pose != odometry ] || row="$row | $(figure scans "$summary")"
    row="$row | $(printf '%.3f' "$(figure rms_m "$summary")")"
  done
  echo "$row | $(figure loops "$summary") | $(figure map_lines "$summary") |"
done
