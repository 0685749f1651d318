#!/usr/bin/env bash
# The goal grasp on a small block: it is lifted, both fingers carry its weight, with the same bytes on one thread and two, and nothing to do a
# second time; without friction it is dropped, which is a result, too.
. "$(dirname "$0")/common.sh"

# A block of 8 mm, in millimetres.
awk 'BEGIN {
  n = split("-4 -4 -4,4 -4 -4,4 4 -4,-4 4 -4,-4 -4 4,4 -4 4,4 4 4,-4 4 4", v, ",")
  m = split("1 3 2,1 4 3,5 6 7,5 7 8,1 2 6,1 6 5,2 3 7,2 7 6,3 4 8,3 8 7,4 1 5,4 5 8", f, ",")
  print "solid block"
  for (i = 1; i <= m; ++i) {
    split(f[i], c, " ")
    print "facet normal 0 0 0\nouter loop"
    for (k = 1; k <= 3; ++k) print "vertex " v[c[k]]
    print "endloop\nendfacet"
  }
  print "endsolid"
}' > block.stl
cat > short.yaml <<'END'
fingers: {}
object: {mass_g: 20}
motion:
  - {kind: close, force_n: 1, steps: 2}
  - {kind: hold, steps: 2}
  - {kind: lift, distance_mm: 1, steps: 3}
  - {kind: hold, steps: 6}
END
grasp() { # grasp OUT [VARIABLE=value …]
  local out=$1
  shift
  make -s -f Makefile.data grasp OBJECT=block.stl MESH=tiny OUT="$out" BUILD="$build_dir" PACKAGES=no "$@" > said.txt 2>&1
}
value() { "$build_dir/bin/tacipc" get "$1/grasp/block/press.yaml" "summary.$2"; }

grasp one GRASP=short.yaml THREADS=1 || { tail -5 said.txt >&2; fail "the goal failed"; }
grep -qx lifted said.txt || { tail -5 said.txt >&2; fail "the outcome is not said"; }
grasp two GRASP=short.yaml THREADS=2 || fail "the goal failed on two threads"
same_files one two
# 20 g weigh 0.1962 N.
awk -v n="$(value one 'per_frame[13].carried_n')" 'BEGIN { exit !(n > 0.195 && n < 0.1975) }' || fail "the fingers do not carry the block"
for side in left right; do
  [ "$(find "one/grasp/block/$side/render" -maxdepth 1 -name 'frame_*' | wc -l)" = 14 ] || fail "$side: not every frame was rendered"
  [ -s one/grasp/block/$side/press/contact_force.npy ] || fail "$side: no forces"
done
for file in index.html grasp_strip.png view.html; do [ -s one/grasp/block/report/$file ] || fail "$file is missing"; done
for link in grasp grasp/left grasp/right; do grep -q "<a href=\"view.html#$link\">" one/grasp/block/report/index.html || fail "no link to $link in 3-D"; done
# Debian's Python, which has numpy.
/usr/bin/python3 "$source_dir/tests/pipeline/check_view.py" one/grasp/block/report/view/grasp.js one/grasp/block
browsed=0
/usr/bin/python3 "$source_dir/tests/pipeline/browse_view.py" one/grasp/block/report "$build_dir/tests/pipeline/grasp_view_screenshots" || browsed=$?
[ "$browsed" = 0 ] || [ "$browsed" = 77 ] || fail "the view has faults"
grep -q '<h2>Grasp: lifted</h2>' one/grasp/block/report/index.html || fail "the page does not say what became of it"
make -s -f Makefile.data export SAMPLE=one/grasp/block OUT=one BUILD="$build_dir" PACKAGES=no > said.txt 2>&1 || { tail -5 said.txt >&2; fail "export failed"; }
for side in left right; do [ -s one/grasp/block/export/surface_${side}_0013.vtu ] || fail "$side: was not exported"; done
[ "$(head -c 4 one/grasp/block/export/sample.glb)" = glTF ] || fail "sample.glb is no glTF file"
grep -q 'class="film"' one/grasp/block/report/index.html && [ -s one/grasp/block/report/film.jpg ] || fail "the page does not show the motion"
if [ -x "$build_dir/bin/video" ]; then
  make -s -f Makefile.data export SAMPLE=one/grasp/block FORMAT=video OUT=one BUILD="$build_dir" PACKAGES=no > said.txt 2>&1 || { tail -5 said.txt >&2; fail "no video"; }
  grep -q 'frames: 14' one/grasp/block/video/video.yaml && [ -s one/grasp/block/video/video.mp4 ] || fail "not fourteen frames"
  grep -q 'height_px: 100' one/grasp/block/video/video.yaml || fail "not one finger above the other: $(cat one/grasp/block/video/video.yaml)"
  [ ! -e one/grasp/block/left/frames ] || fail "frames are rendered twice"
fi
before=$(find one -name '*.yaml' -printf '%p %T@\n' | sort)
make -s -f Makefile.data export SAMPLE=one/grasp/block OUT=one BUILD="$build_dir" PACKAGES=no > said.txt 2>&1 || fail "a second export failed"
grasp one GRASP=short.yaml THREADS=1 || fail "a second run failed"
[ "$before" = "$(find one -name '*.yaml' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"

# Nothing said of how it is gripped: the grasp nearest to its centre of mass of those drawn; another seed, another grasp.
grasp drawn LIFT_MM=1 LIFT_STEPS=4 FORCE_N=1 MASS_G=10 || { tail -5 said.txt >&2; fail "a drawn grasp failed"; }
[ "$(value drawn outcome)" = lifted ] || fail "a block gripped near its middle was $(value drawn outcome)"
awk -v w="$(value drawn pose.width_m)" -v l="$(value drawn pose.lever_m)" 'BEGIN { exit !(w > 0.00799 && w < 0.00801 && l < 3e-4) }' || fail "the drawn grasp is not through the middle"
grep -q 'where it is 8[0-9.]* mm wide' drawn/grasp/block/report/index.html || fail "the page does not say which grasp was drawn"
grasp other SEED=2 LIFT_MM=1 LIFT_STEPS=4 FORCE_N=1 MASS_G=10 || fail "another seed failed"
[ "$(value drawn 'pose.grip_m[0]')" != "$(value other 'pose.grip_m[0]')" ] || fail "another seed drew the same grasp"
grasp given TURN=0 LIFT_MM=1 LIFT_STEPS=4 FORCE_N=1 MASS_G=10 || fail "a given grasp failed"
[ "$(value given pose.lever_m)" = 0 ] || fail "TURN=0 does not grip the centre of mass"
sed 's/fingers: {}/fingers: {draw: {width_mm: [2, 5]}}/' short.yaml > small_hand.yaml
grasp five GRASP=small_hand.yaml && fail "a hand that opens 5 mm took a block of 8 mm"
grep -q '4000 wider than 5 mm' said.txt || fail "it is not said why nothing was gripped"

grasp three GRASP=short.yaml FRICTION=0.01 || fail "a grasp that slips failed"
[ "$(value three outcome)" = dropped ] || fail "a block held by a friction of 0.01 was $(value three outcome)"

wrong() { # wrong MESSAGE VARIABLE=value …
  local message=$1
  shift
  grasp four "$@" && fail "$*: was taken"
  grep -q -- "$message" said.txt || { tail -3 said.txt >&2; fail "$*: not said what is wrong"; }
}
wrong 'MASS_G: has no effect with GRASP' GRASP=short.yaml MASS_G=5
wrong 'DEPTH_MM: has no effect on a grasp' DEPTH_MM=1
wrong 'SEED: has no effect' SEED=2 TURN=30
wrong 'GRASP: nothing.yaml does not exist' GRASP=nothing.yaml
sed '0,/close/s/kind: close, force_n: 1/kind: hold/' short.yaml > hold_first.yaml
wrong 'hold_first.yaml:4:.*fingers close first' GRASP=hold_first.yaml
echo "1 passed, 0 failed"
