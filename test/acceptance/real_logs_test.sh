#!/usr/bin/env bash
# Every 2-D laser log at hand goes through info, map, evaluate and render without a parameter set by
# hand: those that mrpt-common installs, and the five of the shared data. real_logs_test.sh PROGRAM DATA
set -u
program=$1 data=$2
mrpt=/usr/share/mrpt/datasets
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0 tried=0

# name, and the length [m] that the map must reach: half of what was found when this was written, for
# a map may get better, but must not vanish. Also the status, where it is not 0.
try() {
  local log=$1 least=$2 status=${3:-0} name
  name=$(basename "$log")
  [ -e "$log" ] || { echo "skipped, is missing: $log"; return; }
  tried=$((tried + 1))
  local out="$work/$tried"
  if "$program" info "$log" >"$work/info" 2>&1 &&
     { "$program" map "$log" --out "$out" --quiet >"$work/map" 2>&1; [ $? -eq "$status" ]; } &&
     "$program" evaluate "$out/lines.csv" --log "$log" >"$work/evaluate" 2>&1 &&
     "$program" render "$out/lines.csv" --log "$log" --size 300 --out "$out/small.png" >"$work/render" 2>&1
  then
    awk -F '[:,]' -v least="$least" -v name="$name" '/"map_length_m"/ {
      printf "%-60s %7.1f m of wall\n", name, $2; if ($2 < least) { print "FAILED: expected " least; exit 1 } }' \
      "$out/summary.json" || failed=1
  else
    echo "FAILED: $name"
    tail -n 3 "$work"/{info,map,evaluate,render} 2>/dev/null
    failed=1
    return 1
  fi
}

# The map of what was tried last is complete, clean and on the walls. One set of bounds for every log, a little beyond
# the worst (freiburg-079, whose chairs were moved): maps may become better, never worse than this.
is_on_the_walls() {
  python3 - "$1" "$work/evaluate" "$work/$tried/summary.json" <<'END'
import json, sys
score, agreement = json.load(open(sys.argv[2])), json.load(open(sys.argv[3]))["agreement"]
bounds = {
    ("summary", "f_score"): (0.94, 1), ("summary", "precision_clean_length"): (0.98, 1),
    ("summary", "recall_linear_cells_10"): (0.90, 1), ("redundancy", "redundant_frac_10"): (0, 0.02),
    ("free_space", "contradicted_frac"): (0, 0.015), ("phantom", "frac_10"): (0, 0.005), ("bias", "rms_m"): (0, 0.025),
}
wrong = [f"{group}.{key} {score[group][key]}" for (group, key), (low, high) in bounds.items()
         if not low <= score[group][key] <= high]
wrong += [f"agreement {agreement}"] if agreement <= 0.998 else []
if wrong:
    sys.exit(f"FAILED: {sys.argv[1]}: {', '.join(wrong)}")
END
}

try "$mrpt/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog" 100
try "$mrpt/localization_demo.rawlog" 20
try "$mrpt/uwb_ro-localization_demo.rawlog" 30
try "$mrpt/graphslam-engine-demos/action_observations_map/simul.rawlog" 100
try "$mrpt/graphslam-engine-demos/action_observations_map/range_030_bearing_015.rawlog" 100 3
try "$mrpt/localization_demo.simplemap.gz" 50
try "$mrpt/malaga-cs-fac-building.simplemap.gz" 50
for log in intel freiburg-079 orebro fhw seattle; do
  corrected=$data/logs/$log-corrected.log.gz
  ! try "$corrected" 50 || [ ! -e "$corrected" ] || is_on_the_walls "$log" || failed=1
done

# Raw wheels and the laser alone: the map must come home to where the log's own corrected poses have it.
# Name, and the rms [m] allowed: twice what was found when this was written.
home() {
  local log=$data/logs/$1-corrected.log.gz out=$work/slam-$1
  [ -e "$log" ] || { echo "skipped, is missing: $log"; return; }
  tried=$((tried + 1))
  "$program" map "$log" --pose slam --out "$out" --quiet || { failed=1; return; }
  awk -F '[:,]' -v most="$2" -v name="$1" '/"rms_m"/ {
    printf "%-60s %7.3f m rms by line SLAM\n", name, $2; if ($2 > most) { print "FAILED: allowed " most; exit 1 } }' \
    "$out/summary.json" || failed=1
  local scans rows
  scans=$(awk -F '[:,]' '/"scans"/ {print $2 + 0}' "$out/summary.json")
  rows=$(($(wc -l <"$out/poses.csv") - 1))
  [ "$rows" -eq "$scans" ] && [ "$(wc -l <"$out/poses.tum")" -eq "$scans" ] && grep -q '^EDGE_SE2 ' "$out/graph.g2o" ||
    { echo "FAILED: $1: poses.csv, poses.tum, graph.g2o"; failed=1; }
}
home intel .14
home fhw .27
home seattle .09

[ $tried -gt 0 ] || { echo "no log at hand"; exit 77; }
[ $failed -eq 0 ] && echo "$tried logs passed"
exit $failed
