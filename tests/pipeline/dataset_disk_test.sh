#!/usr/bin/env bash
# The disk fills in the middle of a dataset: the run stops with one message, no sample counts as failed, nothing half made as made, and with
# room again the same line completes it, with the bytes of a run that never met it. On a small file system of its own where one may
# be mounted; else a limit on the size of files stands for it.
. "$(dirname "$0")/common.sh"
if [ "${MOUNTED:-}" = "" ]; then
  for private in "unshare -m" "unshare -rm"; do
    if $private sh -c 'mount -t tmpfs -o size=1m none "$0"' "$scratch" 2> /dev/null; then MOUNTED=yes $private bash "$source_dir/tests/pipeline/dataset_disk_test.sh" "$@"; exit; fi
  done
fi
mkdir mine disk
another=''
trap '[ "$another" = "" ] || kill "$another" 2> /dev/null || true; umount "$scratch/disk" 2> /dev/null || true; rm -rf "$scratch_root"' EXIT
cat > mine/set.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects: {meshes: .., only: [pyramid], unit: mm}
motions:
  - {name: down, samples: 8, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: [0.2, 0.3], steps: 1}}
outputs: {pack: none}
stop_after_failures: 100
END
goal() { # goal OUT GOAL [VARIABLE=value …]
  local out=$1 goal=$2
  shift 2
  make -s -f Makefile.data "$goal" CONFIG=mine/set.yaml OUT="$out" BUILD="$build_dir" PACKAGES=no REBUILD=no "$@"
}
samples() { (cd "$1/datasets/set" && find gels objects samples -type f -not -name '*.log' -not -name '*.timings.yaml' -not -name '.*' -print0 | sort -z | xargs -0 md5sum); }
made() { find disk/datasets/set/samples -path '*/render/render.yaml' | wc -l; }
goal whole dataset > /dev/null 2>&1 || fail "the dataset is not made"

[ "${MOUNTED:-}" = yes ] || echo "no file system may be mounted here: a limit on the size of files instead"
# Where a file system may be mounted, at last beside a program that takes whatever room another one frees, from the first sample made.
take_all() {
  until compgen -G 'disk/datasets/set/samples/*/*/render/render.yaml' > /dev/null; do sleep 0.05; done
  while [ ! -e whole/enough ]; do head -c 1m /dev/zero >> disk/taken 2> /dev/null || true; done
  rm -f disk/taken
}
cases=(1 2)
[ "${MOUNTED:-}" != yes ] || cases+=('2 beside another')
for case in "${cases[@]}"; do
  jobs=${case%% *}
  if [ "${MOUNTED:-}" = yes ]; then
    # Room for gel, object and some three samples.
    one=$(du -sk whole/datasets/set/samples/000/* | awk '{ print $1; exit }')
    all=$(du -sk whole/datasets/set | cut -f1)
    mount -t tmpfs -o size=$((all - 5 * one))k none disk
    more() { mount -o remount,size=$((2 * all))k disk; }
    limited() { "$@"; }
    reason='No space left on device'
  else
    goal disk dataset-shared > /dev/null 2>&1
    touch disk/datasets/set/.reserve  # which would be larger than a picture
    more() { :; }
    # Pictures are larger than what the press writes.
    largest=$(find whole/datasets/set/samples -path '*/render/*' -type f -printf '%s\n' | sort -n | tail -n 1)
    limited() { (ulimit -f $((largest / 1024 - 1)); "$@"); }
    reason='File too large'
  fi
  if [ "$case" != "$jobs" ]; then
    take_all &
    another=$!
  fi
  limited goal disk dataset JOBS="$jobs" > said.txt 2>&1 && fail "a full disk went unseen"
  before=$(made)
  [ "$(grep -c '^stopped: nothing more can be written in disk/datasets/set ([0-9]* MB free); make room and give the same line again$' said.txt)" = 1 ] || fail "not one message: $(cat said.txt)"
  [ "$(grep -c "$reason" said.txt)" = 1 ] || fail "the reason is not said once: $(cat said.txt)"
  grep -q 'line [0-9]*:' said.txt && fail "a script complains: $(cat said.txt)"
  [ "$before" -lt 8 ] || fail "the disk did not fill"
  [ "${MOUNTED:-}" != yes ] || [ "$before" -ge 1 ] || fail "the disk was full from the beginning"
  tries=$(tail -n +2 disk/datasets/set/failures.csv | wc -l)
  [ "$tries" -ge 1 ] && [ "$tries" -le "$jobs" ] || fail "samples failed one after another: $(cat disk/datasets/set/failures.csv)"
  grep -qv -e '^id,stage,reason,log,time,host$' -e "^mctac__pyramid__down__[0-9]*,[a-z]*,\".*$reason\",samples/000/.*$" disk/datasets/set/failures.csv && fail "the ledger is damaged: $(cat disk/datasets/set/failures.csv)"
  goal disk status > status.txt
  grep -q "^set: 8 samples: $before made, 0 failed, 0 running, $((8 - before)) left$" status.txt || fail "half a sample counts, or a failed one: $(cat status.txt)"
  # What counts as made is whole.
  for sample in $(find disk/datasets/set/samples -path '*/render/render.yaml' -printf '%P\n' | sed 's|/render/render.yaml$||'); do
    diff -rq --exclude='.*' --exclude='*.log' --exclude='*.timings.yaml' "whole/datasets/set/samples/$sample" "disk/datasets/set/samples/$sample" || fail "$sample counts as made and is not"
  done
  [ "$another" = "" ] || { touch whole/enough && wait "$another" && another=''; }
  more
  goal disk dataset JOBS="$jobs" > said.txt 2>&1 || fail "with room again it cannot be completed: $(cat said.txt)"
  [ "$(samples whole)" = "$(samples disk)" ] || fail "it ends in other bytes"
  if [ "${MOUNTED:-}" = yes ]; then umount disk; else rm -rf disk; mkdir disk; fi
done
echo "1 passed, 0 failed"
