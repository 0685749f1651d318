#!/usr/bin/env bash
# The goal sim2real on photographs that our own light made of a ball at eight places, known by their contact circles alone:
# what made them must be found again, and nothing of the tested half may enter the fit.
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/made_photographs.sh"
{ made_settings; cat; } > configs/studies/sim2real/made.yaml <<'END'
title: made
data: shots
photographs: images
ending: /shot.png
circles: circles.csv
circle_table: {image: name, diameter_mm: diameter, x_px: x, y_px: y, radius_px: radius, leave_out: cut, calibrate_every: 2, box_radii: 1.5, background_radii: 2.0, image_px: [100, 75]}
must: {ssim_s: 0.99, mae: 0.004, psnr_db: 45}
END
make_truth

# Contacts where the gap is 0.06 mm.
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
shade_truth truth/shade.yaml truth/shots --contact truth/contact.yaml
for i in 1 2 3 4 5 6 7 8 9 10; do mkdir shared/shots/images/b$i && cp truth/shots/b$i.png shared/shots/images/b$i/shot.png; done

goal() { make -s -f Makefile.data sim2real CASES=configs/studies/sim2real/made.yaml OUT="$1" BUILD="$build_dir" PACKAGES=no SHARED=shared "${@:2}" >log.txt 2>&1; }
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
sed 's/circles.csv/nowhere.csv/' configs/studies/sim2real/made.yaml > configs/studies/sim2real/lost.yaml
! make -s -f Makefile.data sim2real CASES=configs/studies/sim2real/lost.yaml OUT=lost BUILD="$build_dir" PACKAGES=no SHARED=shared >log.txt 2>&1 || fail "a table that is not there"
grep -q 'CASES: configs/studies/sim2real/lost.yaml names shared/shots/nowhere.csv, which does not exist' log.txt || { cat log.txt; fail "a table that is not there is not named"; }
[ ! -e lost ] || fail "something ran"
echo "3 passed, 0 failed"
