#!/usr/bin/env bash
# The pages in docs/ stay short enough to be read: no line of text over 120 characters (tables aside),
# no page over 150 lines but those of docs/log/, and every link to a file leads to one.
set -u
cd "$(dirname "$0")/../.."
failed=0
still_long="docs/exploration.md docs/ros.md docs/simulation.md docs/tangent_bug.md"  # nothing may join them
for page in README.md CONTRIBUTING.md $(git ls-files 'docs/*.md'); do
  case " $still_long " in *" $page "*) continue ;; esac
  awk -v page="$page" '!/^\|/ && !/^!?\[.*\)$/ && length > 120 { print page ":" FNR ": " length " characters"; bad = 1 }
    END { exit bad }' "$page" || failed=1
  case "$page" in docs/log/*) ;; *)
    [ "$(wc -l <"$page")" -le 150 ] || { echo "$page: over 150 lines"; failed=1; } ;;
  esac
  for link in $(grep -oE '\]\([^)#:]+' "$page" | cut -c3-); do
    [ -e "$(dirname "$page")/$link" ] || { echo "$page: no $link"; failed=1; }
  done
done
[ $failed -eq 0 ] && echo "pages: clean"
exit $failed
