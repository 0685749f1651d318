#!/usr/bin/env bash
# depth_lists.sh DEPTH DATASET TACIPC NAME SIMULATOR…: lists the samples that all of these simulators have made.
# DEPTH/NAME/<simulator>-<split>.txt lists their folders of render. DEPTH/NAME/made.txt names the samples; it is written
# last and only if they or their records have changed.
set -euo pipefail
depth=$1 dataset=$2 tacipc=$3 lists=$1/$4
shift 4
rm -rf "$lists.new"
mkdir -p "$lists" "$lists.new"
rows=$("$tacipc" table "$dataset/plan/samples.csv" --columns id,split,folder)

# made FILE…: true if each file exists and none is older than the previous one. (A stage that fails removes its own
# record, but not later ones made from it.)
made() {
  local before=
  for file in "$@"; do
    [ -e "$file" ] && { [ -z "$before" ] || [ ! "$before" -nt "$file" ]; } || return 1
    before=$file
  done
}

all=0 whole=0
while IFS=$'\t' read -r id split folder; do
  [ -n "$id" ] || continue
  all=$((all + 1)) records=() renders=()
  for simulator in "$@"; do
    case $simulator in
      tacipc) chain=("$dataset/$folder"/{press/press,render/render}.yaml) ;;
      tacchi) chain=("$dataset/$folder/press/press.yaml" "$depth/tacchi/$id"/{mpm,render/render}.yaml) ;;
      depth-based) chain=("$dataset/$folder/press/press.yaml" "$depth/depth-based/$id"/{baseline,render/render}.yaml) ;;
    esac
    made "${chain[@]}" || continue 2
    records+=("${chain[-1]}") renders+=("$simulator-$split.txt ${chain[-1]%/render.yaml}")
  done
  whole=$((whole + 1))
  for render in "${renders[@]}"; do echo "${render#* }" >> "$lists.new/${render%% *}"; done
  echo "$id $split $(cat "${records[@]}" | cksum)" >> "$lists.new/made.txt"
done <<< "$rows"
echo "depth-benchmark: of $all samples $* made $whole"
if [ "$whole" = 0 ] || [ $((10 * whole)) -lt $((9 * all)) ]; then
  echo "depth-benchmark: fewer than nine in ten. Their records say why; with RETRY=yes presses that failed are tried again" >&2
  exit 1
fi
if cmp -s "$lists.new/made.txt" "$lists/made.txt"; then rm -r "$lists.new"; else
  rm -f "$lists"/*.txt
  for list in "$lists.new"/*-*.txt "$lists.new/made.txt"; do mv "$list" "$lists/"; done
  rmdir "$lists.new"
fi
