# shellcheck shell=bash
# The ledger of a dataset, DATASET/failures.csv, for scripts that run a stage: one row per failed attempt. It is
# sourced; the script has set
# dataset: its folder; run: file that counts consecutive failures; stage: name of the stage;
# folder: folder of the stage; failed: file of the stage's failure; sample: name of the result, the id of the row;
# prerequisites: its prerequisites, whose names may have wildcards;
# and has STOP_AFTER and TACIPC in its environment.
# shellcheck disable=SC2016,SC2034,SC2154  # write expands its commands and what they use; names are the script's

# True if a file exists and no prerequisite is newer.
current() {
  [ -e "$1" ] || return 1
  local p
  for p in $prerequisites; do
    if [ "$p" -nt "$1" ]; then return 1; fi
  done
}

# True if all prerequisites exist. A gel or an object is absent for a moment while another run makes it again; without
# the previous stage (which failed) there is nothing to do.
inputs_are_there() {
  local p
  for p in $prerequisites; do
    [ ! -e "$p" ] || continue
    [ ! -e "${p%/*}/.making" ] || [ "${p%/*}" = "$folder" ] || { flock -s "${p%/*}/.making" true && ls -a "${p%/*}" > /dev/null; }
    [ -e "$p" ] || return 1
  done
}
# Text that differs if a prerequisite changed or is gone.
# shellcheck disable=SC2086  # names of several files
state_of_inputs() { stat -L -c '%n %i %s %.Y' $prerequisites 2> /dev/null || true; }

stop_if_many() {
  [ ! -e "$run" ] || [ "$(wc -l < "$run")" -lt "$STOP_AFTER" ] ||
    { echo "$STOP_AFTER failures in a row, see $ledger; stopped" >&2; exit 1; }
}

# One row per failed attempt, for people and for pack: one line each for any message, and complete or absent.
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
# The lock is made early, while there is disk space.
lock=$dataset/.ledger-lock
note_failure() { # note_failure REASON
  { flock 8 && add_row "$1"; } 8<> "$lock" || no_room "$ledger cannot be written"
  write "$run" 'echo "$sample" >> "$run"'
  echo "$sample: $stage failed: $1" >&2
}

# The disk is full: no other sample would succeed either. The first script to meet this reports it, and nothing is left
# that makes its sample count as failed.
full='nothing more can be written'
reserve=$dataset/.reserve  # room for a row at that time
reserved=16384
# The reserve becomes the ledger. If it were removed first, another stage that is still writing could take its space.
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

# A failed write next to the stage is reported as stages report theirs: write FILE COMMANDS
write() {
  local said
  said=$(eval "$2" 2>&1) || no_room "$1 cannot be written: ${said##*: }"
}

# Before a stage runs: stop if the run is over, and make locks and a reserve for a row while there is disk space.
prepare_ledger() {
  stop_if_many
  if disk_is_full; then exit 1; fi
  if [ ! -e "$lock" ] || [ ! -d "${run%/*}" ]; then write "$lock" 'mkdir -p "${run%/*}" && : >> "$lock"'; fi
  write "$folder/.making" 'mkdir -p "$folder" && : > "$folder/.making"'
  [ -e "$reserve" ] || write "$reserve" 'mine=$reserve-$(hostname)-$$
    { head -c $reserved /dev/urandom > "$mine" && mv "$mine" "$reserve"; } || { rm -f "$mine"; false; }'
}

# run_noting_failure COMMAND...: runs a stage; its messages are in $said. Exit 1: the disk is full; 2: wrong
# configuration. Other failures are in the ledger.
run_noting_failure() {
  local try before status reason signal
  said=''
  # A stage that ends because an input changed or was absent for a moment has not failed: it runs once more.
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
      # Killed, by the kernel for lack of memory or by itself. If the whole job is being killed, this script does not
      # survive to report it.
      sleep 1
      signal=$((status - 128))
      write "$failed" 'printf "stage: %s\nname: %s\nmessage: killed by signal %s\n" "$stage" "$sample" "$signal" > "$failed"'
      note_failure "killed by signal $signal" ;;
  esac
}
