#!/usr/bin/env bash
# Scenes and grasps of strangers: the shipped ones, shortened and changed at random, through press (tests/pipeline/strange_scenes.py).
# CONTRIBUTING.md says how to run more than these, and with sanitizers.
. "$(dirname "$0")/common.sh"
mkdir strange
"$build_dir/bin/tetmesh" --sensor configs/sensors/mctac.yaml --config configs/gels/tiny.yaml --out gel --log-level off
write_l l.stl 2
echo 'unit: mm' > strange/object.yaml
"$build_dir/bin/decimate" --mesh l.stl --object strange/object.yaml --config configs/objects/decimate/default.yaml --out strange/object --log-level off
python3 "$source_dir/tests/pipeline/strange_scenes.py" "${TACIPC_MUTATED_BIN:-$build_dir/bin}" "$source_dir" gel/gel.msh strange \
  "${TACIPC_MUTATIONS:-60}" "${TACIPC_FIRST_MUTATION:-0}" || fail "press does not end as it should"
echo "1 passed, 0 failed"
