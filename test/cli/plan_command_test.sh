#!/usr/bin/env bash
# The floor plan as a user gets it: plan_command_test.sh PROGRAM MAPS
set -u
program=$1 maps=$2
. "$(dirname "$0")/commands.sh"

files="plan.geojson plan.svg plan.dxf plan.pdf rooms.csv rooms.png"
check "a world is explored" "$program" explore "$maps/two_rooms.yaml" --out map --quiet
for file in $files; do
  [ -s "map/$file" ] || { echo "FAILED: explore left no map/$file"; failed=1; }
done
check "the summary tells of the plan" python3 -c '
import json
assert json.load(open("map/summary.json"))["plan"]["rooms"] == 2'

cp -r map copy
rm copy/plan.* copy/rooms.*
mv copy kept && mkdir copy && mv kept copy/map
check "plan makes it from the map alone" "$program" plan copy/map
grep -q '^2 rooms, ' last.out || { echo "FAILED: plan does not tell of two rooms"; cat last.out; failed=1; }
for file in $files; do
  check "explore and plan write the same $file" cmp "map/$file" "copy/map/$file"
done
check "the same plan once more overwrites nothing" "$program" plan map --quiet
[ ! -s last.out ] || { echo "FAILED: --quiet prints"; failed=1; }

check "its features are what they should be" python3 - <<'EOF'
import json, math, xml.dom.minidom
features = json.load(open("map/plan.geojson"))["features"]
kinds = {}
for f in features:
    kinds.setdefault(f["properties"]["kind"], []).append(f)
assert set(kinds) >= {"room", "wall"}, kinds.keys()
rooms = {f["properties"]["id"]: f for f in kinds["room"]}
for f in rooms.values():
    ring = f["geometry"]["coordinates"][0]
    assert ring[0] == ring[-1] and len(ring) >= 4
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:])) / 2
    assert area > 0 and (len(f["geometry"]["coordinates"]) > 1 or abs(area - f["properties"]["area_m2"]) < 0.01)
openings = kinds.get("door", []) + kinds.get("opening", [])
assert openings
for f in openings:
    a, b = f["geometry"]["coordinates"]
    assert abs(math.dist(a, b) - f["properties"]["width_m"]) < 1e-3
    assert set(f["properties"]["rooms"]) == set(rooms)
assert any(f["properties"]["faces"] == 2 and abs(f["properties"]["thickness_m"] - 0.1) < 0.01 for f in kinds["wall"])
xml.dom.minidom.parse("map/plan.svg")
assert open("map/plan.pdf", "rb").read(5) == b"%PDF-"
assert open("map/rooms.png", "rb").read(4) == b"\x89PNG"
dxf = open("map/plan.dxf").read().split("\n")
assert {"A-WALL", "A-DOOR", "A-AREA"} <= set(dxf) and dxf[-2] == "EOF"
EOF

python3 - <<'EOF'
import csv
rooms = list(csv.DictReader(open("map/rooms.csv")))
with open("labels.csv", "w") as f:
    f.write('name,x,y\n')
    for name, room in zip(('"Küche, groß"', 'Bad & WC <1>'), rooms):
        f.write('%s,%s,%s\n' % (name, room["x"], room["y"]))
EOF
refuses 1 "is there already (--force overwrites it)" "$program" plan map --labels labels.csv
check "names make another plan" "$program" plan map --labels labels.csv --out named
check "and are in it" python3 - <<'EOF'
import csv, json, xml.dom.minidom
assert [r["name"] for r in csv.DictReader(open("named/rooms.csv"))] == ["Küche, groß", "Bad & WC <1>"]
assert "Bad & WC <1>" in {f["properties"].get("name") for f in json.load(open("named/plan.geojson"))["features"]}
assert "Küche, groß" in xml.dom.minidom.parse("named/plan.svg").toxml()
EOF
check "--force overwrites" "$program" plan map --labels labels.csv --force

printf 'x,y,name\n-100,0,nowhere\n' >outside.csv
refuses 3 "lies in no room" "$program" plan map --labels outside.csv --out outside
printf 'x,name\n1,a\n' >no_y.csv
refuses 1 "no_y.csv: the header has no column y" "$program" plan map --labels no_y.csv --out none
printf 'x,y,name\n1,east,a\n' >east.csv
refuses 1 "east.csv, row 2, column y: 'east' is no finite number" "$program" plan map --labels east.csv --out none
printf 'x,y,name\n1,1,\n' >no_name.csv
refuses 1 "no_name.csv, row 2, column name: empty" "$program" plan map --labels no_name.csv --out none
printf '\xef\xbb\xbfx,y,name\r\n1,1,Flur\r\n' >spreadsheet.csv
check "labels of a spreadsheet are read" "$program" plan map --labels spreadsheet.csv --out spreadsheet
grep -q '"Flur"' spreadsheet/rooms.csv || { echo "FAILED: no room is called Flur"; failed=1; }
printf 'name;x;y\r\n"Bad; WC";1,5;1\r\n' >semicolons.csv
check "labels with semicolons and decimal commas are read" "$program" plan map --labels semicolons.csv --out semicolons
grep -q '"Bad; WC"' semicolons/rooms.csv || { echo "FAILED: no room is called Bad; WC"; failed=1; }
printf 'x,y,name\n1,1,K\374che\n' >latin1.csv
refuses 1 "latin1.csv, row 2, column name: must be UTF-8 text" "$program" plan map --labels latin1.csv --out none
refuses 1 "none.csv: cannot be read" "$program" plan map --labels none.csv --out none
[ ! -e none ] || { echo "FAILED: a plan that failed left a folder"; failed=1; }
refuses 1 "is no folder of a map" "$program" plan nowhere
mkdir empty
refuses 1 "lines.csv: cannot be read" "$program" plan empty
cp map/lines.csv empty/
refuses 1 "map.yaml: cannot be read" "$program" plan empty
echo "image: none.pgm" >empty/map.yaml
refuses 1 "map.yaml: resolution" "$program" plan empty
sed 's/map.pgm/none.pgm/' map/map.yaml >empty/map.yaml
refuses 1 "map.yaml: image: .*none.pgm does not exist" "$program" plan empty
cp map/map.pgm empty/
sed 's/^origin:.*/origin: [0, 0, 1.0]/' map/map.yaml >empty/map.yaml
refuses 1 "map.yaml: origin: a turned map" "$program" plan empty
sed 's/^origin:.*/origin: [1000, 0, 0]/' map/map.yaml >empty/map.yaml
refuses 1 "map.yaml: origin: no line of lines.csv ends on this grid" "$program" plan empty
refuses 2 "DIR" "$program" plan

# A map of which nothing is known: the files are there, the status tells.
mkdir blank
head -1 map/lines.csv >blank/lines.csv
sed 's/^origin:.*/origin: [0, 0, 0]/' map/map.yaml >blank/map.yaml
{ printf 'P5\n20 20\n255\n'; head -c 400 /dev/zero | tr '\0' '\315'; } >blank/map.pgm
refuses 3 "no room was found" "$program" plan blank
[ -s blank/plan.geojson ] || { echo "FAILED: no plan of a blank map"; failed=1; }

[ $failed -eq 0 ] && echo "plan: all as it should be"
exit $failed
