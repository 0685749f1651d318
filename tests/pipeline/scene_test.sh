#!/usr/bin/env bash
# The goal scene on the three shipped examples: each passes its verdict and does what it is called; the same bytes on one thread and two, and
# after a kill; nothing to do a second time; wrong files and names are told.
. "$(dirname "$0")/common.sh"
bin=$build_dir/bin

scene() { # scene OUT EXAMPLE [VARIABLE=value …]
  local out=$1 file=$2
  shift 2
  make -s -f Makefile.data scene SCENE="configs/scenes/$file.yaml" MESH=tiny OUT="$out" BUILD="$build_dir" PACKAGES=no "$@" > said.txt 2>&1
}
# Debian's Python, which has numpy.
number() { # number FOLDER EXPRESSION: of its arrays pose (frames, bodies, 4, 4; mm) and force (frames, bodies, bodies, 3; N)
  /usr/bin/python3 -c "import numpy as np
pose, force = 1e3 * np.load('$1/body_pose.npy')[..., :3, 3], np.load('$1/pair_wrench.npy')[..., :3]
exit(0 if $2 else f'$2: {force[-1].tolist()} {pose[-1].tolist()}')"
}

for example in lift_block soft_ball peg_in_hole; do
  scene one $example THREADS=1 || { tail -5 said.txt >&2; fail "$example: the goal failed"; }
  folder=one/scene/$example
  [ "$("$bin/tacipc" get $folder/press.yaml summary.verdict)" = pass ] || fail "$example: its verdict is not pass"
  frames=$("$bin/tacipc" get $folder/press.yaml summary.frames)
  for gel in "$folder"/gels/*; do
    [ "$("$bin/tacipc" get "$gel/press/press.yaml" summary.verdict)" = pass ] || fail "$gel: its verdict is not pass"
    [ "$(find "$gel/render" -maxdepth 1 -name 'frame_*' | wc -l)" = "$frames" ] || fail "$gel: not every frame was rendered"
    grep -q "<a href=\"view.html#scene/$(basename "$gel")\">" $folder/report/index.html || fail "$gel: no link to it in 3-D"
  done
  for file in index.html scene_strip.png view.html; do [ -s $folder/report/$file ] || fail "$example: $file is missing"; done
  /usr/bin/python3 "$source_dir/tests/pipeline/check_view.py" $folder/report/view/scene.js $folder
done
# Bodies are left, right, block, table; gel, ball, plate; left, right, peg, hole.
number one/scene/lift_block 'abs(pose[-1, 2, 2] - 5) < 0.1 and force[-1, 2, 3].any() == 0' || fail "the block was not lifted"
number one/scene/lift_block 'abs(force[-1, 2, :2, 2].sum() - 0.02 * 9.81) < 0.002' || fail "the gels do not carry the block"
number one/scene/soft_ball 'force[20, 1, 0, 2] > 0.2 and abs(force[20, 1, :, 2].sum() - force[0, 1, :, 2].sum() - 0.003) < 0.001' || fail "the ball is not pressed between gel and plate"
number one/scene/peg_in_hole 'abs(pose[-1, 2, 2] + 14) < 0.2 and 0.05 < pose[-1, 2, 1] < 0.15' || fail "the peg is not in the hole"
browsed=0
/usr/bin/python3 "$source_dir/tests/pipeline/browse_view.py" one/scene/peg_in_hole/report "$build_dir/tests/pipeline/scene_view_screenshots" || browsed=$?
[ "$browsed" = 0 ] || [ "$browsed" = 77 ] || fail "the view has faults"

before=$(find one -name '*.yaml' -printf '%p %T@\n' | sort)
for example in lift_block soft_ball peg_in_hole; do scene one $example THREADS=1 || fail "a second run failed"; done
[ "$before" = "$(find one -name '*.yaml' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"
make -s -f Makefile.data export SAMPLE=one/scene/soft_ball OUT=one BUILD="$build_dir" PACKAGES=no > said.txt 2>&1 || { tail -5 said.txt >&2; fail "export failed"; }
for file in surface_gel_0034.vtu object_plate_0034.vtu soft_ball_0034.vtu soft.pvd sample.glb; do [ -s one/scene/soft_ball/export/$file ] || fail "$file is missing"; done

of_all=("$bin/press" --config configs/press/default.yaml --sensor configs/sensors/mctac.yaml --gel one/gels/mctac-tiny/gel.msh)
press() { # press OUT SCENE [FLAG …]
  "${of_all[@]}" --out "$1" --sample "$2" "${@:3}"
}
# Piece by piece: gels on paths, of which the second piece has more and takes the frames of the first.
/usr/bin/python3 - <<'PY'
import numpy as np, os
for name, steps in (("piece", 3), ("whole", 6)):
    os.makedirs(name, exist_ok=True)
    path = np.tile(np.eye(4), (steps + 1, 1, 1))
    path[:, 2, 3] = 0.05e-3 * np.arange(steps + 1)
    np.save(f"{name}/gel.npy", path)
    scenes = os.path.relpath("configs/scenes", name)
    open(f"{name}/scene.yaml", "w").write(f"""bodies:
  - {{name: gel, kind: gel, path: gel.npy}}
  - {{name: plate, kind: fixed, mesh: {scenes}/meshes/plate.off, unit: mm, at_mm: [0, 0, 1.1]}}
motion: [{{steps: {steps}}}]
""")
PY
press at_once whole/scene.yaml > said.txt 2>&1 || { tail -5 said.txt >&2; fail "a scene with a path failed"; }
mkdir none
press first piece/scene.yaml --solved none > said.txt 2>&1 || { tail -5 said.txt >&2; fail "the first piece failed"; }
press second whole/scene.yaml --solved first/solved > said.txt 2>&1 || { tail -5 said.txt >&2; fail "the second piece failed"; }
[ "$(find first/solved -type f | wc -l),$(find second/solved -type f | wc -l)" = 4,3 ] || fail "the pieces did not leave the frames that they solved"
for file in body_pose.npy pair_wrench.npy energy.npy gels/gel/press/positions.npy gels/gel/press/contact_force.npy; do
  cmp "at_once/$file" "second/$file" || fail "solved piece by piece, $file is another"
done
code=0; "$bin/press" --config configs/press/small_gap.yaml --sensor configs/sensors/mctac.yaml --gel one/gels/mctac-tiny/gel.msh --sample whole/scene.yaml --solved first/solved --out other > said.txt 2>&1 || code=$?
[ $code = 1 ] && grep -q 'of another gel, sensor, press file, body or contact' said.txt || fail "frames of another press file were taken"

# Frames of another motion, which no path tells.
for name in rise far; do
  mkdir "$name"
  sed "s#path: gel.npy#at_mm: [0, 0, 0]#; s#^motion:.*#motion: [{steps: 3, move: [{body: gel, by_mm: [0, 0, $([ $name = rise ] && echo 0.15 || echo 0.3)]}]}]#" piece/scene.yaml > "$name/scene.yaml"
done
press risen rise/scene.yaml --solved none > said.txt 2>&1 || { tail -5 said.txt >&2; fail "a scene that moves a gel failed"; }
press again rise/scene.yaml --solved risen/solved > said.txt 2>&1 || fail "frames of the same motion were refused"
code=0; press other far/scene.yaml --solved risen/solved > said.txt 2>&1 || code=$?
[ $code = 1 ] && grep -q 'is of another motion than frame 1 of the scene' said.txt || fail "frames of another motion were taken"

# Killed once some frames are there, on another number of threads.
soft=(--soft one/scene/soft_ball/tets --name soft_ball)
"${of_all[@]}" --out killed --sample configs/scenes/soft_ball.yaml "${soft[@]}" --threads 2 > said.txt 2>&1 &
killed=$!
for _ in $(seq 4000); do [ ! -e killed/.partial-press/.scratch/frame_00012 ] || break; sleep 0.005; done
kill -KILL $killed 2> /dev/null || fail "the press was over before it could be killed"
wait $killed 2> /dev/null || :
press killed configs/scenes/soft_ball.yaml "${soft[@]}" --threads 1 > said.txt 2>&1 || { tail -5 said.txt >&2; fail "the run after a kill failed"; }
grep -q 'frame 12/34 resumed' said.txt || fail "it did not go on where it was"
for file in body_pose.npy pair_wrench.npy energy.npy momentum.npy soft/ball/world_positions.npy gels/gel/press/contact_force.npy; do
  cmp killed/$file one/scene/soft_ball/$file || fail "$file is another one after a kill"
done

changed() { sed "$2" "configs/scenes/$1.yaml" > "configs/scenes/$3.yaml"; }
changed peg_in_hole 's/body: left/body: lift/' unknown
refused 2 "configs/scenes/unknown.yaml:14:16: motion[0].move[0].body: 'lift' is not one of left, right, peg, hole" press five configs/scenes/unknown.yaml
changed peg_in_hole 's/hole\.off/gone.off/' gone
refused 2 'body hole: mesh: configs/scenes/meshes/gone.off does not exist' press five configs/scenes/gone.yaml
refused 2 'names '"'configs/scenes/meshes/gone.off'"', which does not exist' make -s -f Makefile.data scene SCENE=configs/scenes/gone.yaml MESH=tiny OUT=five BUILD="$build_dir" PACKAGES=no
refused 2 'body ball: configs/scenes/meshes/ball.off is a surface' press five configs/scenes/soft_ball.yaml
changed lift_block 's/at_mm: \[0, 0, -18.012\]/at_mm: [0, 0, -17.9]/' overlap
refused 1 'bodies block and table intersect where they begin' press five configs/scenes/overlap.yaml
changed soft_ball 's#meshes/ball.off#../../one/gels/mctac-tiny/gel.msh#' no_soft
refused 1 'is the mesh of a gel, expected that of a soft object' press five configs/scenes/no_soft.yaml
changed soft_ball 's#meshes/ball.off#meshes/plate.off#' other
refused 1 'is of another surface than configs/scenes/meshes/plate.off' press five configs/scenes/other.yaml "${soft[@]}"
refused 2 '--object and --object-config: the bodies of a scene are named in its file' press five configs/scenes/peg_in_hole.yaml --object configs/scenes/meshes/ball.off
refused 2 '--object is missing' press five configs/motions/press_0500um.yaml
[ ! -e five/press.yaml ] || fail "a wrong scene left a record"
make_says() { refused 2 "$1" make -s -f Makefile.data scene OUT=five BUILD="$build_dir" PACKAGES=no "${@:2}"; }
make_says 'scene: say which scene'
make_says 'SCENE: nothing.yaml does not exist' SCENE=nothing.yaml
make_says 'DEPTH_MM: has no effect on a scene' SCENE=configs/scenes/soft_ball.yaml DEPTH_MM=1
make_says 'SOFT: there is no configs/gels/finest.yaml' SCENE=configs/scenes/soft_ball.yaml SOFT=finest
make_says 'configs/press/default.yaml: bodies: there is no such key' SCENE=configs/press/default.yaml
for name in .. a/../../b; do make_says "scene_name: '$name' leads out of five" SCENE=configs/scenes/lift_block.yaml NAME=$name; done
{ echo bodies:; seq -f '  - {name: b%g, kind: fixed, mesh: meshes/block.off}' 2000; } > configs/scenes/many.yaml
timeout 10 bash pipelines/sample/scene_bodies.sh "$bin/tacipc" configs/scenes/many.yaml > many.txt || fail "2,000 bodies are not listed within 10 s"
[ "$(sed -n 's/^scene_files := *//p' many.txt | wc -w)" = 2000 ] || fail "of 2,000 bodies are listed: $(cut -c1-200 many.txt)"
echo "1 passed, 0 failed"
