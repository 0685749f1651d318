#!/usr/bin/env bash
# Shards of strangers: a press and a grasp packed here, changed so that they point to other files, lie about sizes or are damaged, go through repack,
# card and check_labels.py. The mutations by default are some on which libhdf5 does not hang, which takes a minute each; CONTRIBUTING.md says how to
# run others, and programs with sanitizers.
. "$(dirname "$0")/common.sh"
sed -i 's/width_px: 64/width_px: 16/; s/height_px: 48/height_px: 12/' configs/sensors/mctac.yaml
mkdir -p mine/objects
write_l mine/objects/l.stl 8
cat > mine/set.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects: {meshes: objects, unit: mm}
motions:
  - {name: down, samples: 1, motion: {kind: press, depth_mm: 0.2, steps: 1}}
  - name: lift
    samples: 1
    fingers: {}
    object: {friction_margin: 3}
    motion: [{kind: close, force_n: 1, steps: 2}, {kind: lift, distance_mm: 0.5, steps: 2}]
outputs: {pack: full_sim}
END
make -s -f Makefile.data dataset CONFIG=mine/set.yaml OUT=out BUILD="$build_dir" PACKAGES=no REBUILD=no JOBS=2 > said.txt 2>&1 ||
  fail "no dataset: $(tail -5 said.txt)"
# Debian's Python, which has h5py.
/usr/bin/python3 "$source_dir/tests/pipeline/strange_shards.py" "${TACIPC_MUTATED_BIN:-$build_dir/bin}" "$source_dir" out/datasets/set out/datasets/cage \
  "${TACIPC_MUTATIONS:-40}" "${TACIPC_FIRST_MUTATION:-500}" || fail "a strange shard does harm"
echo "1 passed, 0 failed"
