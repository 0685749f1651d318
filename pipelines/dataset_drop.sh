#!/usr/bin/env bash
# Removes what stages wrote for samples that are packed, but their records, times and logs: dataset_drop.sh DATASET STAGES...
# A sample stays made: its records are there. Only samples that the manifest of the pack lists as made are touched.
set -euo pipefail
export LC_ALL=C
dataset=$1
shift
[ "$#" -gt 0 ] || exit 0
manifest=$dataset/pack/manifest.csv
[ -e "$manifest" ] || { echo "drop: $dataset is not packed; nothing is removed" >&2; exit 1; }
dropped=0
while read -r folder; do
  [ -e "$folder/press/press.yaml" ] && [ -e "$folder/render/render.yaml" ] || continue
  for stage in "$@"; do
    [ ! -e "$folder/$stage/.dropped" ] || continue
    # First the mark, so that nobody takes what is left for whole.
    : > "$folder/$stage/.dropped"
    awk '/^outputs:/ { o = 1; next } /^[^ ]/ { o = 0 } o { sub(/^  /, ""); sub(/: [^:]*$/, ""); gsub(/"/, ""); print }' "$folder/$stage/$stage.yaml" |
      while read -r name; do rm -f "$folder/$stage/$name"; done
    find "$folder/$stage" -mindepth 1 -depth -type d -empty -delete
    dropped=$((dropped + 1))
  done
done < <(awk -F, -v dataset="$dataset" '
  NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "status") status = i }
  NR == FNR { if ($status == "made") packed[$1] = 1; next } ($1 in packed) && FNR > 1 { print dataset "/" $11 }' "$manifest" "$dataset/plan/samples.csv")
echo "$(basename "$dataset"): files of $dropped stages dropped ($*)"
