#!/usr/bin/env bash
# Explores every shipped world from three start poses with three seeds, and prints a table:
#   benchmarks/scripts/explore_all_worlds.sh [OUT_FOLDER [further options of explore]]
# WORLDS and SEEDS may be set, e.g. WORLDS="maze office" SEEDS=1.
# Ends non-zero if a run failed, collided, or saw less than 99 %.
set -u
here=$(cd "$(dirname "$0")/../.." && pwd)
export PATH=/usr/bin:/bin:/usr/sbin:/sbin:$PATH
program=$("$here/launch_scripts/build_program.sh") || exit 1
out=${1:-out/all-worlds}
shift $(($# > 0 ? 1 : 0))
mkdir -p "$out"

# The world's own start, and two places far from it and from each other.
declare -A starts=(
  [apartment]='12,9.5,0 24.08,1.42,90 0.98,18.53,-135'
  [corridor_loop]='1.2,1.2,0 22.88,14.52,90 7.22,15.18,-135'
  [gallery]='2,8,0 25.18,14.82,90 17.38,1.42,-135'
  [maze]='1,1,0 15.18,11.02,90 4.28,11.32,-135'
  [office]='2,12.5,0 39.08,23.62,90 27.28,1.33,-135'
  [pillar_hall]='3,9,0 23.18,1.08,90 17.98,16.53,-135'
  [random]='3.475,2.025,0 16.92,12.38,90 15.73,0.82,-135'
  [two_rooms]='2,3,0 9.18,5.08,90 6.62,0.88,-135'
  [warehouse]='3,3,0 56.28,37.12,90 41.18,2.33,-135'
)
worlds=${WORLDS:-two_rooms corridor_loop maze random gallery pillar_hall apartment office warehouse}

value() { sed -n "s/^ *\"$2\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}\$/\1/p" "$1/summary.json"; }

missed=0
printf '%-14s %-19s %4s %9s %11s %9s %8s %10s %8s\n' \
  world start seed coverage distance time wall collisions finished
for world in $worlds; do
  for start in ${starts[$world]}; do
    for seed in ${SEEDS:-1 2 3}; do
      folder="$out/$world-$start-$seed"
      rm -f "$folder/summary.json"
      "$program" explore "$here/maps/$world.yaml" --start="$start" --seed "$seed" --out "$folder" \
        --force --quiet "$@"
      status=$?
      [ -e "$folder/summary.json" ] || { echo "$world $start $seed: no result"; missed=1; continue; }
      coverage=$(value "$folder" coverage) collisions=$(value "$folder" collisions)
      printf '%-14s %-19s %4d %9.4f %9.1f m %7.0f s %6.1f s %10d %8s\n' "$world" "$start" "$seed" \
        "$coverage" "$(value "$folder" distance_m)" "$(value "$folder" duration_s)" \
        "$(value "$folder" wall_s)" "$collisions" "$(value "$folder" finished)"
      awk -v c="$coverage" 'BEGIN { exit !(c >= 0.99) }' && [ "$collisions" -eq 0 ] &&
        [ $status -eq 0 ] || missed=1
    done
  done
done
exit $missed
