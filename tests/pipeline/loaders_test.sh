#!/usr/bin/env bash
# Three datasets (presses with shear; grasps, of which one is impossible, beside presses; both once more after samples have failed) in each layout,
# read back by the packages of PyPI that the layouts are for, and the lines on the first screen of docs/pack.md.
. "$(dirname "$0")/common.sh"
python=$build_dir/loaders/bin/python
[ -e "$build_dir/loaders/installed" ] || { echo 'skipped: no packages of PyPI (make -f Makefile.data loaders-python)'; exit 77; }
export PYTHONPATH=$source_dir/tests/pipeline HF_HUB_OFFLINE=1 TQDM_DISABLE=1
goal() { # goal DATASET GOAL [VARIABLE=value …]
  make -s -f Makefile.data "$2" "DATASET_DIR=out/datasets/$1" CONFIG="mine/$1.yaml" OUT=out BUILD="$build_dir" PACKAGES=no REBUILD=no "${@:3}" > said.txt 2>&1
}
made=()
repack() { # repack DATASET: in the layouts that other packages read
  local format
  for format in webdataset univtac lerobot; do goal "$1" repack FORMAT=$format || fail "$format of $1: $(cat said.txt)"; done
  made+=("out/datasets/$1")
}

mkdir -p mine/objects
cat > mine/press.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects: {meshes: .., only: [pyramid, tilted.v2], unit: mm}
render: ../configs/render/many_frames.yaml
motions:
  - {name: down, samples: 2, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: [0.2, 0.3], steps: 2}}
  - name: drag
    samples: 1
    placement: {rotate_deg: [0, 90]}
    motion: [{kind: press, depth_mm: [0.2, 0.3], steps: 1}, {kind: shear, distance_mm: 0.1, direction_deg: 30, steps: 2}]
splits: {test_objects: [tilted.v2]}
outputs: {shard_mb: 1, keep: [press, render]}
END
sed 's/ 0 0 0$/ 0.3 0.2 0/' pyramid.stl > tilted.v2.stl
goal press dataset JOBS=2 || fail "no presses: $(tail -5 said.txt)"
repack press

# An L of 8 mm bars that hands lift or lose, and a block that no hand opens for.
write_l mine/objects/l.stl 8
write_l mine/objects/wide.stl 60
cat > mine/grasps.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects: {meshes: objects, unit: mm}
render: ../configs/render/many_frames.yaml
motions:
  - {name: down, samples: 1, motion: {kind: press, depth_mm: 0.2, steps: 1}}
  - name: lift
    samples: 3
    fingers: {draw: {width_mm: [2, 40]}}
    object: {friction_margin: [2, 4]}
    motion: [{kind: close, force_n: [1, 1.5], steps: 2}, {kind: lift, distance_mm: [0.5, 1], steps: 2}]
  - name: lose
    samples: 1
    fingers: {draw: {width_mm: [2, 40]}}
    object: {friction_margin: 0.2}
    motion: [{kind: close, force_n: 1, steps: 2}, {kind: lift, distance_mm: 2, steps: 4}, {kind: hold, steps: 6}]
outputs: {shard_mb: 1, keep: [press, render]}
END
goal grasps dataset JOBS=2 && fail "a block of 60 mm is grasped"
grep -q '^grasps: 18 samples: 10 made, 8 failed' said.txt || fail "not all are made: $(tail -5 said.txt)"
repack grasps

# A press and one finger whose images failed later: the other finger is in no episode, and that is said.
fail_later() { # fail_later DATASET MOTION NUMBER
  local folder
  folder=$("$build_dir/bin/tacipc" table "$1/plan/samples.csv" --columns folder --where motion="$2" | sed -n "$3"p)
  rm -r "${1:?}/$folder/render"
  mkdir "$1/$folder/render"
  printf 'stage: render\nmessage: "no light"\n' > "$1/$folder/render/render.failed.yaml"
}
cp -r out/datasets/press out/datasets/fewer
cp -r out/datasets/grasps out/datasets/alone
cp mine/press.yaml mine/fewer.yaml
cp mine/grasps.yaml mine/alone.yaml
fail_later out/datasets/fewer drag 1
fail_later out/datasets/alone lift 2
for name in fewer alone; do
  goal $name pack || fail "no pack of $name: $(cat said.txt)"
  repack $name
done
for format in lerobot univtac; do
  grep -q '^ *fingers_left_out: 1$' out/datasets/alone/repack/$format/repack.yaml || fail "$format: no word on the finger that is alone"
  grep -q 'fingers_left_out' out/datasets/grasps/repack/$format/repack.yaml && fail "$format: a finger is left out"
done

check() { "$python" "$source_dir/tests/pipeline/check_loaders.py" "$@"; }
check univtac "${made[@]}" || fail "the rules of UniVTAC's reader do not read the export"
check webdataset "$PWD/scratch" "${made[@]}" || fail "the readers of WebDatasets do not read the export"
check lerobot "$PWD/scratch" "${made[@]}" || fail "lerobot does not read the export"

HF_HOME=$PWD/scratch/hf "$python" - "$source_dir/docs/pack.md" out/datasets/press <<'END' || fail "the first lines of docs/pack.md do not load"
import contextlib, io, re, sys
import lerobot_on_debian
lines = open(sys.argv[1]).read().splitlines()
loaders = re.findall(r"```python\n(.*?)```", "\n".join(lines[:40]), re.DOTALL)
assert [re.search("h5py|lerobot|webdataset", code)[0] for code in loaders] == ["h5py", "lerobot", "webdataset"], loaders
for code in loaders:
    said = io.StringIO()
    assert len(code.splitlines()) <= 5, code
    with contextlib.redirect_stdout(said):
        exec(code.replace("out/datasets/mini", sys.argv[2]), {})
    assert len(said.getvalue().splitlines()) >= 3, (code, said.getvalue())
END
echo "1 passed, 0 failed"
