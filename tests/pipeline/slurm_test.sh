#!/usr/bin/env bash
# A dataset through a Slurm of one machine: equal bytes as without; a node drained in mid-run, slurmd killed and jobs cancelled lose
# nothing, count no half sample, and submitting again completes it. SAMPLES=200 takes all of tiny_200.yaml, else 40 of it.
. "$(dirname "$0")/common.sh"
export PATH=$PATH:/usr/sbin:/sbin
for program in slurmctld slurmd munged sbatch; do
  command -v $program > /dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
sed -i 's/^vertices: .*/vertices: 3000/' configs/objects/patterns/*.yaml
sed -i 's/^memory_mb=.*/memory_mb=300/; s/^throttle=.*/throttle=2/' configs/datasets/slurm/default.sh
[ "${SAMPLES:-40}" = 200 ] || sed -i 's/samples: 10/samples: 2/; s/samples: 5/samples: 1/' configs/datasets/tiny_200.yaml
goal() { # goal OUT GOAL [VARIABLE=value …]
  local out=$1 goal=$2
  shift 2
  make -s -f Makefile.data "$goal" CONFIG=configs/datasets/tiny_200.yaml OUT="$out" BUILD="$build_dir" PACKAGES=no REBUILD=no "$@"
}
set_of() { echo "$1/datasets/tiny_200"; }
made() { find "$(set_of cluster)/samples" -path '*/render/render.yaml' | wc -l; }
wait_for() { # wait_for SECONDS WHAT COMMAND...
  local seconds=$1 what=$2
  shift 2
  for _ in $(seq "$((seconds * 5))"); do
    if "$@"; then return 0; fi
    sleep 0.2
  done
  squeue || true
  tail -n 20 slurm/slurmctld.log slurm/slurmd.log "$(set_of cluster)"/slurm/logs/* || true
  fail "waited in vain: $what"
}
queue_is_empty() { [ -z "$(squeue -h -o %i)" ]; }
at_least() { [ "$(made)" -ge "$1" ]; }
node_is() { [[ "$(sinfo -h -o %T)" == $1* ]]; }
working() { [ -n "$(squeue -h -t R -n tiny_200-parts -o %i)" ]; }

# Files of samples, whose records are there: nothing of those that are not made counts.
same_where_made() {
  local sample
  for sample in $(cd "$(set_of cluster)/samples" && find . -path '*/render/render.yaml' -printf '%h\n' | sed 's|/render$||'); do
    diff -rq --exclude='.*' --exclude='*.log' --exclude='*.timings.yaml' "$(set_of local)/samples/$sample" "$(set_of cluster)/samples/$sample" > differ.txt || fail "$1: $(cat differ.txt)"
  done
}

goal local dataset JOBS=2 > local.txt 2>&1 || fail "the dataset is not made locally: $(tail local.txt)"
count=$(grep -o '[0-9]* made' local.txt | cut -d' ' -f1)

export SLURM_CONF=$PWD/slurm/slurm.conf
trap 'bash pipelines/dataset/local_slurm.sh stop slurm; rm -rf "$scratch_root"' EXIT
goal . local-slurm LOCAL_SLURM=slurm CPUS=2 MEMORY_MB=2000
node=$(sinfo -h -N -o %N)

goal cluster submit SHARDS=4
wait_for 120 "the first samples" at_least 3

# Drained: what runs goes on, nothing new begins; then it goes on.
scontrol update nodename="$node" state=drain reason=test
wait_for 20 "the node drains" node_is drain
scontrol update nodename="$node" state=resume

# The node's daemon dies and stays away until the node is given up and its jobs are queued again; what it had started may still run.
wait_for 60 "a part runs" working
kill -KILL "$(cat slurm/slurmd.pid)"
wait_for 60 "the node is given up" node_is down
bash pipelines/dataset/local_slurm.sh slurmd slurm
wait_for 60 "the node comes back" node_is '[im]'
same_where_made "after slurmd was killed"

# Everything cancelled.
if ! queue_is_empty; then
  wait_for 60 "a part runs again" eval 'working || queue_is_empty'
  scancel --user="$(id -un)"
fi
wait_for 60 "the queue is empty" queue_is_empty
same_where_made "after scancel"
before=$(made)
goal cluster status | tee status.txt
grep -q "$count samples: $before made, 0 failed, 0 running" status.txt || fail "status counts other samples than those made"

# Submitted again, in another number of parts: completed, each sample once, with the bytes of the local run.
touch mark
goal cluster submit SHARDS=3 RETRY=yes
wait_for 300 "the jobs end" queue_is_empty
goal cluster status | tee status.txt
grep -q "$count samples: $count made, 0 failed" status.txt || fail "not all samples are made"
[ "$(find "$(set_of cluster)/samples" -path '*/render/render.yaml' -newer mark | wc -l)" = $((count - before)) ] || fail "samples that were there were made again"
same_where_made "in the end"
diff <(cd "$(set_of local)" && find gels objects -type f -not -name '*.log' -not -name '*.timings.yaml' -not -name '.*' -exec md5sum {} + | sort) \
  <(cd "$(set_of cluster)" && find gels objects -type f -not -name '*.log' -not -name '*.timings.yaml' -not -name '.*' -exec md5sum {} + | sort) || fail "gels or objects differ"
cmp "$(set_of local)/plan/samples.csv" "$(set_of cluster)/plan/samples.csv" || fail "the plans differ"
[ ! -e "$(set_of cluster)/failures.csv" ] || fail "a sample failed: $(cat "$(set_of cluster)/failures.csv")"
grep -q "$count samples: $count made" "$(set_of cluster)/slurm/logs/last.log" || fail "the last job did not see it complete"
cmp "$(set_of local)/pack/checksums.sha256" "$(set_of cluster)/pack/checksums.sha256" || fail "the last job did not pack it, or to other bytes"

goal cluster reproduce K=2 || fail "samples cannot be reproduced"
echo "1 passed, 0 failed"
