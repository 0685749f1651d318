#!/usr/bin/env bash
# Writes a page with generated parts: fill_page.sh TEMPLATE PAGE NAME=FRAGMENT … PAGE is TEMPLATE with each fragment
# between the lines `<!-- NAME -->` and `<!-- end of NAME -->`. A missing fragment is reported. If PAGE is newer than
# TEMPLATE, it is the template itself: parts written by other targets stay.
set -euo pipefail
template=$1 page=$2
shift 2
[ ! "$page" -nt "$template" ] || template=$page
declare -A fragments
for part in "$@"; do
  name=${part%%=*}
  for mark in "<!-- $name -->" "<!-- end of $name -->"; do
    grep -qxF -- "$mark" "$template" || { echo "$template: has no line $mark" >&2; exit 1; }
  done
  fragments["<!-- $name -->"]=${part#*=}
done
mkdir -p "$(dirname "$page")"
end=
while IFS= read -r line; do
  if [ -n "$end" ]; then
    [ "$line" = "$end" ] || continue
    end=
  fi
  printf '%s\n' "$line"
  [ -n "$line" ] && [ -n "${fragments[$line]-}" ] || continue
  if [ -s "${fragments[$line]}" ]; then
    cat "${fragments[$line]}"
    [ -z "$(tail -c 1 "${fragments[$line]}")" ] || echo
  else
    echo 'Not made in this run.'
  fi
  end="<!-- end of ${line#<!-- }"
done < "$template" > "$page.new"
mv "$page.new" "$page"
