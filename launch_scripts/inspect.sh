#!/usr/bin/env bash
# Shows an exploration in the real rviz without a screen, and saves the picture:
#   launch_scripts/inspect.sh [WORLD] [OUT.png] [options of the explore node, as _strategy:=greedy]
# WORLD: a map_server YAML file, or the name of one in maps/ (default two_rooms). It starts a master,
# the node and rviz, each for itself alone, waits until the map stands, and prints the view that the
# picture has: its width and height [pixels], pixels a metre, and the map's x, y at its middle.
set -eu
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
here=$(cd "$(dirname "$0")" && pwd)
world=${1:-two_rooms}
out=${2:-rviz.png}
[ $# -lt 2 ] && shift $# || shift 2
width=${INSPECT_WIDTH:-1280} height=${INSPECT_HEIGHT:-800} longest=${INSPECT_SECONDS:-240}

# The package: a sourced workspace, else the installed one or the build beside this script.
if ! rospack find cca_mrpt >/dev/null 2>&1; then
  for space in "$here/../../.." "$here/../build/devel"; do
    # shellcheck disable=SC1091
    [ ! -f "$space/setup.bash" ] || { set +u; . "$space/setup.bash"; set -u; break; }
  done
fi
node=$(catkin_find --first-only --libexec cca_mrpt explore)
[ -n "$node" ] || { echo "the explore node is not built" >&2; exit 1; }
[ -f "$world" ] || world=$(rospack find cca_mrpt)/maps/${world%.yaml}.yaml
[ -f "$world" ] || { echo "$world: no such world" >&2; exit 1; }

work=$(mktemp -d)
started=()
finish() {
  local i
  for ((i = ${#started[@]} - 1; i >= 0; i--)); do
    kill -INT "${started[i]}" 2>/dev/null || true
  done
  sleep 1
  for i in "${started[@]}"; do kill -KILL "$i" 2>/dev/null || true; done
  rm -rf "$work"
}
trap finish EXIT
start() {  # start NAME COMMAND...: in the background, with a log
  local name=$1
  shift
  "$@" >"$work/$name.log" 2>&1 &
  started+=($!)
}
give_up() { echo "$1" >&2; tail -n 20 "$work"/*.log >&2; exit 1; }

read -r scale x y < <(VIEW_ONLY=1 VIEW_WIDTH=$width VIEW_HEIGHT=$height "$here/view.sh" "$world")

port=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
export ROS_HOME=$work ROS_HOSTNAME=localhost ROS_MASTER_URI=http://localhost:$port
start roscore roscore -p "$port"
timeout 30 bash -c 'until rosparam set /use_sim_time true 2>/dev/null; do sleep 0.2; done' ||
  give_up "the ROS master does not start"

exec 4>"$work/display"
start Xvfb Xvfb -displayfd 4 -screen 0 "${width}x${height}x24" -nolisten tcp
timeout 30 bash -c "until [ -s '$work/display' ]; do sleep 0.1; done" || give_up "Xvfb does not start"
DISPLAY=:$(cat "$work/display")
export DISPLAY LIBGL_ALWAYS_SOFTWARE=1 QT_X11_NO_MITSHM=1
VIEW_WIDTH=$width VIEW_HEIGHT=$height start rviz "$here/view.sh" "$world" rviz --fullscreen
start explore "$node" _world:="$world" _speed:=10 _out:="$work/map" "$@"

timeout 40 bash -c 'until rostopic info /line_markers 2>/dev/null | grep -q "/rviz"; do sleep 0.5; done' ||
  give_up "rviz does not come up"
timeout "$longest" bash -c 'until timeout 8 rostopic echo -n1 /status | grep -q finished; do sleep 0.5; done' ||
  give_up "the exploration has not finished in $longest s"
sleep 4  # a few frames of a software renderer
import -window root "$work/picture.png" || give_up "no picture can be taken"
mkdir -p "$(dirname "$out")"
mv "$work/picture.png" "$out"
echo "$out: $width $height $scale $x $y"
