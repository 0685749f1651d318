#!/usr/bin/env bash
# The goal fots on vectors that our own press made: its depth and way, which nothing tells the fit, must be found again, and
# with them all other vectors. The same press given as another simulator's adds a row.
. "$(dirname "$0")/common.sh"
export OPENBLAS_NUM_THREADS=1
bin=$build_dir/bin
mkdir -p configs/studies/fots/made shots/data/made
sed 's/centre_mm: .*/centre_mm: 0.6/; s/inner_mm: .*/inner_mm: 1.2/; s/rim_mm: .*/rim_mm: 4/' configs/studies/fots/fots_markers/mesh.yaml > configs/studies/fots/made/mesh.yaml
sed 's/rows: 61/rows: 17/; s/columns: 77/columns: 21/; s/pitch_mm: 0.25/pitch_mm: 0.8/' configs/studies/fots/fots_markers/sensor.yaml > configs/studies/fots/made/sensor.yaml
cp configs/studies/fots/fots_markers/press.yaml configs/studies/fots/made/press.yaml
cat > configs/studies/fots/made.yaml <<'END'
title: made
data: data/made
fields: {press: p.csv, shear: s.csv, remove_press_median: true, remove_shear_median: false, image_px: [320, 240], px_per_mm: 20,
  contact_px: [160, 120], shear_marker_px: [160, 120], least_length_px: 1.0}
ball: {radius_mm: 3.0, edge_mm: 0.4}
friction: 0.8
sensor: made/sensor.yaml
mesh: made/mesh.yaml
press: made/press.yaml
runs: {shallowest_mm: 0.4, deepest_mm: 0.5, depths: 2, press_step_mm: 0.1, shear_mm: 0.5, shear_steps: 5, direction_deg: 90}
variants:
  - {name: smoother, friction: 0.6}
  - {name: finer, px_per_mm: 21}
END

# What a camera would see of a press between those: 0.45 mm deep, 0.32 mm far.
"$bin/cases" --config configs/studies/fots/made.yaml --out told --log-level error
"$bin/indenter" --config told/base/indenter.yaml --out ball --log-level error
"$bin/tetmesh" --sensor configs/studies/fots/made/sensor.yaml --config configs/studies/fots/made/mesh.yaml --out gel --log-level error
cat configs/studies/fots/made/press.yaml told/base/friction.yaml > press.yaml
truth() { # truth OUT DEPTH_MM STEPS
  sed "s/depth_mm: [0-9.]*, steps: [0-9]*/depth_mm: $2, steps: $3/; s/distance_mm: [0-9.]*, steps: [0-9]*/distance_mm: 0.4, steps: 5/" told/motion_0400um.yaml > motion.yaml
  "$bin/press" --name "$2" --sensor configs/studies/fots/made/sensor.yaml --config press.yaml --sample motion.yaml --gel gel/gel.msh --object ball/object.ply \
    --object-config configs/objects/embossed.yaml --out "$1" --log-level error
}
truth true/a 0.45 5
seen() { # seen FRAME OFFSET_PX: rest and displacement in px of what is inside the image
  echo Mx,My,dx,dy
  paste <(od -An -v -t f8 -w24 -j128 -N$((357 * 24)) true/a/markers.npy) <(od -An -v -t f8 -w48 -j$((128 + 48 * 357 * $1)) -N$((357 * 48)) true/a/marker_displacement.npy) |
    awk -v off="$2" '{ x = 160 + 20e3 * $1; y = 120 + 20e3 * $2; if (x > 0 && x < 320 && y > 0 && y < 240) printf "%.9g,%.9g,%.6f,%.6f\n", x, y, 20e3 * $4 + off, 20e3 * $5 - off }'
}
seen 5 1.5 > shots/data/made/p.csv
seen 9 0 > shots/data/made/s.csv
[ "$(wc -l < shots/data/made/s.csv)" -gt 200 ] || fail "too few markers in the image: $(head -3 shots/data/made/s.csv)"

truth true/b 0.55 6
make -s -f Makefile.data fots MARKERS=configs/studies/fots/made.yaml SHARED=shots OUT=out BUILD="$build_dir" PACKAGES=no ALSO=true > page.txt 2> said.txt || { tail -5 said.txt; fail "the goal failed"; }
value() { sed -n "/^summary:/,\$s/^ *$1: //p" out/fots/made/fit/marker_fit.yaml | head -1; }
near() { awk -v a="$(value "$1")" -v b="$2" -v by="$3" 'BEGIN { d = a - b; exit !(a != "" && d < by && d > -by) }' || fail "$1 is $(value "$1"), not $2"; }
near depth_mm 0.45 0.01
near way_mm 0.32 0.01
for field in press shear; do
  error=$(sed -n "/^  $field:/,\$s/^ *mean_px: //p" out/fots/made/fit/marker_fit.yaml | head -1)
  awk -v e="$error" 'BEGIN { exit !(e < 0.05) }' || fail "the vectors of the $field are off by $error px in the mean"
done
for row in base true smoother finer; do grep -q "^| $row | 0\.[45]" page.txt || { cat page.txt; fail "no row $row"; }; done
grep -q '^| true | 0.45 | 0.32 |' page.txt || { cat page.txt; fail "the other simulator's fit is not its own"; }
# Formulas that know no gel have rows, and follow this press less well.
for row in fots_published fots_fitted taxim_superposition; do grep -q "^| $row | 0\.[0-9]" page.txt || { cat page.txt; fail "no row $row"; }; done
before=$(find out -name '*.yaml' -printf '%p %T@\n' | sort)
make -s -f Makefile.data fots MARKERS=configs/studies/fots/made.yaml SHARED=shots OUT=out BUILD="$build_dir" PACKAGES=no ALSO=true > /dev/null 2>&1
[ "$before" = "$(find out -name '*.yaml' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"
echo "1 passed, 0 failed"
