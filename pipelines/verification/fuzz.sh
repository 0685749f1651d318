#!/usr/bin/env bash
# fuzz.sh PROGRAM READER RUNS FOLDER: one reader on RUNS random inputs, the same ones every time. FOLDER/finds keeps
# inputs that break it, with the command to reproduce them; the remaining inputs follow with another seed.
# FOLDER/fuzz.yaml is written last.
set -euo pipefail
program=$1 reader=$2 runs=$3 folder=$4
most_finds=10 # further ones are mostly the same
seeds=("tests/fuzz/corpus/$reader")
[ ! -d "tests/fuzz/finds/$reader" ] || seeds+=("tests/fuzz/finds/$reader")

rm -rf "$folder"
mkdir -p "$folder/corpus" "$folder/finds"
# Each input goes through a file: in memory, if the system has such a folder.
scratch=$(mktemp -d -p "$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}")")
trap 'rm -rf "$scratch"' EXIT
# Freed memory that the sanitizer holds back counts as used. Traces of allocations are short: with long ones yaml is
# tested 220 times a second instead of 370, and the command of a find prints them.
export TMPDIR=$scratch ASAN_OPTIONS=quarantine_size_mb=32:allocator_may_return_null=0:malloc_context_size=3

left=$runs finds=0 begin=$SECONDS
for ((seed = 1; left > 0 && finds < most_finds; ++seed)); do
  log=$folder/log_$seed.txt status=0
  "$program" -runs="$left" -seed="$seed" -max_len=4096 -timeout=25 -rss_limit_mb=1024 -print_final_stats=1 -verbosity=1 \
    -artifact_prefix="$folder/finds/" "$folder/corpus" "${seeds[@]}" > "$log" 2>&1 || status=$?
  made=$(grep -oP '^stat::number_of_executed_units: *\K[0-9]+' "$log") || { echo "fuzz: $reader: $program failed, see $log" >&2; exit 1; }
  left=$((left - made))
  [ "$status" != 0 ] || break
  kept=$(grep -oP 'Test unit written to \K.*' "$log") || { echo "fuzz: $reader: a find that was not kept, see $log" >&2; exit 1; }
  finds=$((finds + 1))
  echo "fuzz: $reader: a find: $program $kept (what it says: $log)"
done

[ "$left" -ge 0 ] || left=0
printf 'stage: fuzz\nsummary:\n  reader: %s\n  inputs: %d\n  seconds: %d\n  finds: %d\n' "$reader" $((runs - left)) $((SECONDS - begin)) \
  "$finds" > "$folder/fuzz.yaml.new"
mv "$folder/fuzz.yaml.new" "$folder/fuzz.yaml"
