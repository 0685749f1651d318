#!/usr/bin/env bash
# One stage of one sample, for make: dataset_stage.sh DATASET RUN STAGE RECORD PREREQUISITES COMMAND...
# Exit 0: made, made by someone else meanwhile, or failed and noted in DATASET/failures.csv, so that make goes on with the others.
# Exit 1: too many failures in a row (STOP_AFTER), or nothing can be noted any more. Exit 2: the configuration is wrong.
# A sample that failed before is left alone until an input changes or RETRY=yes.
set -euo pipefail
export LC_ALL=C
dataset=$1 run=$2 stage=$3 record=$4 prerequisites=$5
shift 5
folder=$(dirname "$record")
sample=$(basename "$(dirname "$folder")")
failed=$folder/$stage.failed.yaml
said=$folder/.stderr  # hidden, as all that is no result

# Whether a file is there and no prerequisite is newer.
current() {
  [ -e "$1" ] || return 1
  local p
  for p in $prerequisites; do
    if [ "$p" -nt "$1" ]; then return 1; fi
  done
}

stop_if_many() {
  [ ! -e "$run" ] || [ "$(wc -l < "$run")" -lt "$STOP_AFTER" ] ||
    { echo "$STOP_AFTER failures in a row, see $dataset/failures.csv; stopped" >&2; exit 1; }
}

# One row per failed try, for people and for pack: one line each, whatever the message holds.
note_failure() { # note_failure REASON
  local reason=${1//[$'\n\r']/ }
  mkdir -p "$(dirname "$run")"
  {
    flock 8
    [ -s "$dataset/failures.csv" ] || echo 'id,stage,reason,log,time,host' >&8
    printf '%s,%s,"%s",%s,%s,%s\n' "$sample" "$stage" "${reason//\"/\"\"}" "${folder#"$dataset"/}/$stage.log" "$(date -u +%FT%TZ)" "$(hostname)" >&8
  } 8>> "$dataset/failures.csv" || { echo "$dataset/failures.csv cannot be written" >&2; exit 1; }
  echo "$sample" >> "$run" || exit 1
  echo "$sample: $stage failed: $reason" >&2
}

# Without the stage before it (which failed) there is nothing to do.
for p in $prerequisites; do [ -e "$p" ] || exit 0; done
stop_if_many
mkdir -p "$folder"
# Two runs that were given the same sample: one makes it, the other waits and finds it made. A stage that outlives its make keeps the lock.
exec 9> "$folder/.making"
if ! flock -n 9; then flock 9; fi
if current "$record"; then exit 0; fi
if [ "${RETRY:-}" != yes ] && current "$failed"; then exit 0; fi
stop_if_many

if [ "$stage" = render ] && [ -e "$folder/../press/.dropped" ]; then
  echo "$sample: what press wrote was dropped after packing; clean-press, then it is made again" >&2
  exit 1
fi
rm -f "$folder/.dropped"
echo "$*" > "$folder/.command"  # for a bundle
status=0
env "$@" 2> "$said" || status=$?
case $status in
  0)
    rm -f "$said"
    [ ! -s "$run" ] || : > "$run" ;;
  2 | 126 | 127)  # wrong configuration; a program that is not there or cannot be started
    cat "$said" >&2
    exit 2 ;;
  1)
    reason=$(sed -n 's/^message: //p' "$failed" 2> /dev/null || true)
    if [ -z "$reason" ]; then reason=$(tail -n 1 "$said" 2> /dev/null || true); fi
    note_failure "${reason:-no reason given}" ;;
  129 | 130 | 143) exit "$status" ;;  # interrupted, as make itself is: begun again next time
  *)
    # Killed, by the kernel for want of memory or by itself. Where the whole job is being killed, this does not live to say so.
    sleep 1
    signal=$((status - 128))
    printf 'stage: %s\nname: %s\nmessage: killed by signal %s\n' "$stage" "$sample" "$signal" > "$failed" || true
    note_failure "killed by signal $signal" ;;
esac
