#!/usr/bin/env bash
# The goal sim2real on photographs that our own light made of a ball at eight places, known by their contact circles alone:
# what made them must be found again, and nothing of the tested half may enter the fit.
. "$(dirname "$0")/common.sh"
export OPENBLAS_NUM_THREADS=1
bin=$build_dir/bin
sed -i 's/width_px: 320/width_px: 100/; s/height_px: 240/height_px: 75/' configs/sensors/gelsight_mini.yaml
cat > configs/benchmarks/made.yaml <<'END'
title: made
data: shots
photographs: images
ending: /shot.png
circles: circles.csv
circle_table: {image: name, diameter_mm: diameter, x_px: x, y_px: y, radius_px: radius, leave_out: cut, calibrate_every: 2, box_radii: 1.5, background_radii: 2.0, image_px: [100, 75]}
sensor: ../sensors/gelsight_mini.yaml
mesh: made/mesh.yaml
press: made/press.yaml
calibrate: made/calibrate.yaml
baseline: ../baseline/height_map.yaml
calibration_ball: {radius_mm: 3.0, deepest_mm: 1.0, steps: 5}
ball_edge_mm: 0.5
mesh_spacing_mm: 0.1
must: {ssim_s: 0.99, mae: 0.004, psnr_db: 45}
END
mkdir configs/benchmarks/made
sed 's/centre_mm: 0.18/centre_mm: 0.35/; s/inner_mm: 0.3/inner_mm: 0.6/' configs/benchmarks/gsmini_balls/mesh.yaml > configs/benchmarks/made/mesh.yaml
cp configs/benchmarks/gsmini_balls/press.yaml configs/benchmarks/made/press.yaml
cat > configs/benchmarks/made/calibrate.yaml <<'END'
ball_radius_mm: 3.0
contact_gap_mm: 0.02
fit_contact_gap: true
label_sigma_px: 2.0
fit_radius_px: 24
fit_stride_px: 1
drift_radius_px: 40
lamps:
  - {azimuth_deg: 265, distance_mm: 16, elevation_tan: 0.5}
  - {azimuth_deg: 10, distance_mm: 20, elevation_tan: 0.6}
lamp_bounds: {azimuth_deg: 25, elevation_tan: [0.2, 0.9], distance_mm: [11, 40]}
environment_degree: 1
shadow_softness: 0.15
blur_px: 0
ridge: 1.0e-6
folds: 5
END

# Photographs under two lamps, contacts where the gap is 0.06 mm.
$bin/tetmesh --sensor configs/sensors/gelsight_mini.yaml --config configs/benchmarks/made/mesh.yaml --out truth/gel
echo 'ball: {radius_mm: 3.0, edge_mm: 0.5}' > truth/indenter.yaml
$bin/indenter --config truth/indenter.yaml --out truth/ball
echo 'motion: {kind: press, depth_mm: 1.0, steps: 5}' > truth/motion.yaml
$bin/press --name ball --object truth/ball/object.ply --object-config configs/objects/embossed.yaml --gel truth/gel/gel.msh \
  --sensor configs/sensors/gelsight_mini.yaml --config configs/benchmarks/made/press.yaml --sample truth/motion.yaml --out truth/press
cat > truth/light.yaml <<'END'
light_field:
  field_half_width_mm: 10.145
  shadow_softness: 0.15
  blur_px: 0
  lamps:
    - position_mm: [0, -14, -7.7]
      linear_codes: {red: [70, 5, -10], green: [-10, 0, 0], blue: [-8, 0, 0]}
      quadratic_codes: {red: [0, 0, 0], green: [0, 0, 0], blue: [0, 0, 0]}
    - position_mm: [17, 0, -9]
      linear_codes: {red: [-12, 0, 0], green: [50, 10, 0], blue: [60, 0, 5]}
      quadratic_codes: {red: [0, 0, 0], green: [0, 0, 0], blue: [0, 0, 0]}
END
awk 'BEGIN { print "P3\n100 75\n255"; for (y = 0; y < 75; ++y) for (x = 0; x < 100; ++x) print 90 + int(x / 4), 110 - int(y / 3), 95 + (7 * x + 13 * y) % 5 }' > truth/background.png
echo 'contact_gap_mm: 0.06' > truth/contact.yaml
mkdir -p shared/shots/images
awk 'BEGIN {
  print "images:" > "truth/shade.yaml"; print "name,x,y,radius,diameter,cut" > "shared/shots/circles.csv"
  n = split("25.5 22.0,72.0 24.5,48.5 38.0,30.0 50.0,75.5 52.0,50.0 21.5,24.0 36.5,71.0 38.5,52.0 53.5,36.0 30.0", c, ",")
  for (i = 1; i <= n; ++i) {
    split(c[i], p, " "); r = 6.5 + 0.25 * (i % 4)
    printf "  - {name: b%d, center_px: [%s, %s], contact_px: %s}\n", i, p[1], p[2], r > "truth/shade.yaml"
    printf "b%d,%s,%s,%s,6.0,0\n", i, p[1], p[2], r > "shared/shots/circles.csv"
  }
  print "ball: {radius_mm: 3.0}" > "truth/shade.yaml"
  print "b99,5,5,7,6.0,1" > "shared/shots/circles.csv"
}'
$bin/shade --config truth/shade.yaml --sensor configs/sensors/gelsight_mini.yaml --light truth/light.yaml --background truth/background.png \
  --press truth/press --gel truth/gel/gel.msh --contact truth/contact.yaml --out truth/shots
for i in 1 2 3 4 5 6 7 8 9 10; do mkdir shared/shots/images/b$i && cp truth/shots/b$i.png shared/shots/images/b$i/shot.png; done

goal() { make -s -f Makefile.data sim2real CASES=configs/benchmarks/made.yaml OUT="$1" BUILD="$build_dir" PACKAGES=no SHARED=shared "${@:2}" >log.txt 2>&1; }
goal out || { cat log.txt out/sim2real/made/comparison/table.md; fail "sim2real"; }
made=out/sim2real/made
awk -v gap="$(awk '/^contact_gap_mm:/ { print $2 }' $made/calibrate/contact.yaml)" 'BEGIN { exit !(gap > 0.05 && gap < 0.07) }' || fail "the rim's gap of 0.06 mm was not found: $(cat $made/calibrate/contact.yaml)"
[ "$(wc -l < $made/cases/labels.txt)" = 5 ] || fail "not half of the photographs calibrate"
[ ! -e $made/calibrate/residuals/b2 ] || fail "a tested photograph calibrates"

# Other photographs in the tested half: background and light stay as they are.
cp -r $made before
for i in 2 4 6 8 10; do cp truth/background.png shared/shots/images/b$i/shot.png; done
rm -r $made/{rest,calibrate,rival,ours,depth-based,background,metrics,comparison}
goal out || true # what is far from such photographs misses
[ -e $made/calibrate/light.yaml ] || { cat log.txt; fail "sim2real with other photographs"; }
cmp before/rest/background.png $made/rest/background.png || fail "a tested photograph enters the background"
cmp before/calibrate/light.yaml $made/calibrate/light.yaml || fail "a tested photograph enters the light"

# A table that is not there is said before anything runs.
sed 's/circles.csv/nowhere.csv/' configs/benchmarks/made.yaml > configs/benchmarks/lost.yaml
! make -s -f Makefile.data sim2real CASES=configs/benchmarks/lost.yaml OUT=lost BUILD="$build_dir" PACKAGES=no SHARED=shared >log.txt 2>&1 || fail "a table that is not there"
grep -q 'CASES: configs/benchmarks/lost.yaml names shared/shots/nowhere.csv, which does not exist' log.txt || { cat log.txt; fail "a table that is not there is not named"; }
[ ! -e lost ] || fail "something ran"
echo "3 passed, 0 failed"
