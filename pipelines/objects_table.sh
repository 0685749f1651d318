#!/usr/bin/env bash
# Makes the table of docs/objects.md from records and logs: objects_table.sh FOLDER
set -euo pipefail
folder=$1
in_summary() { sed -n '/^summary:/,$p' "$2" | sed -n "s/^  $1: //p" | head -n 1; }
for gel in own paper; do
  [ "$gel" = own ] && echo "## Into our own gel (\`adaptive_0250um\`)" || echo "## Into the gel published with the paper (23,661 vertices)"
  echo
  echo "| object | vertices | Newton iterations | press force, N | smallest distance, µm | smallest volume ratio | intersections | CPU seconds | peak memory, MiB |"
  echo "|---|---|---|---|---|---|---|---|---|"
  for record in "$folder/$gel"/*/press/press.yaml; do
    sample=$(basename "$(dirname "$(dirname "$record")")")
    log=${record%.yaml}.log
    vertices=$(head -c 400 "$folder/objects/$sample/object.ply" | LC_ALL=C sed -n 's/^element vertex //p' | head -n 1)
    printf '| %s | %s | %s | %.3f | %.3f | %.3f | %s | %.0f | %s |\n' "$sample" "$vertices" \
      "$(in_summary newton_iterations "$record")" "$(in_summary press_force_n "$record")" \
      "$(awk -v d="$(in_summary min_distance_m "$record")" 'BEGIN { print 1e6 * d }')" "$(in_summary min_volume_ratio "$record")" \
      "$(in_summary intersections "$record")" "$(sed -n 's/.*cpu_s: \([0-9.]*\).*/\1/p' "$log" | tail -n 1)" \
      "$(sed -n 's/.*peak_memory_mib: \([0-9]*\).*/\1/p' "$log" | tail -n 1)"
  done
  echo
done
