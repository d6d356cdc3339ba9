#!/usr/bin/env bash
# Localisation as a user gets it: localize_command_test.sh PROGRAM MAPS
set -u
program=$1
. "$(dirname "$0")/commands.sh"

# A room of 8 x 6 m with a niche and a slanted wall: like none of its turns.
python3 - <<'EOF'
rows = []
for row in range(139, -1, -1):
    y = 0.05 * (row + 0.5) - 0.5
    line = []
    for column in range(180):
        x = 0.05 * (column + 0.5) - 0.5
        free = 0 < x < 8 and 0 < y < 6 and not (x < 3 and y > 5) and x + y < 12
        line.append(254 if free else 0)
    rows.append(bytes(line))
open("room.pgm", "wb").write(b"P5\n180 140\n255\n" + b"".join(rows))
open("room.yaml", "w").write("image: room.pgm\nresolution: 0.05\norigin: [-0.5, -0.5, 0.0]\nnegate: 0\n"
                             "occupied_thresh: 0.65\nfree_thresh: 0.196\nstart: [2.5, 2.0, 40]\n")
EOF
check "a room is explored" "$program" explore room.yaml --out map --quiet

for plan in room.yaml map map/map.slam map/lines.geojson map/lines.svg map/lines.dxf map/map.yaml map/plan.dxf map/plan.svg; do
  out=in_$(echo "$plan" | tr / _)
  check "the drive is localised in $plan" "$program" localize map/run.rawlog --in $plan --out "$out"
  check "it is right in $plan" python3 - "$out" <<'EOF'
import csv, json, os, sys
out = sys.argv[1]
summary = json.load(open(out + "/summary.json"))
assert summary["localised_share"] > 0.9, summary
assert summary["lost_times"] == 0, summary
assert summary["residual_rms_m"] < 0.05, summary
rows = list(csv.DictReader(open(out + "/poses.csv")))
assert len(rows) == summary["localised"], len(rows)
assert list(rows[0]) == ["stamp", "x", "y", "theta"]
# In the world itself: the robot began at 2.5, 2.0. In a map of it: the same, to the map's own error.
assert abs(float(rows[0]["x"]) - 2.5) < 0.1 and abs(float(rows[0]["y"]) - 2.0) < 0.1, rows[0]
right = {row["stamp"]: row for row in csv.DictReader(open("in_room.yaml/poses.csv"))}
for row in rows:
    if row["stamp"] in right:
        assert all(abs(float(row[k]) - float(right[row["stamp"]][k])) < 0.1 for k in ("x", "y", "theta")), row
assert os.path.getsize(out + "/localisation.png") > 1000
assert os.path.getsize(out + "/poses.tum") > 100
EOF
done
check "it knows how far it is off" python3 - <<'EOF'
import csv, json
error = json.load(open("in_room.yaml/summary.json"))["pose_error"]
assert error["rms_m"] < 0.03 and error["max_m"] < 0.1 and error["nees"] < 9, error
rows = list(csv.DictReader(open("in_room.yaml/covariances.csv")))
assert len(rows) == json.load(open("in_room.yaml/summary.json"))["localised"]
assert all(0 < float(row["xx"]) < 0.04 and float(row["tt"]) > 0 for row in rows), rows[0]
EOF
check "a laser that sweeps explores" "$program" explore room.yaml --laser rplidar_a1 --out swept --quiet
check "its log is localised" "$program" localize swept/run.rawlog --in room.yaml --out in_swept --start 2.5,2,40
check "it is never lost" python3 - <<'EOF'
import json
summary = json.load(open("in_swept/summary.json"))
assert summary["lost_times"] == 0 and summary["localised_share"] == 1.0, summary
assert summary["pose_error"]["max_m"] < 0.1, summary
EOF
cp -r map untouched
check "with a start" "$program" localize map/run.rawlog --in room.yaml --out started --start 2.6,1.9,45 --quiet
[ ! -s last.out ] || { echo "FAILED: --quiet prints"; failed=1; }
check "the first scan is localised then" python3 -c '
import json
assert json.load(open("started/summary.json"))["localised_share"] == 1.0'
check "the plan stays as it is" diff -r map untouched
check "the same once more" "$program" localize map/run.rawlog --in room.yaml --out again
check "gives the same bytes" cmp in_room.yaml/poses.csv again/poses.csv
refuses 1 "is there already" "$program" localize map/run.rawlog --in room.yaml --out again
check "--force overwrites" "$program" localize map/run.rawlog --in room.yaml --out again --force

# A plan of another place.
echo "x1,y1,x2,y2
0,0,3,0
3,0,3,11
3,11,0,11
0,11,0,0
1,3,2,3
1,3,1,4" >other.csv
refuses 3 "was never localised in other.csv (6 lines within 3.0 x 11.0 m)" "$program" localize map/run.rawlog --in other.csv --out elsewhere
[ -s elsewhere/summary.json ] || { echo "FAILED: no summary.json of a robot that was not found"; failed=1; }

# A start that is told, from which nothing of the plan is seen, is no place that was found.
refuses 3 "was never localised in other.csv" "$program" localize map/run.rawlog --in other.csv --out far --start 500,0,0

refuses 1 "map: holds a map" "$program" localize map/run.rawlog --in map --out map --force
check "the map is what it was" diff -r map untouched
refuses 1 "nowhere.dxf: cannot be read" "$program" localize map/run.rawlog --in nowhere.dxf --out none
refuses 1 "is no plan by its name" "$program" localize map/run.rawlog --in room.pgm --out none
printf 'x1,y1,x2\n0,0,1\n' >short.csv
refuses 1 "short.csv: not a line map: no column y2" "$program" localize map/run.rawlog --in short.csv --out none
refuses 1 "room.yaml: tells its own metres" "$program" localize map/run.rawlog --in room.yaml --scale 2 --out none
printf '\200\000\377' >bytes.yaml
refuses 1 "bytes.yaml: " "$program" localize map/run.rawlog --in bytes.yaml --out none
refuses 1 "nothing.log" "$program" localize nothing.log --in room.yaml --out none
refuses 2 "--in" "$program" localize map/run.rawlog --out none
refuses 2 "--start" "$program" localize map/run.rawlog --in room.yaml --out none --start 1,2
[ ! -e none ] || { echo "FAILED: a run that was refused left a folder"; failed=1; }
check "--help" "$program" localize --help
grep -q -- "--start" last.out || { echo "FAILED: --help does not tell of --start"; failed=1; }

[ $failed -eq 0 ] && echo "localize: all as it should be"
exit $failed
