#!/usr/bin/env bash
# The algorithm layers know the standard library, Eigen and the layers below them, nothing else: no
# MRPT, no ROS, no clock, no files, no global random numbers, no printing.
set -u
cd "$(dirname "$0")/../.." || exit
failed=0

# check LAYER ALLOWED_LAYERS [ALLOWED_HEADERS|]: every #include of the layer is allowed.
check() {
  local found
  local folders=("src/$1")
  [ ! -d "include/cca_mrpt/$1" ] || folders+=("include/cca_mrpt/$1")
  [ ! -d "benchmarks/$1" ] || folders=("benchmarks/$1")
  found=$(grep -nE '^\s*#\s*include' -r "${folders[@]}" |
    grep -vE "#include (<Eigen/[A-Za-z]+>|${3:-}<[a-z_]+>|\"(cca_mrpt/)?($2)/[a-z0-9_]+\.hpp\")")
  [ -z "$found" ] || { echo "$1 includes what it may not:"; echo "$found"; failed=1; }
  found=$(grep -nE '<(chrono|ctime|filesystem|fstream|iostream|cstdio|thread|mutex|random)>|std::rand\b|\bs?rand\(|random_device' \
    -r "${folders[@]}" | grep -vE '<random>.*// seeded')
  [ -z "$found" ] || { echo "$1 reaches for clock, files, threads, output or random numbers:"; echo "$found"; failed=1; }
}

check geometry geometry
check motion 'geometry|motion'
check sensing 'geometry|sensing'
check localisation 'geometry|sensing|localisation'
check mapping 'geometry|sensing|mapping'
check slam 'geometry|sensing|mapping|localisation|slam'
check known_map 'geometry|sensing|mapping|localisation|slam|known_map'
check navigation/world 'geometry|sensing|navigation/world'
check navigation/planning 'geometry|sensing|navigation|navigation/world|navigation/planning'
check navigation/control 'geometry|motion|sensing|navigation|navigation/world|navigation/control|navigation/control/tangent_bug'
check navigation 'geometry|motion|sensing|navigation|navigation/[a-z_/]+'
check session 'geometry|motion|sensing|mapping|localisation|slam|navigation|session'
check baselines 'geometry|sensing|mapping' '"baselines/[a-z_]+\.hpp"|'
check floor_plan 'geometry|mapping|floor_plan' '<boost/geometry[a-z_/]*\.hpp>|'

# What is installed includes nothing that is not.
found=$(grep -rnE '^\s*#\s*include "' include | grep -vE '"cca_mrpt/[a-z_/0-9]+\.hpp"')
[ -z "$found" ] || { echo "a public header includes one that is not installed:"; echo "$found"; failed=1; }

# The benchmarks use the product by its public headers, and by few of its own use; the product knows nothing of them.
own='"(baselines|commands|evidence|peers)/[a-z_]+\.hpp"'
found=$(grep -rnE '^\s*#\s*include "' benchmarks --exclude-dir=tests --exclude-dir=timing | grep -vE "$own|\"(cca_mrpt/[a-z_/0-9]+|\
apps/(program|logs/(pose_errors|told_start)|options/(moved|parameter_options)|runs/(interruption|progress))|evaluation/(log_score|spatial_index|world_score)|\
geometry/cross|io/(files/atomic_file|lines/segments_csv|logs/measurements|plans/plan_reader|maps/map_picture|poses/(local_frame|mrpt_steps|pose_files|pose_source|trajectory_error))|\
known_map/plan_lines|simulation/(laser|random)|slam/surface_matching)\.hpp\"")
[ -z "$found" ] || { echo "benchmarks include what only the product may:"; echo "$found"; failed=1; }
found=$(grep -rnE '^\s*#\s*include "(baselines|evidence|peers)/' include src)
[ -z "$found" ] || { echo "the product includes benchmarks:"; echo "$found"; failed=1; }
[ $failed -eq 0 ] && echo "layers: clean"
exit $failed
