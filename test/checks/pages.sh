#!/usr/bin/env bash
# The pages in docs/ stay short enough to be read: no line over 120 characters, no page over 150 lines. Every link
# leads to a file and, where it names one, to a heading; every page that a source names is there. Tables in docs/log/
# and README.md may be wider, and pages in docs/log/ longer.
set -u
cd "$(dirname "$0")/../.." || exit
failed=0

# anchors PAGE: those of its headings, as GitHub makes them.
anchors() {
  grep -E '^#+ ' "$1" | sed -E 's/^#+ //; s/\]\([^)]*\)//g' | tr '[:upper:]' '[:lower:]' | sed -E 's/[^a-z0-9_ -]//g; s/ /-/g'
}

for page in README.md CONTRIBUTING.md $(git ls-files 'docs/*.md' 'benchmarks/*.md'); do
  case "$page" in docs/log/*|README.md) wide='^[|]' ;; *) wide='^$' ;; esac
  awk -v page="$page" -v wide="$wide" '$0 !~ wide && length > 120 { print page ":" FNR ": " length " characters"; bad = 1 }
    END { exit bad }' "$page" || failed=1
  case "$page" in docs/log/*) ;; *)
    [ "$(wc -l <"$page")" -le 150 ] || { echo "$page: over 150 lines"; failed=1; } ;;
  esac
  for link in $(grep -oE '\]\([^):]+' "$page" | cut -c3-) $(sed -nE 's/^\[[^]]+\]: ([^:]+)$/\1/p' "$page"); do
    file=${link%%#*}
    target=$page
    [ -z "$file" ] || target=$(dirname "$page")/$file
    [ -e "$target" ] || { echo "$page: no $file"; failed=1; continue; }
    case "$link" in *#*) anchors "$target" | grep -qxF -- "${link#*#}" || { echo "$page: no $link"; failed=1; } ;; esac
  done
done
for page in $(git grep -ohE '\bdocs/[a-z_/]+\.md\b' -- src include test python launch_scripts benchmarks | sort -u); do
  [ -e "$page" ] || { echo "named in a source: no $page"; failed=1; }
done
[ $failed -eq 0 ] && echo "pages: clean"
exit $failed
