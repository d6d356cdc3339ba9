#!/usr/bin/env bash
# Explores a simulated building and brings back its line map:
#   launch_scripts/explore.sh [WORLD.yaml] [options of 'cca-mrpt explore', see --help]
# Installs by apt what is missing, builds what has changed, explores (the office, if no world is
# named), and names the picture and the map at the end. Needs no display and no ROS.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
program=$("$here/launch_scripts/build_program.sh")

case "${1:-}" in
  '' | -*) set -- "$here/maps/office.yaml" "$@" ;;
esac
exec "$program" explore "$@"
