#!/usr/bin/env bash
# `cca-mrpt explore` and `generate-world` as a user runs them: the folder, equal bytes for equal
# seeds, clear errors with their exit status, Ctrl-C.
#   explore_command_test.sh CCA_MRPT_PROGRAM MAPS_FOLDER
set -u
program=$(realpath "$1") maps=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit
failures=0

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

expect_error() {  # expect_error STATUS PART_OF_THE_MESSAGE ARGUMENTS...
  local status=$1 part=$2 said
  shift 2
  said=$("$program" "$@" 2>&1)
  local got=$?
  [ $got -eq "$status" ] || fail "status $got instead of $status: $*"
  case "$said" in *"$part"*) ;; *) fail "'$part' is not said by: $* (said: $said)" ;; esac
}

# The folder holds every file, and stdout names picture and map.
said=$("$program" explore "$maps/two_rooms.yaml" --seed 7 --out a) || fail "two_rooms: status $?"
for file in lines.csv lines.geojson lines.svg map.png map.pgm map.yaml scene.3Dscene summary.json \
  trajectory.csv poses.csv run.rawlog coverage.csv replay.html graph.g2o map.slam; do
  [ -s "a/$file" ] || fail "a/$file is missing or empty"
done
case "$said" in *a/map.png*a/lines.csv*) ;; *) fail "picture and map are not named: $said" ;; esac
[ "$(head -n 1 a/trajectory.csv)" = t,x,y,theta ] || fail "header of trajectory.csv"
[ "$(head -n 1 a/poses.csv)" = stamp,x,y,theta ] || fail "header of poses.csv"
[ "$(head -n 1 a/coverage.csv)" = t,distance,coverage ] || fail "header of coverage.csv"
for key in finished reason distance_m duration_s wall_s coverage goals collisions map_lines \
  scan_us_median scan_us_p99; do
  grep -q "\"$key\":" a/summary.json || fail "summary.json lacks $key"
done

# Same seed, same bytes, wall-time figures aside.
"$program" explore "$maps/two_rooms.yaml" --seed 7 --out b --quiet || fail "second run: status $?"
sed -i -E '/"(wall_s|scan_us_median|scan_us_p99)"/d' a/summary.json b/summary.json
diff -rq a b || fail "equal seeds gave unequal files"

# --explain tells each decision and changes none: the goals are candidates, of most score or least cost.
"$program" explore "$maps/two_rooms.yaml" --seed 7 --out explained --quiet --explain c.jsonl || fail "--explain: status $?"
sed -i -E '/"(wall_s|scan_us_median|scan_us_p99)"/d' explained/summary.json
diff -rq a explained || fail "--explain changed the run"
/usr/bin/python3 - c.jsonl explained/summary.json <<'CHECK' || fail "--explain: c.jsonl"
import json, math, sys
lines = [json.loads(line) for line in open(sys.argv[1])]
summary = json.load(open(sys.argv[2]))
*driven, last = lines
assert len(driven) >= summary["goals"], (len(driven), summary["goals"])
assert last["rule"] == "none" and last["chosen"] is None and last["reason"] == summary["reason"], last
assert {line["rule"] for line in driven} <= {"score", "in_passing"}
for line in driven:
    candidates, chosen = line["candidates"], line["candidates"][line["chosen"]]
    assert line["reason"].startswith("%.2f m^2 behind" % chosen["promise_m2"]), line
    assert len(candidates) <= 12 and all(c["promise_m2"] > 0 for c in candidates)
    for c in candidates:
        assert math.hypot(c["x_m"] - line["x_m"], c["y_m"] - line["y_m"]) <= c["way_m"] + 0.3, (line, c)
    assert all(abs(c["score"] - c["promise_m2"] * math.exp(-0.2 * c["way_m"])) < 2e-3 for c in candidates)
    if line["rule"] == "score":
        assert chosen["score"] == max(c["score"] for c in candidates), line
assert [line["time_s"] for line in lines] == sorted(line["time_s"] for line in lines)
CHECK
expect_error 1 "c.jsonl: is there already" explore "$maps/two_rooms.yaml" --out none --explain c.jsonl
expect_error 1 "nowhere/d.jsonl: cannot be written" explore "$maps/two_rooms.yaml" --out none --explain nowhere/d.jsonl
cp "$maps/two_rooms.yaml" "$maps/two_rooms.png" .
expect_error 1 "two_rooms.yaml: is named twice" explore two_rooms.yaml --out none --explain two_rooms.yaml --force
cmp -s two_rooms.yaml "$maps/two_rooms.yaml" || fail "--explain wrote over the world"

# A map made in an explored folder holds nothing of the drive; its scans stay.
"$program" map a/run.rawlog --out mapped --quiet && cp -r a over || fail "map run.rawlog: status $?"
"$program" map a/run.rawlog --out over --force --quiet || fail "map over an exploration: status $?"
rm over/run.rawlog over/run_GT.txt || fail "map removed the scans"
[ "$(ls over)" = "$(ls mapped)" ] || fail "the map holds files of the drive: $(ls over)"

# A world of ours is judged by its name, too.
"$program" evaluate a/lines.csv --world two_rooms >by_name.json || fail "evaluate --world two_rooms: status $?"
"$program" evaluate a/lines.csv --world "$maps/two_rooms.yaml" | cmp - by_name.json || fail "the world by its name is another"
expect_error 1 "two_roms: is no file, and no world of ours" evaluate a/lines.csv --world two_roms

# A page is made anew from what it holds; two runs stand in one.
"$program" render a --html --out again.html || fail "render --html: status $?"
cmp again.html a/replay.html || fail "render --html gave another page"
"$program" render a --html --beside b --out both.html || fail "render --html --beside: status $?"
[ "$(grep -c 'class="run"' both.html)" -eq 2 ] || fail "both.html does not hold two runs"
expect_error 1 "lines.csv: holds no run" render a/lines.csv --html --out no.html
[ ! -e no.html ] || fail "a page without a run was left"

# On wheels and laser: a loop is closed, the map is made anew, all of it is seen and nothing touched. (Wheels and a laser
# that err much: else the loop often moves nothing by the 5 cm that the map is made anew for.)
for folder in wheels again; do
  "$program" explore "$maps/corridor_loop.yaml" --seed 3 --laser rplidar_a1 --odometry.turn_noise_deg 5 \
    --exploration.return_to_start true --out $folder --quiet || fail "on wheels: status $?"
  sed -i -E '/"(wall_s|scan_us_median|scan_us_p99)"/d' $folder/summary.json
done
diff -rq wheels again || fail "on wheels: equal seeds gave unequal files"
awk -F'[:,]' '{ gsub(/[ "]/, ""); of[$1] = $2 }
  END { exit !(of["pose"] == "slam" && of["collisions"] == 0 && of["coverage"] >= 0.99 && of["corrections"] >= 1 &&
               of["pose_error_rms_m"] > 0 && of["pose_error_rms_m"] <= 0.05 && of["pose_error_worst_m"] <= 0.2) }' \
  wheels/summary.json || fail "on wheels: $(cat wheels/summary.json)"
[ "$(wc -l <wheels/poses.csv)" -eq $((1 + $(sed -n 's/^ *"scans": \([0-9]*\),/\1/p' wheels/summary.json))) ] ||
  fail "on wheels: not a pose for each scan"

# Broken off, and gone on with from elsewhere; two maps become one; another place is none of these.
"$program" explore "$maps/apartment.yaml" --run.longest_time 60 --out part --quiet 2>part.txt &&
  fail "a run that was broken off ended with status 0"
"$program" explore "$maps/apartment.yaml" --start 20,15,90 --resume part --run.longest_time 90 --out rest --quiet 2>rest.txt
grep -q '"found_in_memory": true' rest/summary.json || fail "--resume did not find itself: $(cat rest.txt)"
"$program" merge part rest --out both --quiet || fail "merge: status $?"
for file in lines.csv map.png map.slam summary.json; do
  [ -s "both/$file" ] || fail "both/$file is missing or empty"
done
"$program" explore "$maps/two_rooms.yaml" --resume part --out elsewhere --quiet 2>elsewhere.txt || fail "--resume: status $?"
grep -q "no place of part was found" elsewhere.txt || fail "another place was not told: $(cat elsewhere.txt)"
grep -q '"found_in_memory": false' elsewhere/summary.json || fail "another place is in summary.json"
cp -r part grown
"$program" explore "$maps/two_rooms.yaml" --resume grown --out grown --force --quiet 2>grown.txt || fail "--resume: status $?"
cmp -s part/map.slam grown/earlier.slam || fail "the map that no place was found of is gone: $(cat grown.txt)"
expect_error 1 "no place of it was found" merge part a --out none
[ ! -e none ] || fail "merge left a folder without a map"
expect_error 1 "map.slam: is not there" merge part "$maps" --out none
expect_error 2 "pose slam" explore "$maps/two_rooms.yaml" --resume part --pose truth --out d
cp part/map.slam whole.slam && head -c 1000 whole.slam >map.slam
expect_error 1 "map.slam: is damaged" explore "$maps/two_rooms.yaml" --resume . --out d
rm map.slam

# A room that is seen through a gap: of 40 cm, no way for a robot of 50 cm; of 50 cm, one that its own radius admits and
# that is too narrow with the margin: done, and another status.
draw_gap() {  # draw_gap FIRST_ROW LAST_ROW
  python3 - "$1" "$2" <<'END'
import sys
rows = [[0 if x in (0, 59, 119) or y in (0, 59) else 254 for x in range(120)] for y in range(60)]
for y in range(int(sys.argv[1]), int(sys.argv[2]) + 1):
    rows[y][59] = 254
print("P2 120 60 255", *(" ".join(map(str, row)) for row in rows), sep="\n")
END
}
draw_gap 26 33 >gap.pgm
draw_gap 25 34 >wide.pgm
cat >gap.yaml <<'END'
image: gap.pgm
resolution: 0.05
origin: [0, 0, 0]
occupied_thresh: 0.65
free_thresh: 0.196
start: [1.5, 1.5, 0]
END
"$program" explore gap.yaml --out gap --quiet || fail "a room that no robot gets into: status $?"
grep -q '"may_be_passable": false' gap/summary.json || fail "the room that was not reached is not named"
sed 's/gap/wide/' gap.yaml >wide.yaml
expect_error 3 "m^2 in view that the robot may fit through to; the map is in wide" explore wide.yaml --out wide --quiet
grep -q '"may_be_passable": true' wide/summary.json || fail "the passage that its radius admits is not named"
grep -q '"finished": true' wide/summary.json && [ -s wide/lines.csv ] || fail "the map of what was reached is not there"

# A corridor in which it cannot keep the margin that it is told: it gives up, which is not done.
python3 - >tight.pgm <<'END'
rows = [[254 if 0 < x < 99 and 2 < y < 14 else 0 for x in range(100)] for y in range(17)]
print("P2 100 17 255", *(" ".join(map(str, row)) for row in rows), sep="\n")
END
sed 's/gap/tight/; s/^start.*/start: [1.5, 0.425, 0]/' gap.yaml >tight.yaml
expect_error 3 "nothing around it is known to be free" explore tight.yaml --robot.safety_margin 0.1 --out tight --quiet
# A laser that reaches no wall: in a simulation nothing will come back later.
expect_error 1 "the laser's beams have told nothing for 60 s" explore gap.yaml --laser-range 0.6 --out blind --quiet
# On bad wheels alone the pose is lost.
expect_error 3 "scans contradict the map" explore "$maps/two_rooms.yaml" --seed 5 --pose odometry \
  --odometry.turn_noise_deg 15 --out lost --quiet
grep -q '"agreement": 0.9' lost/summary.json || fail "summary.json does not say how far scans and map agree"

# Nothing is overwritten unasked; without --out each run has a folder of its own.
expect_error 1 "summary.json" explore "$maps/two_rooms.yaml" --out b
"$program" explore "$maps/two_rooms.yaml" --out b --force --quiet || fail "--force: status $?"
"$program" explore "$maps/two_rooms.yaml" --quiet && "$program" explore "$maps/two_rooms.yaml" --quiet
[ -s out/two_rooms-001/map.png ] && [ -s out/two_rooms-002/map.png ] || fail "numbered folders"

# No progress where there is no terminal, nothing at all when quiet.
said=$("$program" explore "$maps/two_rooms.yaml" --out c --quiet 2>&1)
[ -z "$said" ] || fail "--quiet said: $said"

# What is not right is told before any work, and leaves no folder behind.
printf 'image: gone.png\nresolution: 0.05\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n' >gone.yaml
expect_error 1 "gone.yaml: image:" explore gone.yaml --out d
expect_error 1 "nowhere.yaml: cannot be read" explore nowhere.yaml --out d
expect_error 1 "offcie: is no file, and no world of ours: apartment " explore offcie --out d
expect_error 1 "touches an obstacle" explore "$maps/two_rooms.yaml" --start 5,1,0 --out d
expect_error 1 "outside the world" explore "$maps/two_rooms.yaml" --start=-5,1,0 --out d
expect_error 1 "outside the world" explore "$maps/two_rooms.yaml" --start=1e6,1,0 --out d
expect_error 1 "nothing beyond the robot's radius" explore "$maps/two_rooms.yaml" --laser-range 0.2 --out d
expect_error 2 "start" explore "$maps/two_rooms.yaml" --start=nan,1,0 --out d
expect_error 2 "beams" explore "$maps/two_rooms.yaml" --laser.beams 1 --out d
expect_error 2 "explroe is no command" explroe "$maps/two_rooms.yaml"
expect_error 2 "--laser: its value is missing before --out" explore "$maps/two_rooms.yaml" --laser --out d
expect_error 2 "strategy" explore "$maps/two_rooms.yaml" --strategy clairvoyance --out d
expect_error 2 "excludes" explore "$maps/two_rooms.yaml" --seed 1 --run.seed 2 --out d
expect_error 2 "laser-range" explore "$maps/two_rooms.yaml" --laser-range -3 --out d
expect_error 2 "pose" explore "$maps/two_rooms.yaml" --pose guess --out d
unset DISPLAY
expect_error 1 "no display" explore "$maps/two_rooms.yaml" --gui --out d
printf '[laser]\nrnage = 4\n' >typo.ini
expect_error 2 "rnage" explore "$maps/two_rooms.yaml" --config typo.ini --out d
printf 'movers:\n  - {start: [2, 2], speed: 50}\n' >fast.yaml
expect_error 1 "movers[0]: speed" explore "$maps/two_rooms.yaml" --movers fast.yaml --out d
touch two.yaml
expect_error 2 "castle" generate-world castle
[ ! -e d ] || fail "a run that never began left a folder"

# A disk that is full (here: no file may grow beyond so many blocks) leaves whole files or none.
for blocks in 4 64 120; do
  said=$(ulimit -f $blocks; "$program" explore "$maps/two_rooms.yaml" --seed 7 --out full --force 2>&1)
  [ $? -eq 1 ] || fail "no file beyond $blocks blocks: not status 1"
  case "$said" in *"cca-mrpt: full/"*": cannot be written"*) ;; *) fail "a full disk was not told: $said" ;; esac
  for file in full/* full/.[!.]*; do
    [ ! -e "$file" ] || cmp "$file" "a/${file#full/}" || fail "$file is half written"
  done
done

# Ctrl-C keeps what was mapped, and tells so.
"$program" explore "$maps/office.yaml" --out e >/dev/null 2>e.txt &
while [ -z "$(ls -A e 2>/dev/null)" ] && kill -0 $!; do sleep 0.1; done
sleep 1
kill -INT $!
wait $!
[ $? -eq 1 ] || fail "an interrupted run did not end with status 1"
grep -q '"finished": false' e/summary.json || fail "an interrupted run left no summary"
grep -q interrupted e.txt || fail "an interrupted run did not tell so: $(cat e.txt)"

# So it does in a hall whose true coverage takes minutes to work out, and at once.
{ printf 'P5\n2400 2400\n255\n'; head -c 5760000 /dev/zero | tr '\0' '\376'; } >hall.pgm
printf 'image: hall.pgm\nresolution: 0.05\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\nstart: [60, 60, 0]\n' >hall.yaml
"$program" explore hall.yaml --laser-range 30 --out hall >/dev/null 2>hall.txt &
while [ -z "$(ls -A hall 2>/dev/null)" ] && kill -0 $!; do sleep 0.1; done
sleep 1
begin=$SECONDS
kill -TERM $!
wait $!
[ $? -eq 1 ] || fail "an interrupted run in a hall did not end with status 1"
[ $((SECONDS - begin)) -le 20 ] || fail "an interrupted run in a hall took $((SECONDS - begin)) s to be saved"
grep -q '"coverage": null' hall/summary.json && [ -s hall/lines.csv ] || fail "the hall's map was not saved"

# Far from the origin all is as it is near it: the same run, with other numbers.
for far in 4000 10000000; do
  sed "s/^origin:.*/origin: [$far, -$far, 0.0]/; s/^image: */&/" "$maps/two_rooms.yaml" >two_rooms.yaml
  cp "$maps/two_rooms.png" .
  start=$(awk -F'[][, ]+' '/^start:/ {printf "%.3f,%.3f,%g", $2 + f, $3 - f, $4}' f=$far "$maps/two_rooms.yaml")
  sed -i '/^start:/d' two_rooms.yaml
  "$program" explore two_rooms.yaml --seed 7 ${start:+--start="$start"} --out far_$far --quiet || fail "origin $far: status $?"
  grep -q '"finished": true' far_$far/summary.json || fail "origin $far: not finished"
  python3 - a/lines.csv far_$far/lines.csv $far <<'END' || fail "origin $far: other lines"
import csv, sys
near, far = ([[float(r[k]) for k in ("x1", "y1", "x2", "y2")] for r in csv.DictReader(open(p))] for p in sys.argv[1:3])
shift = float(sys.argv[3])
assert len(near) == len(far) > 5, (len(near), len(far))
for a, b in zip(near, far):
    moved = (b[0] - shift, b[1] + shift, b[2] - shift, b[3] + shift)
    assert max(abs(p - q) for p, q in zip(a, moved)) < 0.02, (a, moved)
END
done

# One of ours by its name; what is too little to explore with; who it was.
"$program" explore two_rooms --seed 7 --out named --quiet || fail "a world by its name: status $?"
cmp named/lines.csv a/lines.csv || fail "a world by its name is another"
expect_error 2 "a beam every 5 deg" explore two_rooms --laser.beams 2 --out d
expect_error 2 "90 deg at least" explore two_rooms --laser.field_of_view_deg 85 --out d
case "$("$program" --version)" in "cca-mrpt "[0-9]*.[0-9]*.[0-9]*) ;; *) fail "--version" ;; esac
python3 - <<'END' || fail "summary.json does not tell how the run was made"
import json
s = json.load(open("named/summary.json"))
p = s["parameters"]
assert s["program"].startswith("cca-mrpt ") and p["run"]["seed"] == 7 and p["run"]["pose"] == "slam"
assert p["exploration"]["strategy"] == "view_tour" and p["laser"]["beams"] == 450 and p["robot"]["radius"] > 0
END

# generate-world gives the shipped bytes, and overwrites nothing unasked.
"$program" generate-world maze --out worlds >/dev/null || fail "generate-world"
for extension in yaml png truth.csv; do
  cmp "worlds/maze.$extension" "$maps/maze.$extension" || fail "maze.$extension differs"
done
expect_error 1 "exists" generate-world maze --out worlds

expect_error 1 "two.yaml/maze: cannot be made a folder" generate-world maze --out two.yaml/maze
expect_error 2 "a whole number in [0, 2147483647]" generate-world maze --seed -1
expect_error 1 "name of a world" generate-world maze --out worlds --name ../elsewhere

[ $failures -eq 0 ] && echo "all is well"
exit $((failures > 0))
