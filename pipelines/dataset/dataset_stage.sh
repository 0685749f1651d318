#!/usr/bin/env bash
# One stage of one sample, for make: dataset_stage.sh DATASET RUN STAGE RECORD PREREQUISITES COMMAND...
# Exit 0: made, made by someone else meanwhile, or failed and noted in DATASET/failures.csv, so that make goes on with the others.
# Exit 1: too many failures in a row (STOP_AFTER), or the disk takes nothing more, which is no fault of the sample: it counts as not tried.
# Exit 2: the configuration is wrong. A sample that failed before is left alone until an input changes or RETRY=yes.
# shellcheck disable=SC2016,SC2034  # write expands its commands and what they use
set -euo pipefail
export LC_ALL=C
dataset=$1 run=$2 stage=$3 record=$4 prerequisites=$5
shift 5
folder=${record%/*} sample=${record#"$dataset"/samples/*/}  # without processes: a tiny sample is as quick as these
sample=${sample%/"$stage.yaml"}
sample=${sample%/"$stage"}  # what is left for a grasp is its name, for the images of a finger that with /left or /right
failed=$folder/$stage.failed.yaml
said=''

# Whether a file is there and no prerequisite is newer.
current() {
  [ -e "$1" ] || return 1
  local p
  for p in $prerequisites; do
    if [ "$p" -nt "$1" ]; then return 1; fi
  done
}

# Whether all that it is made of is there. A gel or an object is gone for a moment while another run makes it again; without the stage before it
# (which failed) there is nothing to do.
inputs_are_there() {
  local p
  for p in $prerequisites; do
    [ ! -e "$p" ] || continue
    [ ! -e "${p%/*}/.making" ] || { flock -s "${p%/*}/.making" true && ls -a "${p%/*}" > /dev/null; }
    [ -e "$p" ] || return 1
  done
}
# Differs when one of them changed, or is gone.
# shellcheck disable=SC2086  # names of several files
state_of_inputs() { stat -L -c '%n %i %s %.Y' $prerequisites 2> /dev/null || true; }

stop_if_many() {
  [ ! -e "$run" ] || [ "$(wc -l < "$run")" -lt "$STOP_AFTER" ] ||
    { echo "$STOP_AFTER failures in a row, see $ledger; stopped" >&2; exit 1; }
}

# One row per failed try, for people and for pack: one line each, whatever the message holds, and whole or not at all.
ledger=$dataset/failures.csv
row() { # row REASON
  local reason=${1//[$'\n\r']/ }
  [ -s "$ledger" ] || echo 'id,stage,reason,log,time,host'
  printf '%s,%s,"%s",%s,%s,%s\n' "$sample" "$stage" "${reason//\"/\"\"}" "${folder#"$dataset"/}/$stage.log" "$(date -u +%FT%TZ)" "$(hostname)"
}
add_row() { # add_row REASON; with the lock
  local text size
  text=$(row "$1")
  size=$(stat -c %s "$ledger" 2> /dev/null || echo 0)
  { echo "$text" >> "$ledger"; } 2> /dev/null || { truncate -c -s "$size" "$ledger"; return 1; }
}
# The lock is made early, while there is room.
lock=$dataset/.ledger-lock
note_failure() { # note_failure REASON
  { flock 8 && add_row "$1"; } 8<> "$lock" || no_room "$ledger cannot be written"
  write "$run" 'echo "$sample" >> "$run"'
  echo "$sample: $stage failed: $1" >&2
}

# The disk takes nothing more: no other sample would fare better. The first to meet it says so; nothing is left that makes its sample count as failed.
full='nothing more can be written'
reserve=$dataset/.reserve  # room for a row at that time
reserved=16384
# The reserve becomes the ledger. Were it removed first, another stage that still writes could take its room.
row_in_reserve() { # row_in_reserve REASON; with the lock
  local text
  text=$({ [ ! -e "$ledger" ] || cat "$ledger"; } && row "$1")
  [ ${#text} -lt $reserved ] && [ -e "$reserve" ] || return 1
  { echo "$text" 1<> "$reserve" && truncate -s $((${#text} + 1)) "$reserve" && mv "$reserve" "$ledger"; } 2> /dev/null
}
disk_is_full() { [ -e "$run.full" ]; }
no_room() { # no_room REASON
  rm -f "$failed"
  [ -e "$lock" ] || lock=/dev/null  # full from the beginning
  {
    flock 8
    add_row "$1" || row_in_reserve "$1" || { rm -f "$reserve" && add_row "$1"; } || disk_is_full || echo "$ledger cannot be extended" >&2
    if ! disk_is_full; then
      { ln -f "$lock" "$run.full" || : > "$run.full"; } 2> /dev/null || true  # another name takes no room
      echo "$sample: $stage: $1" >&2
      echo "stopped: $full in $dataset ($(df -B MB --output=avail "$dataset" | tail -n 1 | tr -d ' MB') MB free); make room and give the same line again" >&2
    fi
  } 8<> "$lock"
  exit 1
}

# What is written beside the stage says what stands against it, as stages do: write FILE COMMANDS
write() {
  local said
  said=$(eval "$2" 2>&1) || no_room "$1 cannot be written: ${said##*: }"
}

inputs_are_there || exit 0
stop_if_many
if disk_is_full; then exit 1; fi
if [ ! -e "$lock" ] || [ ! -d "${run%/*}" ]; then write "$lock" 'mkdir -p "${run%/*}" && : >> "$lock"'; fi
write "$folder/.making" 'mkdir -p "$folder" && : > "$folder/.making"'
[ -e "$reserve" ] || write "$reserve" 'mine=$reserve-$(hostname)-$$
  { head -c $reserved /dev/urandom > "$mine" && mv "$mine" "$reserve"; } || { rm -f "$mine"; false; }'
# Two runs that were given the same sample: one makes it, the other waits and finds it made. A stage that outlives its make keeps the lock.
exec 9> "$folder/.making"
if ! flock -n 9; then
  flock 9
  ls -a "$folder" > /dev/null  # a client of NFS looks at the folder again
fi
if current "$record"; then exit 0; fi
if [ "${RETRY:-}" != yes ] && current "$failed"; then exit 0; fi
stop_if_many

if [ "$stage" = render ] && [ -e "$folder/../press/.dropped" ]; then
  echo "$sample: what press wrote was dropped after packing; clean-press, then it is made again" >&2
  exit 1
fi
rm -f "$folder/.dropped"
if [ "$stage" = press ]; then rm -f "$folder"/{left,right}/press/.dropped; fi
# Images of another press do not count as made while this one, or render after it, is interrupted.
if [ "$stage" = press ]; then rm -f "$folder"/{..,left,right}/render/render{,.failed}.yaml; fi
command="$*"
write "$folder/.command" 'printf "%s\n%s\n" "$command" "$prerequisites" > "$folder/.command"'  # for a bundle
# What ends because an input changed meanwhile, or was gone for a moment, is no failure: once more with the new one.
for try in 1 2 3; do
  before=$(state_of_inputs)
  status=0
  { said=$(env "$@" 2>&1 >&7); } 7>&1 || status=$?
  case $status in 1 | 2) ;; *) break ;; esac
  [ "$(state_of_inputs)" != "$before" ] || [[ "$said" = *'an input changed while the stage ran'* ]] || break
  rm -f "$failed"
  inputs_are_there || exit 0
  [ "$try" -lt 3 ] || { echo "$sample: $stage: its inputs kept changing; left to the next run" >&2; exit 0; }
done
case $status in
  0)
    [ ! -s "$run" ] || : > "$run" ;;
  2 | 126 | 127)  # wrong configuration; a program that is not there or cannot be started
    echo "$said" >&2
    exit 2 ;;
  1)
    reason=$("$TACIPC" get "$failed" message --default '' 2> /dev/null || true)
    [ -n "$reason" ] || reason=${said##*$'\n'}
    case $reason in
      *'No space left on device'* | *'Disk quota exceeded'* | *'File too large'* | *'Input/output error'* | *'Read-only file system'*) no_room "$reason" ;;
    esac
    note_failure "${reason:-no reason given}" ;;
  129 | 130 | 143) exit "$status" ;;  # interrupted, as make itself is: begun again next time
  *)
    # Killed, by the kernel for want of memory or by itself. Where the whole job is being killed, this does not live to say so.
    sleep 1
    signal=$((status - 128))
    write "$failed" 'printf "stage: %s\nname: %s\nmessage: killed by signal %s\n" "$stage" "$sample" "$signal" > "$failed"'
    note_failure "killed by signal $signal" ;;
esac
