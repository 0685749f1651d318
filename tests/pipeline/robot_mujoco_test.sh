#!/usr/bin/env bash
# An arm that robot moves goes where MuJoCo's own Python package takes it with the same controls.
. "$(dirname "$0")/common.sh"
[ -x "$build_dir/bin/robot" ] || { echo "robot is not built (libmujoco-dev)"; exit 77; }
/usr/bin/python3 -m venv --system-site-packages python
python/bin/pip install --quiet --disable-pip-version-check --only-binary :all: 'mujoco==3.3.*' 2> said.txt || { echo "skipped: mujoco cannot be installed: $(tail -1 said.txt)"; exit 77; }

mkdir mine
cat > mine/table.off <<'END'
OFF
4 4 0
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 1 2 3
3 0 3 2
END
cat > mine/arm.xml <<'END'
<mujoco>
  <compiler angle="degree"/>
  <option timestep="0.001"/>
  <worldbody>
    <body name="table" pos="0 0 -3"><geom type="box" size="1 1 0.1"/></body>
    <body name="ball" pos="0 2 5" euler="10 20 30"><freejoint/><geom type="box" size="0.1 0.2 0.3" pos="0.1 0 0"/></body>
    <body name="shoulder" pos="0 0 0.3" euler="0 0 15">
      <joint name="j1" axis="0 0 1" damping="0.5"/><geom type="sphere" size="0.03"/>
      <body name="upper">
        <joint name="j2" axis="0 1 0" damping="0.5" armature="0.01"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        <body name="lower" pos="0.3 0 0" euler="0 30 0">
          <joint name="j3" axis="0 1 0" damping="0.5"/><geom type="capsule" fromto="0 0 0 0.25 0 0" size="0.02"/>
          <body name="finger" pos="0.25 0 0">
            <joint name="j4" axis="1 0 0" damping="0.3"/><joint name="j5" axis="0 1 0" damping="0.3"/><joint name="j6" axis="0 0 1" damping="0.3"/>
            <joint name="slide" type="slide" axis="1 0 0" damping="2"/>
            <geom name="pad" type="cylinder" size="0.015 0.01" pos="0.02 0.01 0" euler="0 90 0"/><site name="tool" pos="0.04 0 0"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <general name="j1" joint="j1" gainprm="400" biastype="affine" biasprm="0 -400 -20"/>
    <general name="j2" joint="j2" gainprm="800" biastype="affine" biasprm="0 -800 -20"/>
    <general name="j3" joint="j3" gainprm="400" biastype="affine" biasprm="0 -400 -10"/>
    <general name="j4" joint="j4" gainprm="20" biastype="affine" biasprm="0 -20 0"/>
    <general name="j5" joint="j5" gainprm="20" biastype="affine" biasprm="0 -20 0"/>
    <general name="j6" joint="j6" gainprm="20" biastype="affine" biasprm="0 -20 0"/>
    <general name="slide" joint="slide" gainprm="2000" biastype="affine" biasprm="0 -2000 -10"/>
  </actuator>
</mujoco>
END
# A frame in every time step, so that control.npy has all controls.
cat > mine/arm.yaml <<'END'
model: arm.xml
frame_s: 0.001
pads: {name: gel, geom: pad, at_mm: [1, 2, 10], turn_deg: [0, 0, 90]}
objects:
  - {name: table, kind: fixed, mesh: table.off}
  - {name: ball, mesh: table.off, mass_g: 100}
steps:
  - {seconds: 0.2, set: {j1: 0.3, j2: -0.4, j3: 0.8}}
  - {seconds: 0.2, move: {site: tool, by_mm: [20, 30, 10]}}
  - {seconds: 0.3, limit: {slide: 3}, set: {slide: 0.02}, smooth: false}
  - {seconds: 0.3, shake: {site: tool, amplitude_mm: [0, 0, 8], frequency_hz: 4}}
END
"$build_dir/bin/robot" --task mine/arm.yaml --out out > said.txt 2>&1 || fail "robot failed: $(tail -3 said.txt)"
python/bin/python "$source_dir/tests/pipeline/check_robot.py" mine/arm.xml out gel pad 0.001,0.002,0.01 90 || fail "robot and MuJoCo's Python differ"
echo "1 passed, 0 failed"
