#!/usr/bin/env bash
# fuzz_table.sh TACIPC RECORD…: results of fuzzing, one line per reader. Fails if there is a find.
set -euo pipefail
tacipc=$1 total=0
shift
echo '| Reader | Inputs | Seconds | Finds |'
echo '|---|---|---|---|'
for record in "$@"; do
  { read -r reader; read -r inputs; read -r seconds; read -r finds; } < <("$tacipc" get "$record" summary.reader summary.inputs summary.seconds summary.finds)
  echo "| $reader | $inputs | $seconds | $finds |"
  total=$((total + finds))
done
[ "$total" = 0 ] || { echo "fuzz: $total finds, kept beside $(dirname "$1") in finds/; after mending remove its fuzz.yaml" >&2; exit 1; }
