#!/usr/bin/env bash
# Writes and submits the Slurm jobs of a dataset: dataset_submit.sh DATASET SITE SHARDS MAKE-VARIABLES...
# One job makes gels and objects, an array of SHARDS elements the samples, and one job the end of the run. An element
# makes one part of the samples one after the other on one core; if it is killed, requeued or submitted again, it
# resumes. Job ids are appended to DATASET/slurm/jobs.txt.
# shellcheck disable=SC2016  # what the jobs expand
set -euo pipefail
dataset=$1 site=$2 shards=$3
shift 3
partition='' account='' time='' memory_mb='' throttle='' options='' setup='' run=''
# shellcheck disable=SC1090
. "$site"
[[ "$shards" =~ ^[1-9][0-9]*$ ]] || { echo "submit: SHARDS=$shards is not a number of parts" >&2; exit 2; }
command -v sbatch > /dev/null || { echo "submit: there is no sbatch here; on this machine alone use the goal dataset (or local-slurm to try)" >&2; exit 1; }
[[ "$dataset" = /* ]] || dataset=$PWD/$dataset
name=$(basename "$dataset")
threads=1
for variable in "$@"; do
  case $variable in THREADS=*) threads=${variable#*=} ;; esac
done
# memory_mb applies to a part, Slurm's value to a core.
[ -z "$memory_mb" ] || memory_mb=$(((memory_mb + threads - 1) / threads))
# If other nodes do not see a lock, two of them may make the same sample.
mounted=$(findmnt -n -o SOURCE,FSTYPE,OPTIONS -T "$(dirname "$dataset")" 2> /dev/null || true)
if grep -Eq '[ ,](localflock|noflock|nolock|local_lock=(all|flock))(,|$)' <<< "$mounted"; then
  echo "submit: locks on this file system stay on one node ($mounted): submit again only when no job of $name is left" >&2
fi
mkdir -p "$dataset/slurm/logs"

script() { # script NAME LOG SBATCH-OPTIONS... -- GOAL [VARIABLE=value ...]
  local file=$dataset/slurm/$1.sh log=$2 option
  {
    echo '#!/bin/bash'
    echo "#SBATCH --job-name=$name-$1"
    shift 2
    printf '#SBATCH --%s\n' "output=$dataset/slurm/logs/$log" open-mode=append requeue nodes=1 ntasks=1 cpus-per-task="$threads"
    for option in ${partition:+--partition=$partition} ${account:+--account=$account} ${time:+--time=$time} \
      ${memory_mb:+--mem-per-cpu=$memory_mb} $options; do
      echo "#SBATCH $option"
    done
    while [ "$1" != -- ]; do echo "#SBATCH $1"; shift; done
    shift
    echo 'echo "== $(date -u +%FT%TZ) $(hostname) job $SLURM_JOB_ID restart ${SLURM_RESTART_COUNT:-0}"'
    echo 'unset MAKEFLAGS MFLAGS MAKELEVEL  # of the make that submitted'
    [ -z "$setup" ] || echo "$setup"
    printf 'cd %q\n' "$PWD"
    echo "exec $run make -s -f Makefile.data $* REBUILD=no PACKAGES=no JOBS=1"
  } > "$file"
}
variables=$(printf '%q ' "$@")
script shared shared.log -- dataset-shared "$variables"
script parts 'part_%a.log' "--array=0-$((shards - 1))${throttle:+%$throttle}" -- dataset-part "$variables" 'PART=$SLURM_ARRAY_TASK_ID' "PARTS=$shards"
script last last.log -- dataset-last "$variables"

shared=$(sbatch --parsable "$dataset/slurm/shared.sh")
parts=$(sbatch --parsable --dependency="afterok:${shared%%;*}" --kill-on-invalid-dep=yes "$dataset/slurm/parts.sh")
last=$(sbatch --parsable --dependency="afterany:${parts%%;*}" "$dataset/slurm/last.sh")
echo "${shared%%;*} ${parts%%;*} ${last%%;*}" >> "$dataset/slurm/jobs.txt"
echo "$name: jobs ${shared%%;*} (gels, objects), ${parts%%;*} (samples in $shards parts), ${last%%;*} (final work); logs in $dataset/slurm/logs"
