#!/usr/bin/env bash
# A dataset of grasps beside presses: each finger is a sample, with the same bytes in parts; a dropped object is a label, a grasp that is not
# possible a failure of both fingers; packed, reported, bundled, made again and cleaned like any other.
. "$(dirname "$0")/common.sh"
# An L of 8 mm bars, in millimetres, and a block that no hand of 80 mm opens for.
mkdir -p mine/objects
write_l mine/objects/l.stl 8
cat > mine/set.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects: {meshes: objects, unit: mm}
motions:
  - name: down
    samples: 1
    motion: {kind: press, depth_mm: 0.2, steps: 1}
  - name: lift
    samples: 2
    fingers: {draw: {width_mm: [2, 40]}}
    object: {friction_margin: [2, 4], friction: [0.4, 0.8], center_of_mass_shift_mm: {x: [-2, 2]}}
    motion:
      - {kind: close, force_n: [1, 1.5], steps: 2}
      - {kind: lift, distance_mm: [0.5, 1], steps: 2}
      - {kind: hold, steps: 1}
  - name: lose
    samples: 1
    fingers: {}
    object: {friction_margin: 0.2}
    motion: [{kind: close, force_n: 1, steps: 2}, {kind: lift, distance_mm: 2, steps: 4}, {kind: hold, steps: 6}]
outputs: {keep: [press, render]}
END
goal() { # goal OUT GOAL [VARIABLE=value …]
  local out=$1 goal=$2
  shift 2
  make -s -f Makefile.data "$goal" CONFIG=mine/set.yaml OUT="$out" BUILD="$build_dir" PACKAGES=no REBUILD=no "$@"
}
table() { "$build_dir/bin/tacipc" table "$@"; }
samples() { (cd "$1/datasets/set" && find samples -type f -not -name '*.log' -not -name '*.timings.yaml' -not -name '.*' -print0 | sort -z | xargs -0 md5sum); }

goal whole dataset JOBS=2 > said.txt 2>&1 || { tail -5 said.txt >&2; fail "the dataset was not made"; }
grep -q '^set: 7 samples: 7 made, 0 failed, 0 running, 0 left$' said.txt || fail "not all fingers are made: $(tail -1 said.txt)"
set=whole/datasets/set
lift=mctac__l__lift__000001
[ "$(table $set/plan/samples.csv --columns folder --where motion=lift | head -2 | paste -sd' ')" = "samples/000/$lift/left samples/000/$lift/right" ] ||
  fail "the fingers lie elsewhere"
grep -q '^  draw: {seed: ' "$set/samples/000/$lift/sample.yaml" || fail "no grasp is drawn"
before=$(samples whole)
goal whole dataset > /dev/null 2>&1 || fail "a second run failed"
[ "$before" = "$(samples whole)" ] || fail "a second run did something"

# Packed: labels of the grasp in the table, both fingers of a grasp with the same.
manifest=$set/pack/manifest.csv
labels=$(table $manifest --columns grasp,finger,outcome,motion)
[ "$(grep -c "^$lift"$'\t''\(left\|right\)'$'\tlifted\tlift$' <<< "$labels")" = 2 ] || fail "the fingers' labels differ: $labels"
[ "$(grep -c $'\tdropped\tlose$' <<< "$labels")" = 2 ] || fail "a dropped object is no label: $labels"
grep -q $'^\t\t\tdown$' <<< "$labels" || fail "a press has labels of a grasp: $labels"
grep -q '| lifted | 4 |' $set/pack/README.md || fail "the card does not count outcomes"
/usr/bin/python3 - "$set" "$lift" <<'END' || fail "the shard does not hold the grasp"
import glob, sys, h5py, numpy as np
folder, lift = sys.argv[1:]
samples = {}
for path in glob.glob(folder + "/pack/shards/*.h5"):
    with h5py.File(path) as shard:
        for name, sample in shard["data"].items():
            samples[name] = {**sample.attrs, **{key: sample["obs"][key][...] for key in sample["obs"]}}
            samples[name]["absent"] = [key for key in sample["obs"].attrs]
left, right = (s for s in samples.values() if s.get("grasp") == lift)
assert (left["finger"], right["finger"]) == ("left", "right")
assert left["outcome"] == right["outcome"] == "lifted"
assert left["object_mass_g"] == right["object_mass_g"] > 0
assert 1.9 < left["friction_margin"] < 4.2
assert "reason" not in left and "gross_slip_s" not in left
lost = next(s for s in samples.values() if s.get("outcome") == "dropped")
assert lost["reason"] == "weight" and lost["first_slip_s"] <= lost["gross_slip_s"]
assert 0.2 <= left["mu"] == right["mu"] <= 0.8 and left["mu"] != 0.7 and lost["mu"] == 0.7
assert np.allclose(left["center_of_mass_shift_mm"], right["center_of_mass_shift_mm"]) and abs(left["center_of_mass_shift_mm"][0]) <= 2
grip = np.abs(left["force_N"][-1, 2]), np.abs(right["force_N"][-1, 2])
assert 0.9 < min(grip) and max(grip) < 1.6, grip
world = np.load(f"{folder}/samples/000/{lift}/object_world_twist.npy")
frames = left["frame"]
# Left: z of S is x of the world, y is down; right: z is -x.
assert np.allclose(left["object_velocity_mm_s"][:, 2], 1e3 * world[frames, 0], atol=1e-4)
assert np.allclose(right["object_velocity_mm_s"][:, 2], -1e3 * world[frames, 0], atol=1e-4)
assert np.allclose(left["object_velocity_mm_s"][:, 1], -1e3 * world[frames, 2], atol=1e-4)
assert left["slip_mm"].shape == (len(frames),) and left["slip_mm"][-1] < 1
press = [s for s in samples.values() if s["motion"] == "down"][0]
assert "grasp" not in press and {"absent_object_velocity_mm_s", "absent_slip_mm"} <= set(press["absent"])
END
# Every label follows from what is packed beside it, and one that does not is found: a label, a pose, a force, a state.
/usr/bin/python3 "$set/pack/check_labels.py" "$set"/pack/shards/*.h5 > said.txt || fail "labels differ: $(cat said.txt)"
grep -q '6 of 6 samples agree$' said.txt || fail "not all fingers were checked: $(cat said.txt)"
cat > tamper.py <<'END'
import shutil, sys, h5py, numpy as np
whole, to, what = sys.argv[1:]
shutil.copy(whole, to)
with h5py.File(to, "r+") as shard:
    sample = next(s for s in shard["data"].values() if s.attrs.get("finger") == "right" and s.attrs["outcome"] == "dropped")
    if what in sample.attrs:
        sample.attrs[what] = "lifted" if what == "outcome" else "torque" if what == "reason" else sample.attrs[what] + 0.01
    else:
        field = sample["series/" + what]
        values = field[...]
        values[int(sample.attrs["freed_frame"]):] *= 0.5
        field[...] = values
END
for what in outcome reason first_slip_s gross_slip_s rise_mm end_creep_mm hand_pose object_pose finger_force_N slipping_force_N friction_margin; do
  /usr/bin/python3 tamper.py "$set"/pack/shards/train-*.h5 tampered.h5 "$what" || fail "$what could not be changed"
  /usr/bin/python3 "$set/pack/check_labels.py" tampered.h5 > said.txt && fail "a changed $what went unseen"
  grep -q '5 of 6 samples agree$' said.txt || fail "$what: not one sample differs: $(cat said.txt)"
done
goal whole dataset-report > said.txt 2>&1 || fail "the report failed: $(cat said.txt)"
grep -rq "$lift" $set/report || fail "the report has no grasp"
goal whole estimate > said.txt 2>&1 || fail "the estimate failed: $(cat said.txt)"

# The same in parts, which may begin and end between two fingers; and all of it once more.
goal parts dataset-shared > /dev/null 2>&1 || fail "gels and objects were not made"
for part in 0 1 2 3; do goal parts dataset-part PART=$part PARTS=4 JOBS=1 > /dev/null 2>&1 || fail "part $part failed"; done
[ "$(samples parts)" = "$before" ] || fail "the parts are not the whole"
goal whole reproduce K=7 > said.txt 2>&1 || fail "samples are not the same again: $(cat said.txt)"
grep -qx "$lift/right: equal bytes" said.txt || fail "a finger was not compared: $(cat said.txt)"
right=$(table $set/plan/samples.csv --columns id --where motion=lift | sed -n 2p)
goal whole bundle SAMPLE="$right" > /dev/null || fail "no bundle"
tar -xzf "$set/bundles/$right.tar.gz"
BIN=$build_dir/bin bash "$right/replay.sh" > replay.txt 2>&1 || true
[ "$(grep -c 'is as it was$' replay.txt)" = 2 ] || fail "the bundle does not replay: $(cat replay.txt)"

# Files are dropped, and all is made anew once the press is cleaned.
sed -i 's/keep: .*/keep: []}/' mine/set.yaml
goal whole dataset > said.txt 2>&1 || fail "dropping failed: $(cat said.txt)"
[ ! -e "$set/samples/000/$lift/right/press/positions.npy" ] || fail "the files of a finger were not dropped"
grep -q '7 made' said.txt || fail "dropped samples do not count as made: $(cat said.txt)"
goal whole clean-press || fail "clean-press failed"
goal whole status | grep -q ' 0 made, 0 failed, 0 running, 7 left$' || fail "clean-press left something"
sed -i 's/keep: .*/keep: [press, render]}/' mine/set.yaml
goal whole dataset > said.txt 2>&1 || fail "a cleaned dataset failed: $(cat said.txt)"
[ "$before" = "$(samples whole)" ] || fail "a cleaned dataset is not the same again"

# No grasp is possible: both fingers failed, for a reason, and are not tried again.
sed -i 's/width_mm: \[2, 40\]/width_mm: [2, 5]/' mine/set.yaml
goal whole dataset > said.txt 2>&1 && fail "impossible grasps went unseen"
grep -q '^set: 7 samples: 3 made, 4 failed' said.txt || fail "the fingers did not fail: $(cat said.txt)"
grep -q "^$lift,press,.*wider than 5 mm" $set/failures.csv || fail "the reason is not noted"
grep -q 'wider than 5 mm' $set/pack/failures.csv || fail "the pack does not say why"
[ "$(wc -l < $set/failures.csv)" = 3 ] || fail "a grasp failed more than once: $(cat $set/failures.csv)"
goal whole dataset > /dev/null 2>&1 && fail "failures are forgotten"
[ "$(wc -l < $set/failures.csv)" = 3 ] || fail "failed grasps are tried again"

wrong() { # wrong MESSAGE SED
  sed "$2" mine/set.yaml > mine/wrong.yaml
  make -s -f Makefile.data plan CONFIG=mine/wrong.yaml OUT=four BUILD="$build_dir" PACKAGES=no REBUILD=no > said.txt 2>&1 && fail "$2: was taken"
  grep -q -- "$1" said.txt || fail "$2: not said what is wrong: $(cat said.txt)"
}
wrong 'draw.seed: unknown' 's/draw: {/&seed: 3, /'
wrong 'fingers hold the object' 's/^    fingers: {}/    placement: {}\n&/'
wrong 'fingers close first' 's/kind: close, force_n: \[1, 1.5\]/kind: hold/'
echo "1 passed, 0 failed"
