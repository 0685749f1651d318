#!/bin/bash
# campaign_page.sh FOLDER SUMMARY: writes the page of the campaign whose cases are in FOLDER, with their cost.
set -euo pipefail
folder=$1 summary=$2
cat "$summary"
echo
echo '| processor seconds of a case | |'
echo '|---|---|'
find "$folder" -name stress_case.timings.yaml -exec sed -n 's/^processor_s: //p' {} + | LC_ALL=C sort -g | awk '
  { seconds[NR] = $1; sum += $1 }
  END {
    printf "| mean | %.2f |\n| half of the cases at most | %.2f |\n| 99 in 100 at most | %.2f |\n| longest | %.1f |\n| all, hours | %.2f |\n",
      sum / NR, seconds[int((NR + 1) / 2)], seconds[int(0.99 * NR + 0.5)], seconds[NR], sum / 3600 }'
