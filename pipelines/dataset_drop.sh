#!/usr/bin/env bash
# Removes what stages wrote for samples that are packed, but their records, times and logs: dataset_drop.sh [--whole-shards] DATASET STAGES...
# A sample stays made: its records are there. Only samples that the manifest of the pack lists as made are touched, and only as they were packed:
# with the records whose hashes it has, and while nobody makes them. With --whole-shards only those in shards where no sample failed, as such a
# shard is packed again when one is made after all.
set -euo pipefail
export LC_ALL=C
whole=no
if [ "$1" = --whole-shards ]; then whole=yes; shift; fi
dataset=$1
shift
[ "$#" -gt 0 ] || exit 0
manifest=$dataset/pack/manifest.csv
[ -e "$manifest" ] || { echo "drop: $dataset is not packed; nothing is removed" >&2; exit 1; }
for column in press_sha256 render_sha256; do
  head -n 1 "$manifest" | tr ',' '\n' | grep -qx $column || { echo "drop: $manifest has no $column; pack it again; nothing is removed" >&2; exit 1; }
done
dropped=0 others=0
while read -r folder packed; do
  open=no
  for stage in "$@"; do [ -e "$folder/$stage/.dropped" ] || open=yes; done
  if [ "$open" = no ] || [ ! -e "$folder/press/press.yaml" ] || [ ! -e "$folder/render/render.yaml" ]; then continue; fi
  exec 8>> "$folder/press/.making" 9>> "$folder/render/.making"
  if flock -n 8 && flock -n 9 &&
    [ "$(sha256sum "$folder/press/press.yaml" "$folder/render/render.yaml" 2> /dev/null | cut -c1-64 | tr -d '\n')" = "$packed" ]; then
    for stage in "$@"; do
      [ ! -e "$folder/$stage/.dropped" ] || continue
      # First the mark, so that nobody takes what is left for whole.
      : > "$folder/$stage/.dropped"
      awk '/^outputs:/ { o = 1; next } /^[^ ]/ { o = 0 } o { sub(/^  /, ""); sub(/: [^:]*$/, ""); gsub(/"/, ""); print }' "$folder/$stage/$stage.yaml" |
        while read -r name; do rm -f "$folder/$stage/$name"; done
      find "$folder/$stage" -mindepth 1 -depth -type d -empty -delete
      dropped=$((dropped + 1))
    done
  else
    others=$((others + 1))
  fi
  exec 8>&- 9>&-
done < <(awk -F, -v dataset="$dataset" -v whole="$whole" '
  NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
  NR == FNR { if ($at["status"] == "made") packed[$1] = $at["press_sha256"] $at["render_sha256"]; else if (whole == "yes") open[$at["shard"]] = 1; next }
  ($1 in packed) && !($10 in open) && FNR > 1 { print dataset "/" $11, packed[$1] }' "$manifest" "$dataset/plan/samples.csv")
[ "$dropped" = 0 ] || echo "$(basename "$dataset"): files of $dropped stages dropped ($*)"
[ "$others" = 0 ] || echo "$(basename "$dataset"): $others samples are not as they were packed, or are being made, and keep their files" >&2
