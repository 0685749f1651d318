#!/usr/bin/env bash
# Makes the table of docs/objects.md from records and timings: objects_table.sh FOLDER TACIPC
set -euo pipefail
export LC_ALL=C
folder=$1 tacipc=$2
row() { # row SAMPLE PRESS-FOLDER
  local -a of
  mapfile -t of < <(
    "$tacipc" get "$folder/objects/$1/decimate.yaml" summary.vertices
    "$tacipc" get "$2/press.yaml" summary.newton_iterations summary.press_force_n summary.min_distance_m summary.min_volume_ratio summary.intersections
    "$tacipc" get "$2/press.timings.yaml" processor_s peak_memory_mb
  )
  [ "${#of[@]}" = 8 ] || { echo "objects_table: $2 is not whole" >&2; exit 1; }
  # µm of m, MiB of MB.
  awk -v sample="$1" -v values="${of[*]}" 'BEGIN { split(values, v, " ")
    printf "| %s | %s | %s | %.3f | %.3f | %.3f | %s | %.0f | %.0f |\n", sample, v[1], v[2], v[3], 1e6 * v[4], v[5], v[6], v[7], v[8] / 1.048576 }'
}
for gel in own paper; do
  if [ "$gel" = own ]; then echo "## Into our own gel (\`adaptive_0250um\`)"; else echo "## Into the gel published with the paper (23,661 vertices)"; fi
  echo
  printf '| %s ' object vertices 'Newton iterations' 'press force, N' 'smallest distance, µm' 'smallest volume ratio' intersections 'CPU seconds' \
    'peak memory, MiB'
  echo '|'
  echo "|---|---|---|---|---|---|---|---|---|"
  for record in "$folder/$gel"/*/press/press.yaml; do
    press=$(dirname "$record")
    row "$(basename "$(dirname "$press")")" "$press"
  done
  echo
done
