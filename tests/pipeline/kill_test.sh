#!/usr/bin/env bash
# Killing a run (SIGKILL to every process of it) at many moments and running again ends in the same bytes.
. "$(dirname "$0")/common.sh"

tiny_sample whole
mkdir killed
for delay in 0.05 0.15 0.3 0.5 0.7 0.9 1.2 1.6 2.2; do
  setsid bash -c '. /dev/stdin' < <(declare -f tiny_sample; echo "build_dir='$build_dir'; tiny_sample killed >/dev/null 2>&1") &
  leader=$!
  sleep "$delay"
  kill -KILL -- "-$leader" 2>/dev/null || true
  wait "$leader" 2>/dev/null || true
  # Whatever record exists by now must be that of the whole run: nothing half-made may look done.
  for record in $(cd killed && find . -name '*.yaml' -not -path '*/.partial-*'); do
    cmp "killed/$record" "whole/$record" || fail "after $delay s $record is not the finished one"
  done
done
tiny_sample killed
same_files killed whole
echo "1 passed, 0 failed"
