#!/usr/bin/env bash
# dataset_scale.sh DATASET BIN: disk space of a finished dataset, and cost of each of its steps.
set -euo pipefail
dataset=$1 bin=$2
# cost RECORD…: sum of processor seconds and seconds, and the largest memory, in the timings of these stages.
cost() {
  local record
  for record in "$@"; do "$bin/tacipc" get "$record" processor_s wall_s peak_memory_mb | paste -sd ' '; done |
    awk '{ processor += $1; wall += $2; if ($3 > memory) memory = $3 } END { printf "%d | %.0f | %.0f | %.0f |\n", NR, processor, wall, memory }'
}
all() { find "$dataset" -maxdepth "$1" -name "$2.timings.yaml"; }
echo '| | runs | of processor, s | one after the other, s | largest process, MB |'
echo '|---|---|---|---|---|'
echo "| plan | $(cost "$dataset/plan/plan.timings.yaml")"
# Seconds and memory of samples are in the table that the card made.
for stage in press render; do
  "$bin/tacipc" table "$dataset/pack/timings.csv" --columns "${stage}_processor_s,${stage}_wall_s,${stage}_peak_memory_mb" |
    awk -v stage="$stage" '{ processor += $1; wall += $2; if ($3 > memory) memory = $3 }
      END { printf "| %s | %d | %.0f | %.0f | %.0f |\n", stage, NR, processor, wall, memory }'
done
mapfile -t packs < <(all 3 pack)
echo "| pack | $(cost "${packs[@]}")"
echo "| card | $(cost "$dataset/pack/card.timings.yaml")"
echo "| dataset-report | $(cost "$dataset/report/report.timings.yaml")"
before=$EPOCHREALTIME
"$bin/survey" status "$dataset" > /dev/null
echo "| status | 1 | | $(awk -v a="$before" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.0f", b - a }') | |"
echo
for folder in plan samples shards pack report; do
  [ -d "$dataset/$folder" ] || continue
  echo "$folder: $(find "$dataset/$folder" -type f | wc -l) files, $(find "$dataset/$folder" | wc -l) inodes, $(du -sm "$dataset/$folder" | cut -f1) MB"
done
