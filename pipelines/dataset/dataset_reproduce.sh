#!/usr/bin/env bash
# Makes some samples of a dataset again, starting with their plan, and compares bytes: dataset_reproduce.sh DATASET
# COUNT MAKE-VARIABLES... It works in a folder next to the dataset, from which everything has the same relative path, so
# that records are also equal.
set -euo pipefail
export LC_ALL=C
dataset=$1 count=$2
shift 2
scratch=$(dirname "$dataset")/.reproduce-$$
trap 'rm -rf "$scratch"' EXIT
mapfile -t picked < <(find "$dataset/samples" -mindepth 4 -maxdepth 5 -name render.yaml -printf '%P\n' |
  sed 's|/render/render.yaml$||' | sort | shuf -n "$count")
[ "${#picked[@]}" -gt 0 ] || { echo "reproduce: no sample of $dataset is made" >&2; exit 1; }
make -s -f Makefile.data dataset-some "$@" DATASET_DIR="$scratch" SAMPLES="${picked[*]}" > "$dataset/.reproduce.log" 2>&1 ||
  { cat "$dataset/.reproduce.log" >&2; exit 1; }
# A stage whose files were dropped still has its record, which contains their hashes.
equal() { # equal SAMPLE
  local made=$dataset/samples/$1 again=$scratch/samples/$1 stage same=yes
  local -a whole=(--exclude='.*' --exclude='*.log' --exclude='*.timings.yaml')
  for stage in press render; do
    [ -e "$made/$stage/.dropped" ] || continue
    whole+=(--exclude="$stage")
    diff -q "$made/$stage/$stage.yaml" "$again/$stage/$stage.yaml" || same=no
  done
  diff -rq "${whole[@]}" "$made" "$again" && [ "$same" = yes ]
}
differ=0
for sample in "${picked[@]}"; do
  if equal "$sample"; then
    echo "${sample#*/}: equal bytes"
  else
    differ=$((differ + 1))
  fi
done
[ "$differ" = 0 ] || { echo "reproduce: $differ of ${#picked[@]} samples differ (another processor? docs/files.md)" >&2; exit 1; }
