#!/usr/bin/env bash
# The shipped hand grips a block that stands 1.5 mm off its middle, so one finger pushes it along the table before the other meets it: robot and
# press agree in every window; lifted and shaken, the block's weight is what the gels carry in the end.
. "$(dirname "$0")/common.sh"
bin=$build_dir/bin
[ -x "$bin/robot" ] || { echo "robot is not built (libmujoco-dev)"; exit 77; }
task=configs/tasks/off_middle.yaml
sed 's/mass_g: \$mass_g}/mass_g: $mass_g, at_mm: [1.5, 0, 0]}/' configs/tasks/lift_and_shake.yaml > $task
! cmp -s $task configs/tasks/lift_and_shake.yaml || fail "the block of lift_and_shake.yaml is told in another way"
"$bin/tetmesh" --config configs/gels/tiny.yaml --sensor configs/sensors/mctac.yaml --out gel --threads 1 > said.txt 2>&1 || fail "no gel: $(tail -3 said.txt)"
OPENBLAS_NUM_THREADS=1 bash pipelines/sample/couple.sh "$bin" off $task --name off --task $task --seed 1 -- \
  --name off --gel gel/gel.msh --sensor configs/sensors/mctac.yaml --config configs/press/default.yaml --threads 1 > said.txt 2>&1 || { tail -5 said.txt >&2; fail "it does not converge"; }
"$bin/press" --name off --gel gel/gel.msh --sensor configs/sensors/mctac.yaml --config configs/press/default.yaml --threads 1 \
  --sample off/robot/scene.yaml --solved off/solved --out off/press > said.txt 2>&1 || fail "no press of the whole: $(tail -3 said.txt)"
mass=$("$bin/tacipc" get off/robot/robot.yaml variables.mass_g)
/usr/bin/python3 - off "$mass" <<'END'
import csv, sys
import numpy as np
folder, weight = sys.argv[1], 9.81e-3 * float(sys.argv[2])
rows = list(csv.DictReader(open(folder + "/residuals.csv")))
# By force or, where answers jump, by place.
last = {row["first_frame"]: row for row in rows}
for row in last.values():
    assert float(row["residual_relative"]) <= 1e-3 or float(row["apart_m"] or 1) <= 5e-6, row
assert len(rows) <= 90, len(rows)
# Bodies are left, right, block, table.
wrench, pose = np.load(folder + "/press/pair_wrench.npy"), np.load(folder + "/press/body_pose.npy")
felt = np.load(folder + "/robot/pad_wrench.npy")
assert len(wrench) == len(felt)
assert wrench[-1, 2, 3, :3].any() == 0, "the block stands on the table"
assert pose[-1, 2, 2, 3] > 0.008, "the block was not lifted"
first, second = (np.flatnonzero(np.abs(felt[:, p, 0]) > 0.02)[0] for p in (1, 0))
assert second > first + 2, "both fingers meet the block at once"
carried = -felt[-1, :, 2].sum()
assert abs(carried - weight) < 0.01 * weight, (carried, weight)
answered = wrench[:, :2, :, :3].sum(axis=2)
assert np.abs(felt[..., :3] - answered).max() < 1e-3 * np.abs(answered).max() * 1.01
END
echo "1 passed, 0 failed"
