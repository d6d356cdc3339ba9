#!/usr/bin/env bash
# cca-mrpt-bench as a user runs it: bench_command_test.sh CCA_MRPT_BENCH CCA_MRPT MAPS
set -eu
program=$1 explorer=$2 maps=$3
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
fail() { echo "FAILED: $1"; exit 1; }

# compare-extractors: a table on the terminal, rows in a file, the same twice (times aside).
compare() {
  "$program" compare-extractors "$maps/two_rooms.yaml" --scans 3 --polygons 3 --noise 0,0.02 \
    --extractors cca,split-and-merge --out "$1" >"$1.txt"
}
compare "$tmp/a" && compare "$tmp/b"
[ "$(grep -c '^### Simulated' "$tmp/a.txt")" -eq 2 ] || fail "a table for each noise"
[ "$(grep -c '^| split-and-merge' "$tmp/a.txt")" -eq 4 ] || fail "both parameter sets, both noises"
grep -q ',f1_minus_cca,' "$tmp/a/comparison.csv" || fail "paired differences"
diff <(grep -v microseconds "$tmp/a/comparison.csv") <(grep -v microseconds "$tmp/b/comparison.csv") ||
  fail "the same seed, the same results"
"$program" compare-extractors >/dev/null 2>"$tmp/error" && fail "nothing to compare on"
grep -q 'polygons' "$tmp/error" || fail "says what is missing"
"$program" compare-extractors --polygons 1 --extractors nobody >/dev/null 2>&1 && fail "unknown extractor"
status=0; "$program" compare-extractors --polygons 1 --extractors nobody >/dev/null 2>&1 || status=$?
[ $status -eq 2 ] || fail "unknown extractor is a usage error, got $status"

# compare-slam: a row a method, poses and a picture of each; MRPT's particles included.
"$explorer" explore "$maps/two_rooms.yaml" --pose truth --out "$tmp/run" --quiet || fail "explore"
"$program" compare-slam "$tmp/run/run.rawlog" --out "$tmp/slam" >"$tmp/slam.txt" || fail "compare-slam"
for method in odometry icp-slam rbpf-slam line-slam pl-icp idc weighted; do
  grep -q "^| $method | [0-9.]* |" "$tmp/slam.txt" || fail "compare-slam: no row of $method"
  [ -s "$tmp/slam/run-$method.csv" ] && [ -s "$tmp/slam/run-$method.png" ] || fail "compare-slam: no files of $method"
done
cmp "$tmp/slam.txt" "$tmp/slam/slam.md" || fail "compare-slam: slam.md is not what was printed"
awk -F'|' '/line-slam/ { exit !($3 < 0.02) }' "$tmp/slam.txt" || fail "compare-slam: $(cat "$tmp/slam.txt")"
"$program" compare-slam "$tmp/run/run.rawlog" --methods nobody >/dev/null 2>&1 && fail "unknown method"

# compare-localisation: ours and MRPT's particles, in the lines that the drive has made.
"$program" compare-localisation "$tmp/run/run.rawlog" --in "$tmp/run" >"$tmp/localised.txt" || fail "compare-localisation"
[ "$(grep -c '^| mrpt-mcl' "$tmp/localised.txt")" -eq 3 ] || fail "compare-localisation: $(cat "$tmp/localised.txt")"
awk -F'|' '/^. lines/ { exit !($3 < 0.02 && $6 == 0) }' "$tmp/localised.txt" ||
  fail "compare-localisation: $(cat "$tmp/localised.txt")"

# tune: shards merged leave the table that one run leaves; a killed run goes on; another design is refused.
tune() {
  "$program" tune "$maps/two_rooms.yaml" "$maps/maze.yaml" --similarity-cut 0.3,0.5 \
    --vertex-price 6,12 --straightness 0.01,0.035 --noise 0.01 --seeds 1 --scans 2 --poses 8 "$@"
}
tune --out "$tmp/whole" >"$tmp/whole.txt" 2>/dev/null
tune --out "$tmp/parts" --shard 1/2 >/dev/null 2>&1
tune --out "$tmp/parts" --shard 2/2 >/dev/null 2>&1
[ ! -e "$tmp/parts/runs.csv" ] || fail "a shard alone leaves no table of all"
tune --out "$tmp/parts" --merge >/dev/null
cmp "$tmp/whole/runs.csv" "$tmp/parts/runs.csv" || fail "two shards merged equal one run"
grep -q '^16 of 16 runs: .*tuning_report.py' "$tmp/whole.txt" || fail "all runs, and what analyses them"
rows="$tmp/whole/rows-1-of-1.csv"
sort "$rows" >"$tmp/before"
truncate -s -30 "$rows"
tune --out "$tmp/whole" >/dev/null 2>&1
sort "$rows" | diff "$tmp/before" - || fail "a killed run goes on where it was"
"$program" tune "$maps/maze.yaml" --out "$tmp/whole" >/dev/null 2>"$tmp/error" && fail "another design"
grep -q 'another design' "$tmp/error" || fail "says that the design differs"
status=0; tune --out "$tmp/x" --shard 3/2 >/dev/null 2>&1 || status=$?
[ $status -eq 2 ] || fail "a bad shard is a usage error, got $status"
status=0; tune --out "$tmp/x" --vertex-price 0,12 >/dev/null 2>&1 || status=$?
[ $status -eq 2 ] || fail "a level out of range is a usage error, got $status"
status=0; "$program" tune "$maps/maze.yaml" --out "$tmp/x" --similarity-cut 0.5 >/dev/null 2>&1 || status=$?
[ $status -eq 2 ] || fail "a single level is a usage error, got $status"

# ablate: a row for what is reached and one for each part, alike from run to run.
ablate() { "$program" ablate "$maps/two_rooms.yaml" --seeds 1 --scans 1 --poses 4; }
ablate >"$tmp/ablation.md" 2>/dev/null
[ "$(grep -c '^| K-means\|^| mu_[1-5], ' "$tmp/ablation.md")" -eq 6 ] || fail "every part has its row"
ablate 2>/dev/null | diff "$tmp/ablation.md" - || fail "the same study gives the same table"
status=0; "$program" ablate >/dev/null 2>&1 || status=$?
[ $status -eq 2 ] || fail "nothing to study is a usage error, got $status"
# compare-strategies: a robot of another size, results whole or an error.
refuses() {  # refuses STATUS WORDS ARGUMENTS...: the program must end so, and say so
  status=0; "$program" "${@:3}" >/dev/null 2>"$tmp/error" || status=$?
  [ $status -eq "$1" ] && grep -q -- "$2" "$tmp/error" || fail "${*:3}: status $status, $(cat "$tmp/error")"
}
"$program" compare-strategies "$maps/two_rooms.yaml" --strategies nearest_frontier --starts 3 \
  --robot.radius 0.4 --out "$tmp/strategies" >/dev/null 2>&1 || fail "compare-strategies: status $?"
[ "$(wc -l <"$tmp/strategies/runs.csv")" -eq 4 ] || fail "compare-strategies: a row a run"
touch "$tmp/file"
refuses 2 "clairvoyance" compare-strategies "$maps/two_rooms.yaml" --strategies clairvoyance
refuses 1 "file: cannot be made a folder" compare-strategies "$maps/two_rooms.yaml" --out "$tmp/file"
refuses 1 "file: cannot be made a folder" compare-extractors "$maps/two_rooms.yaml" --scans 1 --out "$tmp/file"
refuses 1 "second world" compare-strategies "$maps/two_rooms.yaml" "$maps/two_rooms.yaml" --out "$tmp/s"
said=$(ulimit -f 0; "$program" compare-strategies "$maps/two_rooms.yaml" \
  --strategies nearest_frontier --starts 1 --out "$tmp/unwritten" 2>&1) && fail "lost results, status 0"
case "$said" in *"cca-mrpt-bench: "*"runs.csv: cannot be written"*) ;; *) fail "lost results were not told: $said" ;; esac
refuses 2 "no command of cca-mrpt-bench" explore
echo passed
