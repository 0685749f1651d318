#!/usr/bin/env bash
# Prints the total time of all runs in some folders, and the processor: processor_hours.sh BIN LIST-OF-FOLDERS …
set -euo pipefail
bin=$1
shift
milliseconds=0
while IFS= read -r file; do
  printf -v one %.0f "$("$bin/tacipc" get "$file" processor_s)e3"
  milliseconds=$((milliseconds + one))
done < <(cat "$@" | sort -u | while IFS= read -r folder; do [ ! -d "$folder" ] || find "$folder" -name '*.timings.yaml'; done | LC_ALL=C sort -u)
IFS=: read -r _ processor < <(grep -m 1 '^model name' /proc/cpuinfo)
LC_ALL=C printf 'All runs in the folders of this page together: %.1f processor hours. The page was made on:%s.\n' \
  "$(((milliseconds + 180000) / 360000))e-1" "$processor"
