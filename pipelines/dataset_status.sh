#!/usr/bin/env bash
# How far a dataset is: dataset_status.sh [--all-made] DATASET [FIRST END]. With FIRST and END only the samples of these indices.
# --all-made: exit 1 unless every sample is made. Looks only at records, so it may be asked while others work.
set -euo pipefail
export LC_ALL=C
strict=no
if [ "$1" = --all-made ]; then strict=yes; shift; fi
dataset=$1 first=${2:-0} end=${3:-1000000000}
plan=$dataset/plan/samples.csv
[ -e "$plan" ] || [ ! -e "$dataset/plan/.lock-plan" ] || flock -s -w 600 "$dataset/plan/.lock-plan" true  # being made anew
[ -e "$plan" ] || { echo "status: there is no $plan yet: make -f Makefile.data plan CONFIG=..." >&2; exit 1; }

# Records, failures and logs of the samples with their times: one walk that stays above the frames.
blocks() {
  local block
  for block in "$dataset"/samples/[0-9][0-9][0-9]; do
    if [ $((10#${block##*/} * 1000)) -lt "$end" ] && [ $((10#${block##*/} * 1000 + 1000)) -gt "$first" ]; then printf '%s\0' "$block"; fi
  done
}
found() { blocks | xargs -0 -r -I'{}' find '{}' -mindepth 3 -maxdepth 3 \( -name press.yaml -o -name render.yaml -o -name '*.failed.yaml' -o -name '*.log' \) -printf '%T@ %P\n'; }

# Begun and neither made nor failed: running if someone holds the lock, else interrupted.
counts=$(found | awk -F'[ /]' -v plan="$plan" -v first="$first" -v end="$end" -v now="$(date +%s)" '
  BEGIN {
    while ((getline line < plan) > 0) {
      split(line, field, ",")
      if (field[2] !~ /^[0-9]+$/ || field[2] < first || field[2] >= end) continue
      planned[field[1]] = field[11]
      ++samples
    }
  }
  !($2 in planned) { next }
  {
    id = $2
    seen[id] = 1
    if ($4 == "press.yaml") press[id] = 1
    else if ($4 == "render.yaml") render[id] = $1
    else if ($4 ~ /\.failed\.yaml$/) failed[id] = 1
  }
  END {
    for (id in seen) {
      if ((id in press) && (id in render)) {
        ++made
        if (render[id] > now - 600) { ++recent; if (!oldest || render[id] < oldest) oldest = render[id] }
      } else if (id in failed) ++bad
      else print "open " planned[id]
    }
    print "counts " samples + 0, made + 0, bad + 0, recent + 0, (recent > 1 ? now - oldest : 0)
  }')
read -r _ samples made failed recent seconds <<< "$(grep '^counts ' <<< "$counts")"
expected=$((end == 1000000000 ? (samples > 0 ? samples : 1) : end - first))
[ "$samples" = "$expected" ] || { echo "status: $plan has $samples rows where there should be $expected: it is damaged or being made anew; if it stays so: make -f Makefile.data clean-plan CONFIG=..." >&2; exit 1; }
running=0
while read -r _ folder; do
  for lock in "$dataset/$folder"/{press,render}/.making; do
    [ -e "$lock" ] || continue
    if ! flock -n "$lock" true; then running=$((running + 1)); break; fi
  done
done < <(grep '^open ' <<< "$counts" || true)
left=$((samples - made - failed))
echo "$(basename "$dataset"): $samples samples: $made made, $failed failed, $running running, $left left"
if [ "$recent" -gt 1 ] && [ "$left" -gt 0 ]; then
  awk -v n="$recent" -v s="$seconds" -v left="$left" 'BEGIN { s = s > 1 ? s : 1; printf "  %.1f a minute of late; the rest takes %.2f hours at this rate\n", 60 * n / s, left * s / n / 3600 }'
fi
if [ "$failed" -gt 0 ]; then echo "  reasons in $dataset/failures.csv; once more: make -f Makefile.data retry CONFIG=..."; fi
[ "$strict" = no ] || [ "$made" = "$samples" ] || { echo "$(basename "$dataset"): $((samples - made)) of $samples samples are not made" >&2; exit 1; }
