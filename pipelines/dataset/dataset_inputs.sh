#!/usr/bin/env bash
# Finds changes of a plan's input files that make cannot see: dataset_inputs.sh DATASET CONFIG. It prints `changed` if a
# file has been replaced by an older one (cp -p, unzip). It prints `future`, and the file on stderr, if the time of an
# input, a record or another file used by make lies in the future: no result would ever be newer.
# shellcheck disable=SC2016  # what the inner bash expands
set -euo pipefail
export LC_ALL=C
dataset=$1 config=$2
# The reference time is that of a file made here now, because the clock of a file server may differ.
{ mkdir -p "$dataset" && now=$(mktemp "$dataset/.now-XXXXXX"); } 2> /dev/null || exit 0  # the plan reports the error
trap 'rm -f "$now"' EXIT
# Missing files are reported by the plan.
named() { echo "$config"; cat "$dataset/plan/inputs.txt" 2> /dev/null || true; }
of_named() { named | xargs -r bash -c 'tests=$1; shift; find -L "$@" -prune $tests' bash "$1" 2> /dev/null || true; }
of_dataset() { # files that products of the dataset are compared with, times as in of_named
  find "$dataset" -mindepth 1 -maxdepth 5 -name '.*' -prune -o \
    \( -name '*.yaml' ! -name '*.timings.yaml' -o -path "$dataset/choices/*" -o -path "$dataset/shards/*.inputs" \) \
    -newer "$now" -printf '%p, of %t\n' 2> /dev/null || true
}
for try in 1 2 3; do  # clocks of two machines differ a little
  future=$(of_named "-newer $now -printf %p,\\040of\\040%t\\n"; of_dataset)
  [ -n "$future" ] || break
  [ "$try" = 3 ] || sleep 1
  touch "$now"
done
if [ -n "$future" ]; then
  { head -n 5 <<< "$future"; echo "is newer than anything made now, at $(date -r "$now"): mend the clock or touch the file"; } | sed 's/^/plan: /' >&2
  echo future
elif [ -e "$dataset/plan/plan.yaml" ] && [ -n "$(of_named "-newercm $dataset/plan/plan.yaml ! -newercm $now")" ]; then
  echo changed
fi
