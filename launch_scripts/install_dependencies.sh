#!/usr/bin/env bash
# Installs by apt what is missing on a Debian 12: install_dependencies.sh [--ros|--tests]
# Without an option: what building and running the application needs. --ros: also ROS 1 with rviz, for the
# nodes. --tests: all that, an off-screen display and the tools of the tests.
set -eu

packages="build-essential ca-certificates cmake libboost-dev libcairo2-dev libcli11-dev libeigen3-dev libmrpt-dev
  libcpp-httplib-dev libnanoflann-dev libpng-dev mrpt-common ninja-build nlohmann-json3-dev pkg-config zlib1g-dev"
ros="catkin libactionlib-dev libdiagnostic-updater-dev libdynamic-reconfigure-config-init-mutex-dev libgeometry-msgs-dev
  libmove-base-msgs-dev libnav-msgs-dev
  librosbag-dev libroscpp-dev libroslib-dev libsensor-msgs-dev libstd-msgs-dev libstd-srvs-dev libtf2-dev libtf2-msgs-dev
  libtopic-tools-dev libvisualization-msgs-dev python3-diagnostic-msgs python3-nav-msgs python3-pil python3-rosbag
  python3-roslaunch python3-rospy python3-sensor-msgs python3-std-srvs python3-tf2-ros
  python3-visualization-msgs python3-yaml ros-core-dev rosbash rosout rviz"
tests="catkin-lint chromium clang clang-format clang-tidy ffmpeg gdal-bin git imagemagick libbenchmark-dev libclang-rt-14-dev
  libgl1-mesa-dri libgmock-dev libgtest-dev librostest-dev mrpt-apps python3-actionlib python3-dev
  python3-dynamic-reconfigure python3-matplotlib python3-move-base-msgs python3-numpy python3-pandas python3-rostest
  python3-scipy python3-statsmodels python3-venv shellcheck x11-utils xauth xvfb"
case "${1:-}" in
  --ros) packages="$packages $ros" ;;
  --tests) packages="$packages $ros $tests" ;;
esac

missing=""
for package in $packages; do
  dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
    missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "These packages are missing, and neither root nor sudo is at hand to install them:$missing" >&2
    exit 1
  }
  as_root=sudo
fi
echo "Installing:$missing"
$as_root apt-get update -qq
# shellcheck disable=SC2086  # a list
$as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends $missing >/dev/null
