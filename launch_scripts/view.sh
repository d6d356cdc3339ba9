#!/usr/bin/env bash
# Opens rviz on the exploration of a world, so that the view shows all of it:
#   launch_scripts/view.sh WORLD [rviz with its options]
# WORLD: a map_server YAML file, or the name of one in maps/; else (none: the robot is out there) some 40 m around
# the map's origin. VIEW_WIDTH and VIEW_HEIGHT [pixels]: of the view itself (a window of rviz of 1280 x 800 has tools
# and a panel around it). With VIEW_ONLY=1 it starts nothing, and prints pixels a metre and x, y at the view's middle.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
world=$1
shift
for file in "$world" "$here/../maps/$world" "$here/../maps/$world.yaml"; do
  [ ! -f "$file" ] || break
done
fit() {  # FILE: pixels a metre, x, y
  /usr/bin/python3 - "$1" "${VIEW_WIDTH:-900}" "${VIEW_HEIGHT:-700}" <<'PYTHON'
import os, sys, yaml
from PIL import Image
path, width, height = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
world = yaml.safe_load(open(path))
columns, rows = Image.open(os.path.join(os.path.dirname(path), world["image"])).size
w, h = columns * world["resolution"], rows * world["resolution"]
print(round(0.96 * min(width / w, height / h), 4),
      round(world["origin"][0] + w / 2, 4), round(world["origin"][1] + h / 2, 4))
PYTHON
}
if [ ! -f "$file" ] || ! fitted=$(fit "$file"); then fitted="21 0 0"; fi
read -r scale x y <<<"$fitted"
[ -z "${VIEW_ONLY:-}" ] || { echo "$scale $x $y"; exit 0; }
view=${ROS_HOME:-$HOME/.ros}/cca_view.rviz
mkdir -p "$(dirname "$view")"
sed -e "s/^\( *Scale:\) 21$/\1 $scale/" -e "s/^\( *X:\) 20$/\1 $x/" -e "s/^\( *Y:\) 12.5$/\1 $y/" \
  "$here/cca.rviz" >"$view"
[ $# -gt 0 ] || set -- rviz
exec "$@" -d "$view"
