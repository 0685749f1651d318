#!/bin/bash
# dataset_bench.sh FOLDER JOBS TACIPC: writes the page of bench-dataset.
# shellcheck disable=SC2016  # backquotes of the page
set -euo pipefail
folder=$1 jobs=$2 tacipc=$3
dataset=$folder/datasets/press_64
made=$(find "$dataset/samples" -name render.yaml | wc -l)
seconds=$(($(cat "$folder/ended") - $(cat "$folder/began")))
processor=$(find "$folder" -name '*.timings.yaml' -exec "$tacipc" get {} processor_s \; | awk '{ sum += $1 } END { printf "%.0f", sum }')
frames=$(find "$dataset/samples" -name tactile.png | grep -vc '/frame_0000/')
choices=$folder/choices first=$dataset/samples/000/mctac__dots__press__000000
seconds_of() { "$tacipc" get "$1.timings.yaml" processor_s; }
force_of() { "$tacipc" get "$1.yaml" summary.press_force_n; }
a_frame() { set -- "$1"/frame_* "$1"; awk -v s="$(seconds_of "${!#}/render")" -v n="$(($# - 1))" 'BEGIN { printf "%.1f", s / n }'; }
codes() { awk -v mae="$("$tacipc" table "$1/samples.csv" --columns mae)" 'BEGIN { printf "%.2f", 255 * mae }'; }
root() { awk -v mse="$("$tacipc" table "$1/samples.csv" --columns mse)" 'BEGIN { printf "%.2f", 255 * sqrt(mse) }'; }
{
  echo '| Setting of the first sample | Press, processor s | Press force, N |'
  echo '|---|---|---|'
  printf '| `configs/press/default.yaml`, friction updated until consistent | %.1f | %.3f |\n' \
    "$(seconds_of "$first/press/press")" "$(force_of "$first/press/press")"
  printf '| the same with `friction.lag: once`, as in the IPC code | %.1f | %.3f |\n' \
    "$(seconds_of "$choices/once/press")" "$(force_of "$choices/once/press")"
  echo
  printf '| %s ' 'Last frame against 4 × 4 camera rays a pixel and 8 × 8 points of each light source' 'Rays a pixel' \
    'Processor s a frame' 'Mean difference, grey levels' 'Root mean square, grey levels'
  echo '|'
  echo '|---|---|---|---|---|'
  compared() { echo "| \`configs/render/$1.yaml\` | $2 | $(a_frame "$choices/$1") | $(codes "$choices/metrics_$1") | $(root "$choices/metrics_$1") |"; }
  compared many_frames 1
  compared default 4
} > "$folder/choices.md"
per_core_hour() { awk -v n="$1" -v s="$seconds" -v j="$jobs" 'BEGIN { printf "%.0f", n * 3600 / (s * j) }'; }
cat <<PAGE
# Cost of a dataset of presses

This page lists the time and disk space of a dataset of 64 presses, for readers who plan a dataset.
It is made by \`make -f Makefile.data bench-dataset\` on $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1).

The run makes \`configs/datasets/press_64.yaml\` from nothing to packed shards and the card, with objects and gel.
It used $jobs stages at a time, with one thread each; when it began, $(cat "$folder/load") processes were running.

| Quantity | Value |
|---|---|
| samples made | $made |
| frames in contact | $frames |
| minutes | $(awk -v s="$seconds" 'BEGIN { printf "%.1f", s / 60 }') (at most 15 on two cores) |
| processor seconds of all stages | $processor |
| samples per core-hour, by $jobs cores' wall time | $(per_core_hour "$made") (at least 200) |
| frames per core-hour | $(per_core_hour "$frames") (at least 1000) |
| packed, GB | $(du -sb "$dataset/pack" | awk '{ printf "%.2f", $1 / 1e9 }') |

$(cat "$folder/cost/table.md")

## What the settings change

$(cat "$folder/choices.md")
PAGE
