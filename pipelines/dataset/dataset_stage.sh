#!/usr/bin/env bash
# Runs one stage of one sample, for make: dataset_stage.sh DATASET RUN STAGE RECORD PREREQUISITES COMMAND...
# Exit 0: made, made by another run meanwhile, or failed and recorded in DATASET/failures.csv, so that make continues
# with the others.
# Exit 1: too many failures in a row (STOP_AFTER), or the disk is full. That is not an error of the sample, which counts
# as not attempted.
# Exit 2: the configuration is wrong.
# A sample that failed before is skipped until an input changes or RETRY=yes.
# shellcheck disable=SC2016,SC2034  # write expands its commands, and dataset_ledger.sh takes names that are set here
set -euo pipefail
export LC_ALL=C
dataset=$1 run=$2 stage=$3 record=$4 prerequisites=$5
shift 5
folder=${record%/*} sample=${record#"$dataset"/samples/*/}  # without processes: a tiny sample is as quick as these
sample=${sample%/"$stage.yaml"}
sample=${sample%/"$stage"}  # the rest is the grasp's name; for the images of a finger with /left or /right
failed=$folder/$stage.failed.yaml
# shellcheck source=pipelines/dataset/dataset_ledger.sh
. "${BASH_SOURCE[0]%/*}/dataset_ledger.sh"

# The press of a sample whose object could not be made fails with it; the ledger only has the object's row.
fail_with_object() {
  local p cause reason text
  for p in $prerequisites; do
    cause=${p%.yaml}.failed.yaml
    case $p in "$dataset"/objects/*) [ ! -e "$p" ] && [ -e "$cause" ] || continue ;; *) continue ;; esac
    if [ "$stage" != press ] || [ ! "$cause" -nt "$failed" ]; then return; fi
    reason=$("$TACIPC" get "$cause" message --default 'no reason given')
    reason="its object cannot be made: ${reason//$'\n'/ }"
    rm -f "$record" "$folder"/{..,left,right}/render/render{,.failed}.yaml
    text=$(printf "stage: %s\nname: %s\nmessage: '%s'" "$stage" "$sample" "${reason//\'/\'\'}")
    write "$failed" 'mkdir -p "$folder" && echo "$reason; see ${cause%.failed.yaml}.log" > "$folder/$stage.log" &&
      echo "$text" > "$folder/.failed-$stage" && mv "$folder/.failed-$stage" "$failed"'
    return
  done
}

inputs_are_there || { fail_with_object; exit 0; }
prepare_ledger
# If two runs have the same sample, one makes it, and the other waits and finds it made. A stage that outlives its make
# keeps the lock.
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
run_noting_failure "$@"
