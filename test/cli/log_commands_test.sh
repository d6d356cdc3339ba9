#!/usr/bin/env bash
# info, map, extract and render as a user runs them: log_commands_test.sh PROGRAM
set -u
program=$1
. "$(dirname "$0")/commands.sh"

# A robot drives along x in a room of 12 m x 6 m; a SICK of 181 beams without noise.
room_log() {
  awk 'BEGIN {
    pi = atan2(0, -1); print "# CARMEN Logfile"
    for (k = 0; k < 40; k++) {
      x = -4 + 0.2 * k; printf "FLASER 181"
      for (b = 0; b <= 180; b++) {
        a = (b - 90) * pi / 180; c = cos(a); s = sin(a)
        r = 1e9; if (c > 1e-9) r = (6 - x) / c
        if (s > 1e-9 && 3 / s < r) r = 3 / s; if (s < -1e-9 && -3 / s < r) r = -3 / s
        printf " %.3f", r
      }
      printf " %.3f 0 0 %.3f 0 0 %.2f host %.2f\n", x, x, 0.1 * k, 0.1 * k
    }
  }'
}
room_log >room.log
gzip -c room.log >room.log.gz

check "info reads a log" "$program" info room.log
grep -q '^scans *40$' last.out || { echo "FAILED: info does not count 40 scans"; failed=1; }
check "info as JSON" "$program" info --json room.log.gz
cp last.out info.json
check "its JSON is valid" python3 -c 'import json; i = json.load(open("info.json")); assert i["scans"] == 40 and i["warnings"] == []'

check "map makes a map" "$program" map room.log.gz --out map
for file in lines.csv arcs.csv lines.geojson lines.svg lines.dxf map.png map.pgm map.yaml map.gridmap.gz \
            map.linemap.gz scene.3Dscene poses.csv poses.tum graph.g2o map.slam replay.html summary.json \
            plan.geojson plan.svg plan.dxf plan.pdf rooms.csv rooms.png; do
  [ -s "map/$file" ] || { echo "FAILED: no map/$file"; failed=1; }
done
[ "$(ls -A map | wc -l)" -eq 23 ] || { echo "FAILED: map holds more than its files"; failed=1; }
check "three walls of 12, 12 and 6 m are found" python3 - <<'END'
import csv, math
walls = [tuple(float(r[k]) for k in ("x1", "y1", "x2", "y2")) for r in csv.DictReader(open("map/lines.csv"))]
length = lambda w: math.hypot(w[2] - w[0], w[3] - w[1])
total = sum(length(w) for w in walls)
# Behind the first scan's bearing of -90 degrees nothing is seen: 10 + 10 + 6 m.
assert 25.0 < total < 27.0, total
for w in walls:
    on = all(abs(abs(y) - 3) < 0.02 for y in w[1::2]) or all(abs(x - 6) < 0.02 for x in w[0::2])
    assert on, w
END
refuses 1 "is there already" "$program" map room.log --out map
check "--force overwrites" "$program" map room.log --out map --force
cp -r map mixed && rm mixed/rooms.csv && mkdir mixed/rooms.csv
refuses 1 "rooms.csv: is a folder" "$program" map room.log --out mixed --pose odometry --force
check "and left the map that is there" cmp mixed/lines.csv map/lines.csv
check "its summary, too" cmp mixed/summary.json map/summary.json
check "the same log gives the same bytes" "$program" map room.log.gz --out again --quiet
for file in lines.csv arcs.csv lines.geojson lines.svg lines.dxf map.pgm map.png; do
  cmp -s "map/$file" "again/$file" || [ $file = map.png ] || { echo "FAILED: $file differs"; failed=1; }
done

if command -v ogrinfo >/dev/null; then
  check "GDAL reads the GeoJSON" ogrinfo -so -al map/lines.geojson
  grep -q 'covariance' last.out || { echo "FAILED: no covariance in the GeoJSON"; failed=1; }
  check "GDAL reads the DXF" ogrinfo -so -al map/lines.dxf
  grep -q 'Feature Count: [1-9]' last.out || { echo "FAILED: an empty DXF"; failed=1; }
else
  echo "ogrinfo is not installed: GeoJSON and DXF were not read back by GDAL"
fi

check "poses by odometry" "$program" map room.log --pose odometry --out odometry
grep -q '"pose": "slam"' map/summary.json || { echo "FAILED: raw odometry is not mapped by SLAM"; failed=1; }
# Wheels that err by a hundredth: then the laser's pose is somebody's correction, and others are told apart from it.
awk '/^FLASER/ { $187 *= 1.01 } { print }' room.log >corrected.log
check "a corrected log" "$program" map corrected.log --out corrected
grep -q '"pose": "log"' corrected/summary.json || { echo "FAILED: corrected poses are not taken"; failed=1; }
check "poses by ICP" "$program" map corrected.log --pose icp --out icp
grep -q pose_error icp/summary.json || { echo "FAILED: no pose error told"; failed=1; }
# The robot turned by 2 degrees a step more than the log says: the walls turn with it.
awk '/^FLASER/ { $185 -= 0.035 * n++ } { print }' room.log >turning.log
refuses 3 "scans contradict the map" "$program" map turning.log --pose log --out turning --quiet
[ -s turning/lines.csv ] || { echo "FAILED: the map of wrong poses is not there to be looked at"; failed=1; }
grep -q '"agreement": 1' map/summary.json || { echo "FAILED: the map does not say that scans agree"; failed=1; }
refuses 1 "holds no true poses" "$program" map room.log --pose truth --out truth
[ ! -e truth ] || { echo "FAILED: a folder was left for poses that the log lacks"; failed=1; }
refuses 2 "pose" "$program" map room.log --pose gps --out gps

# The same place once more: in one go, and with the map of the first time.
check "a second log, begun anywhere" "$program" map room.log room.log --out two
grep -q '"scans": 80' two/summary.json || { echo "FAILED: not the scans of both logs"; failed=1; }
check "a log after an earlier map" "$program" map room.log --resume map --out resumed
grep -q '"found_in_memory": true' resumed/summary.json || { echo "FAILED: the robot has not found itself"; failed=1; }
refuses 1 "joined by --pose slam" "$program" map room.log room.log --pose odometry --out none
refuses 1 "map.slam: is not there" "$program" map room.log --resume odometry --out none
[ ! -e none ] || { echo "FAILED: a folder was left without a map"; failed=1; }

mkdir -p taken/lines.csv
refuses 1 "lines.csv: is a folder" "$program" map room.log --out taken

check "extract writes segments" "$program" extract room.log --out lines.csv
refuses 1 "is there already" "$program" extract room.log --out lines.csv
check "extract overwrites where it may" "$program" extract room.log --out lines.csv --force
refuses 1 "lines of single scans" "$program" evaluate lines.csv --log room.log
check "evaluate writes figures" "$program" evaluate map/lines.csv --log room.log --out figures.json
refuses 1 "is there already" "$program" evaluate map/lines.csv --log room.log --out figures.json
check "evaluate overwrites where it may" "$program" evaluate map/lines.csv --log room.log --out figures.json --force
head -1 lines.csv | grep -q '^scan_id,x1,y1,x2,y2' || { echo "FAILED: header of extract"; failed=1; }

check "render draws a map over its scans" "$program" render map/lines.csv --log room.log --out a.png --size 500
cp a.png drawn.png
refuses 1 "a.png: is there already" "$program" render map/lines.csv --out a.png
check "and left it" cmp a.png drawn.png
check "render --force overwrites" "$program" render map/lines.csv --log room.log --out a.png --size 500 --force
check "render draws a part" "$program" render map/lines.csv --view 0,0,3,2 --out b.png --size 300
check "render draws it solid" "$program" render map/lines.csv --3d --out c.png --size 400
check "render draws a part solid" "$program" render map/lines.csv --3d --view 0,0,3,2 --out part.png --size 400
check "render draws it solid without the way" "$program" render map/lines.csv --3d --no-trajectory --out bare.png --size 400
for picture in part.png bare.png; do
  ! cmp -s c.png $picture || { echo "FAILED: --3d does not heed what $picture asks for"; failed=1; }
done
check "they are pictures" python3 - <<'END'
import struct
for name, size in (("a.png", 500), ("b.png", 300), ("c.png", 400)):
    with open(name, "rb") as f:
        head = f.read(24)
    assert head[:8] == b"\x89PNG\r\n\x1a\n", name
    assert struct.unpack(">I", head[16:20])[0] == size, name
END
check "render tints the rooms of a map with a grid" "$program" render map/lines.csv --no-caption --out rooms.png --size 300
check "the floor is tinted" python3 - <<'END'
import struct, zlib
data, at, packed = open("rooms.png", "rb").read(), 8, b""
while at < len(data):
    (length,), kind = struct.unpack(">I", data[at:at + 4]), data[at + 4:at + 8]
    body, at = data[at + 8:at + 8 + length], at + 12 + length
    if kind == b"IHDR":
        width, height, depth, colours = struct.unpack(">IIBB", body[:10])
    packed += body if kind == b"IDAT" else b""
assert depth == 8 and colours in (2, 6)
n, raw, row, tinted = {2: 3, 6: 4}[colours], zlib.decompress(packed), None, 0
for y in range(height):
    begin = y * (width * n + 1)
    how, last, row = raw[begin], row or bytes(width * n), bytearray(raw[begin + 1:begin + 1 + width * n])
    for k in range(len(row)):  # the filters of PNG
        a, b, c = row[k - n] if k >= n else 0, last[k], last[k - n] if k >= n else 0
        paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
        row[k] = (row[k] + (0, a, b, (a + b) // 2, paeth)[how]) % 256
    tinted += sum(max(row[k:k + 3]) - min(row[k:k + 3]) > 3 for k in range(0, len(row), n))
assert tinted > 0.3 * width * height, (tinted, width, height)
END
if command -v ffmpeg >/dev/null; then
  check "render makes a GIF" "$program" render --video --log room.log --out a.gif --size 200 --seconds 1
  check "render makes an MP4" "$program" render --video --log room.log --out a.mp4 --size 200 --seconds 1
  [ -s a.gif ] && [ -s a.mp4 ] || { echo "FAILED: no video"; failed=1; }
else
  refuses 1 "ffmpeg" "$program" render --video --log room.log --out a.gif
fi
refuses 2 "at most 4096 pixels" "$program" render map/lines.csv --3d --size 5000 --out d.png
refuses 2 "excludes" "$program" render --video --3d --log room.log --out a.gif
refuses 2 "excludes" "$program" render map/lines.csv --video --log room.log --out a.gif
refuses 2 "requires --video" "$program" render map/lines.csv --seconds 3 --out d.png
refuses 2 "must end in .png" "$program" render map/lines.csv --out d.foo
refuses 2 "inf" "$program" render map/lines.csv --view 0,0,inf,1 --out d.png
refuses 1 "written as .gif or .mp4" "$program" render --video --log room.log --out a.avi
refuses 2 "view" "$program" render map/lines.csv --view 3,0,0,2 --out d.png
refuses 1 "map: cannot be read" "$program" render map --out d.png
refuses 1 "not a line map" "$program" render room.log --out d.png

# What is scored: comments and a header are passed over, what is no place in a building is refused.
printf '# a comment\nx1,y1,x2,y2\n0,3,6,3\n' >one.csv
check "evaluate takes a comment before the header" "$program" evaluate one.csv --log room.log
for text in '\357\273\277x1,y1,x2,y2\r\n0.5,3,6,3\r\n' 'x1;y1;x2;y2\n0,5;3;6;3\n' 'x1,y1,x2,y2\n0.5,3,6,3\n'; do
  # shellcheck disable=SC2059  # the text is a format
  printf "$text" >sheet.csv
  check "evaluate takes what a spreadsheet wrote" "$program" evaluate sheet.csv --log room.log
  grep -q '"total_length_m": 5.5' last.out || { echo "FAILED: evaluate misread $text"; failed=1; }
  check "render takes what a spreadsheet wrote" "$program" render sheet.csv --out sheet.png --size 300 --no-caption --force
  cp sheet.png "sheet_${#text}.png"
done
for picture in sheet_*.png; do
  cmp sheet.png "$picture" || { echo "FAILED: render drew other lines"; failed=1; }
done
refuses 1 "/dev/null: is empty" "$program" evaluate /dev/null --log room.log
printf 'x1,y1,x2,y2\n0,0,1e9,0\n' >far.csv
refuses 1 "far.csv:2" "$program" evaluate far.csv --log room.log

# What a command reads, or writes elsewhere, it does not write over; --force is not meant for that.
cp room.log kept.log && cp map/lines.csv kept.csv && cp kept.csv kept.png
ln -s kept.log link.log
for file in kept.log link.log ./kept.log; do
  refuses 1 "$file: is named twice" "$program" extract kept.log --out $file --force
done
refuses 1 "both.csv: is named twice" "$program" extract kept.log --out both.csv --arcs ./both.csv
refuses 1 "kept.log: is named twice" "$program" extract kept.log --out both.csv --arcs kept.log --force
refuses 1 "kept.csv: is named twice" "$program" evaluate kept.csv --log kept.log --out kept.csv --force
refuses 1 "kept.log: is named twice" "$program" evaluate kept.csv --log kept.log --out kept.log --force
refuses 1 "kept.png: is named twice" "$program" render kept.png --out kept.png --force
check "the log is what it was" cmp kept.log room.log
check "the map is what it was" cmp kept.csv map/lines.csv
check "the other map is what it was" cmp kept.png map/lines.csv
[ ! -e both.csv ] || { echo "FAILED: extract wrote what it refused"; failed=1; }
mkdir odd && cp room.log odd/poses.csv
refuses 1 "odd/poses.csv: is named twice" "$program" map odd/poses.csv --out odd --force
check "the log is what it was" cmp odd/poses.csv room.log
refuses 2 "--resume: its value is missing before --out" "$program" map room.log --resume --out nowhere

# What does not arrive is told; a device stays one; a name need not be UTF-8.
if [ -w /dev/full ]; then
  refuses 1 "cannot be written" sh -c '"$0" evaluate one.csv --log room.log >/dev/full' "$program"
fi
check "extract into a pipe" sh -c '"$0" extract room.log --out /dev/stdout | grep -q scan_id' "$program"
cp room.log "$(printf 'caf\351.log')"
check "a name that is not UTF-8" "$program" map "$(printf 'caf\351.log')" --out latin1

# What is no log, or only a part of one.
: >empty.log
head -c 100000 /dev/urandom >noise.rawlog
head -c 20000 room.log >cut.log
head -c $(($(stat -c %s room.log.gz) / 2)) room.log.gz >half.log.gz
cp room.log.gz misnamed.rawlog
printf 'Dear reader,\nthis is no log.\n' >letter.log
refuses 1 "empty.log: is empty" "$program" info empty.log
refuses 1 "noise.rawlog" "$program" info noise.rawlog
refuses 1 "not a log of a known kind" "$program" map letter.log --out letter
check "a map has a place on the Earth" "$program" map room.log --out placed --origin 48.1,11.6,30
grep -q '"origin":\[48.1,11.6,30.0\]' placed/lines.geojson || { echo "FAILED: lines.geojson tells no origin"; failed=1; }
grep -q 'id="north"' placed/lines.svg || { echo "FAILED: lines.svg has no north"; failed=1; }
refuses 2 "--origin: '91,0': LAT,LON or LAT,LON,DEG is needed" "$program" map room.log --out misplaced --origin 91,0
refuses 2 "was not expected: --ouut" "$program" map room.log --ouut map
refuses 2 "--out: is empty" "$program" map room.log --out ""
refuses 2 "--resume: is empty" "$program" map room.log --out nowhere --resume ""
[ ! -e nowhere ] || { echo "FAILED: a folder was left for options that were refused"; failed=1; }
printf 'SQLite format 3\0' >drive.db3
printf '\211MCAP0\r\n' >drive.mcap
mkdir drive && touch drive/metadata.yaml
for recording in drive.db3 drive.mcap drive; do
  refuses 1 "is a ROS 2 recording; Python reads it" "$program" map $recording --out recording
done
refuses 1 "no such file" "$program" info missing.log
refuses 1 "not a regular file" "$program" info .
check "a log cut in a line is used" "$program" map cut.log --out cut
grep -q "1 damaged" last.err || { echo "FAILED: the damaged line is not told"; failed=1; }
check "a log cut in a line is extracted" "$program" extract cut.log --out cut.csv
grep -q "1 damaged" last.err || { echo "FAILED: extract does not tell the damaged line"; failed=1; }
check "half a gzip is used" "$program" map half.log.gz --out half
grep -q "ends early" last.err || { echo "FAILED: the early end is not told"; failed=1; }
check "content counts, not the name" "$program" info misnamed.rawlog
refuses 2 "LOG" "$program" info
refuses 1 "cannot be made a folder" "$program" map room.log --out room.log
[ ! -e letter ] || { echo "FAILED: a folder was made for a log that is none"; failed=1; }

# A log far from the origin gives the same map there, picture and grid and all.
awk '/^FLASER/ { for (f = 184; f <= 187; f += 3) { $f = sprintf("%.3f", $f + 1e7); $(f + 1) = "4000000" } } { print }' \
  room.log >utm.log
check "a log at UTM's coordinates" "$program" map utm.log --out utm --quiet
check "gives the same map" python3 - <<'END'
import csv
near, far = ([[float(r[k]) for k in ("x1", "y1", "x2", "y2")] for r in csv.DictReader(open(p + "/lines.csv"))] for p in ("map", "utm"))
assert len(near) == len(far) == 3
for a, b in zip(near, far):
    assert max(abs(a[k] - (b[k] - (4e6 if k % 2 else 1e7))) for k in range(4)) < 1e-3, (a, b)
assert open("map/map.pgm", "rb").read() == open("utm/map.pgm", "rb").read()
END
check "render draws it there" "$program" render utm/lines.csv --out utm.png --size 300
check "and near" "$program" render map/lines.csv --out near.png --size 300
check "one pose gone astray" sh -c 'awk "/^FLASER/ && ++n == 3 { \$184 = \"1e7\" } { print }" room.log | head -n 21 >stray.log'
check "costs no map" "$program" map stray.log --out stray
grep -q "1 scan(s) far from all others" last.err || { echo "FAILED: the stray scan is not told"; cat last.err; failed=1; }
check "nor the length of the way" python3 -c 'import json; assert json.load(open("stray/summary.json"))["distance_m"] < 10'

# A pose that is nowhere on the Earth is damage.
awk '/^FLASER/ && ++n == 3 { $184 = $187 = "1e308" } { print }' room.log >beyond.log
check "a pose beyond all numbers costs its scan" "$program" map beyond.log --out beyond
grep -q "1 scan(s) left out: their poses are beyond 100 000 km; the first is number 2" last.err ||
  { echo "FAILED: the pose beyond all numbers is not told"; cat last.err; failed=1; }

# What is left of a run that was killed goes with the next one.
touch map/.map.part-999999999-0.png
check "map over a killed one" "$program" map room.log --out map --force --quiet
[ ! -e map/.map.part-999999999-0.png ] || { echo "FAILED: a killed run's file is still there"; failed=1; }

# A laser that sees nothing.
awk '{ print } NR == 1 { exit }' room.log >blind.log
for k in 1 2 3; do echo "FLASER 4 0 0 0 0 $k 0 0 $k 0 0 $k host $k"; done >>blind.log
refuses 3 "no line was found" "$program" map blind.log --pose odometry --out blind --quiet

# Names that lead nowhere.
ln -s loop loop
refuses 1 "loop: cannot be made a folder" "$program" map room.log --out loop
refuses 1 "loop" "$program" map loop --out d
refuses 1 "^cca-mrpt: loop: Too many levels of symbolic links" "$program" map room.log --out nowhere --resume loop
refuses 2 "--out: is empty" "$program" extract room.log --out ""
refuses 1 "is no text" "$program" explore room.log.gz --out d
printf 'image: a.png\nresolution:\norigin: [0, 0, 0]\n' >half.yaml
refuses 1 "resolution: has no value" "$program" explore half.yaml --out d

# Ctrl-C while the log is opened leaves nothing; while it is mapped, what there is. Four hundred
# rooms in a row keep the program busy long enough for both.
for _ in $(seq 400); do cat room.log; done >long.log
interrupt_when() {  # interrupt_when FOLDER CONDITION...: maps long.log to FOLDER
  local folder=$1
  shift
  "$program" map long.log --out "$folder" >last.out 2>last.err &
  pid=$!
  for _ in $(seq 600); do "$@" && break; sleep 0.05; done
  kill -INT $pid 2>/dev/null
  wait $pid
  status=$?
}
# shellcheck disable=SC2317  # called by interrupt_when
is_read() { find "/proc/$pid/fd" -lname "*long.log" 2>/dev/null | grep -q .; }
interrupt_when opened is_read
if [ -e opened ]; then
  echo "the log was open before it could be interrupted"
elif [ $status -ne 1 ] || ! grep -q "no map was begun" last.err; then
  echo "FAILED: a log that was being opened (status $status) did not end cleanly"
  cat last.err
  failed=1
fi
interrupt_when interrupted test -d interrupted
if grep -q '"finished": true' interrupted/summary.json 2>/dev/null; then
  echo "the log was mapped before it could be interrupted"
elif [ $status -ne 1 ] || ! grep -q "interrupted after" last.err || [ ! -s interrupted/lines.csv ]; then
  echo "FAILED: an interrupted run (status $status) did not save its map"
  cat last.err
  failed=1
fi

[ $failed -eq 0 ] && echo "all passed"
exit $failed
