#!/usr/bin/env bash
# The pages in docs/ stay short enough to be read: no line over 120 characters, no page over 150 lines, and every
# link to a file leads to one. Tables in docs/log/ and README.md may be wider, and pages in docs/log/ longer.
set -u
cd "$(dirname "$0")/../.."
failed=0
for page in README.md CONTRIBUTING.md $(git ls-files 'docs/*.md'); do
  case "$page" in docs/log/*|README.md) wide='^[|]' ;; *) wide='^$' ;; esac
  awk -v page="$page" -v wide="$wide" '$0 !~ wide && length > 120 { print page ":" FNR ": " length " characters"; bad = 1 }
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
