#!/usr/bin/env bash
# Makes a gel or an object of a dataset, for make: dataset_shared.sh DATASET RUN RECORD PREREQUISITES COMMAND...
# (prerequisites may have wildcards).
# Several runs may find it missing or old: one makes it, the others wait and use it. If each made it again, it would be
# absent for a moment while samples are made from it, and then newer than they are.
# A gel that cannot be made stops make. An object that cannot is recorded in DATASET/failures.csv and skipped until an
# input changes or RETRY=yes; its samples then fail by dataset_stage.sh, and make continues with the others. Exit codes
# are those of dataset_stage.sh.
# shellcheck disable=SC2034  # names that dataset_ledger.sh takes
set -euo pipefail
export LC_ALL=C
shopt -s nullglob
dataset=$1 run=$2 record=$3 prerequisites=$4
shift 4
folder=${record%/*} stage=$(basename "$record" .yaml)
sample=${folder#"$dataset"/objects/} failed=$folder/$stage.failed.yaml
# shellcheck source=pipelines/dataset/dataset_ledger.sh
. "${BASH_SOURCE[0]%/*}/dataset_ledger.sh"
sample=objects/${sample%%/*}  # emboss and wrap have folders inside the object's
mkdir -p "$folder"
exec 9> "$folder/.making"
if ! flock -n 9; then
  flock 9
  ls -a "$folder" > /dev/null  # a client of NFS looks at the folder again
fi
if current "$record"; then exit 0; fi
case $folder in "$dataset"/gels/*) exec env "$@" ;; esac

# If another stage failed to make an input, the reason is that stage's.
for p in $prerequisites; do
  cause=${p%.yaml}.failed.yaml
  if [ -e "$p" ] || [ ! -e "$cause" ]; then continue; fi
  rm -f "$record"
  [ ! "$cause" -nt "$failed" ] || cp "$cause" "$failed"
  exit 0
done
if [ "${RETRY:-}" != yes ] && current "$failed"; then exit 0; fi
prepare_ledger
run_noting_failure "$@"
if [ -n "$said" ] && [ -e "$record" ]; then echo "$said" >&2; fi  # warnings; those of samples are only in their logs, because there are too many
