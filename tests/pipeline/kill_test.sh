#!/usr/bin/env bash
# Killing a run (SIGKILL) in the middle of every stage and running again ends in the same bytes; also where only make is killed
# and the stage lives on.
. "$(dirname "$0")/common.sh"

tiny_sample whole
start() { # start OUT: the pipeline in a process group of its own; sets leader
  setsid bash -c '. /dev/stdin' < <(declare -f tiny_sample; echo "build_dir='$build_dir'; tiny_sample $1 JOBS=1 >/dev/null 2>&1") &
  leader=$!
}
# A stage is at work from the moment its log exists until its record does.
working() { [ -n "$(find "$1" -name "$2.log" -newer mark 2>/dev/null)" ] && [ -z "$(find "$1" -name "$2.yaml" -not -path '*/.partial-*' 2>/dev/null)" ]; }
done_by() { [ -n "$(find "$1" -name "$2.yaml" -not -path '*/.partial-*' 2>/dev/null)" ]; }
wait_for() { # wait_for OUT STAGE: until it works, or has been too quick to be seen
  for _ in $(seq 4000); do
    if working "$1" "$2" || done_by "$1" "$2"; then return 0; fi
    sleep 0.005
  done
  fail "never saw $2 at work"
}

touch mark
for stage in decimate tetmesh press render report; do
  for delay in 0 0.02; do
    rm -rf killed
    struck=no
    for _ in 1 2 3 4 5 6; do  # a short stage may be over before the blow falls
      start killed
      wait_for killed "$stage"
      sleep "$delay"
      kill -KILL -- "-$leader"
      wait "$leader" 2>/dev/null || :
      done_by killed "$stage" || { struck=yes; break; }
      rm -rf killed
    done
    [ "$struck" = yes ] || [ "$delay" != 0 ] || [[ "decimate tetmesh report" == *$stage* ]] || fail "$stage was always done before it could be killed"
    # Whatever record exists by now must be that of the whole run: nothing half-made may look done.
    [ "$struck" = no ] || for record in $(cd killed && find . -name '*.yaml' -not -name '*.timings.yaml' -not -path '*/.partial-*'); do
      cmp "killed/$record" "whole/$record" || fail "with $stage killed, $record is not the finished one"
    done
    tiny_sample killed
    same_files killed whole
  done
done

# Only make dies; the stage it started still writes while the next run begins.
rm -rf orphan
start orphan
wait_for orphan press
pkill -KILL -x make -g "$leader" || fail "no make to kill"
tiny_sample orphan
wait "$leader" 2>/dev/null || :
same_files orphan whole
echo "1 passed, 0 failed"
