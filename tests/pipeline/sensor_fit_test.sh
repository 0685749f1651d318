#!/usr/bin/env bash
# The goal calibrate-sensor: from photographs that render made of the gel at rest and of a ball, with a sensor whose ring
# stands elsewhere than its file says, a sensor file with which render makes these photographs again.
. "$(dirname "$0")/common.sh"
export OPENBLAS_NUM_THREADS=1
bin=$build_dir/bin
# Three lamps that differ, no markers; the noise of a good camera.
sed -e 's/width_px: 64/width_px: 160/; s/height_px: 48/height_px: 120/; /^markers:/,/^markers_src/d; s/full_well_e: 5000/full_well_e: 20000/' \
  -e 's/curve: srgb/curve: gamma\n  gamma: 2.2/; s/size_mm: 5.0/size_mm: 0/' configs/sensors/mctac.yaml > mine.yaml
sed -e 's/radius_mm: 10.0 /radius_mm: 10.3 /; s/z_mm: -13.0/z_mm: -13.5/; s/gamma: 2.2/gamma: 2.1/; s/rgb_linear: \[1, 0, 0\]/rgb_linear: [0.9, 0.2, 0.1]/' \
  -e 's/^camera:$/&\n  vignetting: {v2: -0.15, v4: 0}/' mine.yaml > true.yaml
for want in 'radius_mm: 10.3' 'z_mm: -13.5' 'gamma: 2.1' 'v2: -0.15' '0.9, 0.2'; do grep -q -- "$want" true.yaml || fail "true.yaml lacks $want"; done

# A gel fine enough under the ball for a rim.
sed 's/centre_mm: 1.2/centre_mm: 0.35/; s/centre_radius_mm: 2/centre_radius_mm: 2.5/; s/max_vertices: 2000/max_vertices: 6000/' configs/gels/tiny.yaml > configs/gels/small.yaml
# One press of the ball over the middle, photographed at two depths.
"$bin/tetmesh" --sensor true.yaml --config configs/gels/small.yaml --out truth/gel
echo 'ball: {radius_mm: 4.0, edge_mm: 0.5}' > truth/indenter.yaml
"$bin/indenter" --config truth/indenter.yaml --out truth/ball
echo 'motion: {kind: press, depth_mm: 0.7, steps: 7}' > truth/motion.yaml
"$bin/press" --name ball --object truth/ball/object.ply --object-config configs/objects/embossed.yaml --gel truth/gel/gel.msh \
  --sensor true.yaml --config configs/studies/sim2real/gsmini_balls/press.yaml --sample truth/motion.yaml --out truth/press
sed 's/^frames: last */frames: all /; s/^transfer: encoded/transfer: none/; s/^noise: {seed: 1}/noise: {seed: 1, every_frame: true}/' configs/render/default.yaml > plain.yaml
"$bin/render" --config plain.yaml --sensor true.yaml --gel truth/gel/gel.msh --press truth/press --out truth/render
mkdir -p my/balls
cp truth/render/frame_0000/tactile.png my/background.png
cp truth/render/frame_0004/tactile.png my/balls/shallow.png
cp truth/render/frame_0006/tactile.png my/balls/deep.png
# Hertz's radius, √(R d), in pixels of 15 / 160 mm: near enough for labels of 3 px.
printf 'shallow.png (79.5, 59.5) %s\ndeep.png (79.5, 59.5) %s\n' 13.5 16.5 > my/labels.txt
sed 's/block_px: 8/block_px: 2/; s/sigma_codes: 0.5/sigma_codes: 0.3/; /camera_[xy]_mm/d; /window_scale/d' configs/sensors/calibrate/ring.yaml > my/fit.yaml

goal() { make -s -f Makefile.data calibrate-sensor SENSOR_FILE=mine.yaml BACKGROUND=my/background.png FIT=my/fit.yaml MESH=small OUT="$1" BUILD="$build_dir" PACKAGES=no "${@:2}" >log.txt 2>&1; }
goal out PHOTOGRAPHS=my/balls LABELS=my/labels.txt BALL_MM=4 LABEL_PX=3 GAP_MM=0.05 || { cat log.txt; fail "calibrate-sensor"; }
fit=out/calibrate/mine/fit

# What the photographs tell is found again, and said.
found() { # found NAME TRUE TOLERANCE
  awk -v name="$1" -v true="$2" -v tolerance="$3" '$1 == "-" { here = $3 == name } here && $1 == "value:" { off = $2 - true; if (off < 0) off = -off; ok = off <= tolerance }
    here && $1 == "told_by:" { told = $2 == "photographs" } END { exit !(ok && told) }' $fit/calibrate.yaml || { cat $fit/calibrate.yaml; fail "$1 is not found again"; }
}
found ring_radius_mm 10.3 0.1
found ring_z_mm -13.5 0.1
found ring_azimuth_deg 0 0.1
found vignetting_v2 -0.15 0.01
found gamma 2.1 0.02
grep -qE '^ring_z_mm +-13\.[0-9]+ ± 0\.[0-9]+ +determined by the photographs$' log.txt || { cat log.txt; fail "the goal does not say what it found"; }
grep -q "The sensor is $fit/sensor.yaml" log.txt || fail "the goal does not say where to look"
[ "$(cd "$fit"/residuals && printf '%s ' *)" = 'background.exr background.png deep.exr deep.png shallow.exr shallow.png ' ] || fail "residuals: $(ls "$fit"/residuals)"

# The file is a sensor: with its photograph as reference, and without noise like the photographs to within theirs.
"$bin/render" --config configs/render/default.yaml --sensor $fit/sensor.yaml --gel truth/gel/gel.msh --press truth/press --out again
cmp my/background.png again/frame_0000/tactile.png || fail "the photograph is not the reference"
sed 's/, every_frame: true//' plain.yaml > quiet.yaml
for name in true fit; do
  if [ $name = fit ]; then sensor=$fit/sensor.yaml; else sensor=true.yaml; fi
  "$bin/render" --config quiet.yaml --sensor "$sensor" --gel truth/gel/gel.msh --press truth/press --out quiet/$name --log-level warning
  mkdir -p pairs/$name
  for frame in 0 4 6; do cp quiet/$name/frame_000$frame/tactile.png pairs/$name/$frame.png; done
done
"$bin/metrics" --config configs/metrics/images.yaml --images pairs/fit --reference pairs/true --out scores
awk -F, 'NR > 1 && !($3 <= 0.5 / 255) { print; bad = 1 } END { exit bad || NR != 4 }' scores/samples.csv || fail "the fitted sensor makes other images"

# Any number of threads, the same bytes; again, nothing to do; without balls another fit.
goal threads THREADS=3 PHOTOGRAPHS=my/balls LABELS=my/labels.txt BALL_MM=4 LABEL_PX=3 GAP_MM=0.05 || { cat log.txt; fail "three threads"; }
same_files out threads
before=$(stat -c %y $fit/calibrate.yaml)
goal out PHOTOGRAPHS=my/balls LABELS=my/labels.txt BALL_MM=4 LABEL_PX=3 GAP_MM=0.05 || fail "again"
[ "$before" = "$(stat -c %y $fit/calibrate.yaml)" ] || fail "a second run did something"
goal alone || { cat log.txt; fail "without balls"; }
[ ! -e alone/calibrate/mine/press ] || fail "a press that nobody needs"

# What a user may get wrong.
refuses() { # refuses 'MESSAGE' VARIABLE=value …
  ! goal wrong "${@:2}" || fail "${*:2} is not refused"
  grep -qF -- "$1" log.txt || { cat log.txt; fail "${*:2} does not say '$1'"; }
}
refuses 'PHOTOGRAPHS, LABELS: give both or none' PHOTOGRAPHS=my/balls
refuses 'BACKGROUND: nowhere.png does not exist' BACKGROUND=nowhere.png
refuses 'its contact radius of' PHOTOGRAPHS=my/balls LABELS=my/labels.txt BALL_MM=4 DEEPEST_MM=0.3 GAP_MM=0.05
echo "9 passed, 0 failed"
