#!/usr/bin/env bash
# A weight on a vertical slide is set on a point by a robot whose pad is a gel: robot and press agree in every window, the gel carries the weight
# in the end; the same bytes on one thread and two, and after a kill; nothing to do a second time; what is wrong is told and ends the run.
. "$(dirname "$0")/common.sh"
bin=$build_dir/bin
[ -x "$bin/robot" ] || { echo "robot is not built (libmujoco-dev)"; exit 77; }

mkdir mine
# Tip up at the origin, mm.
cat > mine/point.off <<'END'
OFF
5 6 0
0 0 0
3 3 -2
-3 3 -2
-3 -3 -2
3 -3 -2
3 0 1 2
3 0 2 3
3 0 3 4
3 0 4 1
3 1 4 3
3 1 3 2
END
cat > mine/slide.xml <<'END'
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <body name="point"><geom type="box" size="0.003 0.003 0.001" pos="0 0 -0.001"/></body>
    <body name="weight" pos="0 0 0.0105">
      <joint name="z" type="slide" axis="0 0 1" damping="6"/>
      <geom name="pad" type="cylinder" size="0.015 0.01" mass="0.06"/>
      <site name="tip"/>
    </body>
  </worldbody>
</mujoco>
END
cat > mine/slide.yaml <<'END'
model: slide.xml
pads: {name: gel, geom: pad, at_mm: [0, 0, -10], turn_deg: [180, 0, 0]}
objects: {name: point, kind: fixed, mesh: point.off, unit: mm}
steps: {seconds: 0.3}
END

robot() { # robot OUT TASK [VARIABLE=value …]
  make -s -f Makefile.data robot TASK="mine/$2.yaml" MESH=tiny OUT="$1" BUILD="$build_dir" PACKAGES=no REBUILD=no "${@:3}" > said.txt 2>&1
}
robot one slide THREADS=1 || { tail -5 said.txt >&2; fail "the goal failed"; }
folder=one/robot/slide
[ "$("$bin/tacipc" get $folder/press.yaml summary.verdict)" = pass ] || fail "its verdict is not pass"
[ "$("$bin/tacipc" get $folder/press.yaml summary.frames)" = 31 ] || fail "there are not 31 frames"
/usr/bin/python3 - $folder <<'END'
import csv, sys
import numpy as np
folder = sys.argv[1]
rows = list(csv.DictReader(open(folder + "/residuals.csv")))
last = {row["first_frame"]: row for row in rows}
assert all(float(row["residual_relative"]) <= 1e-3 for row in last.values()), rows
assert sum(int(row["frames"]) for row in last.values()) == 30, rows
assert len(rows) <= 30, rows
felt = np.load(folder + "/robot/pad_wrench.npy")[:, 0]
# Bodies are gel and point; wrenches about the world's origin, which is on the slide's axis.
pressed = np.load(folder + "/pair_wrench.npy")[:, 0, 1]
assert np.abs(felt[:, :3] - pressed[:, :3]).max() <= 1.01e-3 * np.abs(pressed[:, :3]).max(), "the last press answers otherwise"
weight = 0.06 * 9.81
assert abs(felt[-1, 2] - weight) < 0.005 * weight and abs(pressed[-1, 2] - weight) < 0.005 * weight, (felt[-1], pressed[-1])
assert abs(np.load(folder + "/robot/qvel.npy")[-1, 0]) < 1e-4
assert np.abs(np.load(folder + "/body_pose.npy")[:, 0] - np.load(folder + "/robot/pad_pose.npy")[:, 0]).max() < 1e-9, "the gel is not where the robot has it"
END

before=$(find one -type f -not -name '*.log' -printf '%p %T@\n' | sort)
robot one slide THREADS=1 || fail "a second run failed"
[ "$before" = "$(find one -type f -not -name '*.log' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"

# Killed within the third window, and gone on with on another number of threads.
couple() { # couple OUT TASK THREADS [PRESS_FLAG …]
  OPENBLAS_NUM_THREADS=1 exec bash pipelines/sample/couple.sh "$bin" "$1" "mine/$2.yaml" --name slide --task "mine/$2.yaml" --seed 1 -- \
    --name slide --gel one/gels/mctac-tiny/gel.msh --sensor configs/sensors/mctac.yaml --config "${4:-configs/press/default.yaml}" --threads "$3"
}
export -f couple
export bin
setsid bash -c 'couple killed/robot/slide slide 2' > said.txt 2>&1 &
killed=$!
for _ in $(seq 12000); do [ ! -e killed/robot/slide/windows/0003/5/02/robot/robot.yaml ] || break; sleep 0.005; done
kill -KILL -- -$killed 2> /dev/null || fail "the run was over before it could be killed: $(tail -3 said.txt)"
wait $killed 2> /dev/null || :
[ ! -e killed/robot/slide/robot ] || fail "it was killed too late"
(couple killed/robot/slide slide 2) > said.txt 2>&1 || { tail -5 said.txt >&2; fail "the run after a kill failed"; }
grep -q 'window 2:' said.txt && fail "it began anew"
again=killed/robot/slide
for array in "$again"/robot/{*.npy,paths/gel.npy,contacts.csv,scene.yaml} "$again"/residuals.csv "$again"/solved/*; do
  cmp "$array" "one/${array#killed/}" || fail "$array is another one on two threads and after a kill"
done
[ "$(find $folder/solved -type f | wc -l)" = "$(find $again/solved -type f | wc -l)" ] || fail "there are other solved frames"

# Windows of another model are none of this run, were it in a file that the model includes.
sed -i 's#<site name="tip"/>#<include file="part.xml"/>#' mine/slide.xml
echo '<mujocoinclude><site name="tip"/></mujocoinclude>' > mine/part.xml
sed 's/seconds: 0.3/seconds: 0.03/' mine/slide.yaml > mine/short.yaml
(couple short short 1) > said.txt 2>&1 || fail "a short run failed: $(tail -3 said.txt)"
(couple short short 1) > said.txt 2>&1
! grep -q 'window 1:' said.txt || fail "a short run was made twice"
echo '<mujocoinclude><site name="tip" pos="0 0 0.001"/></mujocoinclude>' > mine/part.xml
(couple short short 1) > said.txt 2>&1
grep -q 'window 1:' said.txt || fail "the windows of another model were taken"

# The robot alone, by MuJoCo's contact with a pad that is not much softer than the gel: the gel goes where its pad did.
sed -i 's#type="cylinder"#& solref="-300000 -1000"#' mine/slide.xml
robot alone slide ALONE=yes || { tail -5 said.txt >&2; fail "a robot alone failed"; }
[ "$("$bin/tacipc" get alone/robot/slide/press.yaml summary.verdict)" = pass ] || fail "the verdict of a robot alone is not pass"
[ ! -e alone/robot/slide/residuals.csv ] || fail "a robot alone has windows"
/usr/bin/python3 - alone/robot/slide <<'END'
import sys
import numpy as np
folder = sys.argv[1]
gel, pad = np.load(folder + "/body_pose.npy")[:, 0], np.load(folder + "/robot/pad_pose.npy")[:, 0]
assert gel.shape == pad.shape == (31, 4, 4) and np.abs(gel - pad).max() < 1e-9, "the gel is not where the robot has it"
assert np.load(folder + "/pair_wrench.npy")[-1, 0, 1, 2] > 0.001, "the gel touches nothing"
END

wrong() { # wrong CODE MESSAGE COMMAND …
  refused "$@"
  ! grep -q 'does not converge' said.txt || fail "$*: taken for a window that does not converge"
}
apart() { (couple "$@"); }
sed 's/steps: .*/steps: {seconds: 0.1, move: {site: tip, by_mm: [0, 0, 5]}}/' mine/slide.yaml > mine/stuck.yaml
wrong 1 'site tip cannot go there' apart five stuck 1
sed 's/geom: pad/geom: pod/' mine/slide.yaml > mine/unknown.yaml
wrong 2 "has no geom 'pod'; it has pad" apart five unknown 1
echo 'no_such_key: 1' > mine/press.yaml
wrong 2 'no_such_key: unknown key' apart five slide 1 mine/press.yaml
sed 's/point.off/gone.off/' mine/slide.yaml > mine/gone.yaml
wrong 2 'object point: mesh: mine/gone.off does not exist' robot five gone
wrong 2 '--frames: ' "$bin/robot" --task mine/slide.yaml --frames -3 --out five/robot
wrong 2 '--press: has no effect without --frames' "$bin/robot" --task mine/slide.yaml --press $folder --out five/robot
wrong 2 '--press is missing' "$bin/robot" --task mine/slide.yaml --start $again/robot --frames 5 --out five/robot
make_says() { wrong 2 "$1" make -s -f Makefile.data robot OUT=five BUILD="$build_dir" PACKAGES=no REBUILD=no "${@:2}"; }
make_says 'robot: say which task'
make_says 'TASK: nothing.yaml does not exist' TASK=nothing.yaml
make_says 'OBJECT: has no effect on a robot' TASK=mine/slide.yaml OBJECT=pyramid.stl
echo "1 passed, 0 failed"
