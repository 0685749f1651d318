#!/usr/bin/env bash
# The goal paper-real on photographs that our own light made of our own press: every row of the table is there, ours are nearly
# the photographs, a second run does nothing, and other published optics make nothing anew but their own rows. Then depth-benchmark on them.
. "$(dirname "$0")/common.sh"
. "$(dirname "$0")/made_photographs.sh"
{ made_settings; cat; } > configs/studies/sim2real/made.yaml <<'END'
title: made
data: shots
background: background.png
photographs: images
labels: labels.txt
ending: _real.png
must: {ssim_s: 0.95, mae: 0.01, psnr_db: 35}
objects:
  - name: ball
    ball_radius_mm: 3.0
    center_px: [50, 40]
    box_px: [36, 26, 30, 28]
    fit: {image: ball_0.4, yaw: false}
    images:
      - {name: ball_0.4, depth_mm: 0.4}
      - {name: ball_0.8, depth_mm: 0.8}
END
sed -i 's/size_mm: \[25.25, 20.75\]/size_mm: [25, 21]/; s/thickness_mm: 4.25/thickness_mm: 4/' configs/sensors/gelsight_mini.yaml # whole lattice spacings
make_truth
sed -i 's/contact_gap_mm: .*/contact_gap_mm: 0.06/; s/fit_contact_gap: true/fit_contact_gap: false/' configs/studies/sim2real/made/calibrate.yaml
# A coarse gel of material points, and the published optics as they are shipped.
made=configs/studies/sim2real/made
cp configs/studies/sim2real/gelsight_sim2real/legacy_*.yaml $made
sed -e 's/spacing_mm: 0.2$/spacing_mm: 0.5/; s/spacing_mm: 0.12890625.*/spacing_mm: 0.5/; s/samples_per_mm2: 600 .*/samples_per_mm2: 20/; s/step_s: 5.0e-5/step_s: 1.0e-4/' \
  configs/studies/sim2real/gelsight_sim2real/mpm.yaml > $made/mpm.yaml
grep -v crop_px configs/studies/sim2real/gelsight_sim2real/table.yaml > $made/table.yaml
cp configs/studies/sim2real/gsmini_balls/tacto_lamps.yaml $made

# Five balls to calibrate, two frames of the press to test.
awk 'BEGIN {
  print "images:" > "truth/balls.yaml"
  n = split("25.5 22.0,72.0 24.5,48.5 38.0,30.0 50.0,75.5 52.0", c, ",")
  for (i = 1; i <= n; ++i) {
    split(c[i], p, " "); r = 6.5 + 0.25 * (i % 4)
    printf "  - {name: b%d, center_px: [%s, %s], contact_px: %s}\n", i, p[1], p[2], r > "truth/balls.yaml"
    printf "b%d.png (%s, %s) %s\n", i, p[1], p[2], r > "shared/shots/labels.txt"
  }
  print "ball: {radius_mm: 3.0}" > "truth/balls.yaml"
}'
echo '{images: [{name: ball_0.4, frame: 2}, {name: ball_0.8, frame: 4}], place: {center_px: [50.5, 39.75]}}' > truth/objects.yaml
shade_truth truth/balls.yaml truth/balls --contact truth/contact.yaml
shade_truth truth/objects.yaml truth/objects
cp truth/balls/b?.png shared/shots/images
for image in ball_0.4 ball_0.8; do cp truth/objects/$image.png shared/shots/images/${image}_real.png; done
cp truth/background.png shared/shots

goal() { make -s -f Makefile.data paper-real CASES=configs/studies/sim2real/"$1".yaml OUT=out BUILD="$build_dir" PACKAGES=no SHARED=shared >log.txt 2>&1; }
goal made || { cat log.txt; fail "paper-real"; }
real=out/paper/real/made
for method in ours {tacchi,tacchi-6}{,-our-light} tacchi-60-our-light tacchi-100um-our-light tacchi-image-our-light depth-based depth-based-our-light legacy-ours legacy-tacchi legacy-depth-based legacy-exponential background tacto-pure tacto chen taxim-released taxim fots; do
  grep -q "method: $method$" $real/tabulate.yaml || fail "$method is not a row"
done
error_of() { awk -F, '$2 == "box" { sum += $3; ++n } END { print sum / n }' "$1/samples.csv"; }
awk -v ours="$(error_of out/sim2real/made/metrics/ours)" -v tacchi="$(error_of $real/metrics/tacchi)" -v legacy="$(error_of $real/metrics/legacy-tacchi)" \
  -v none="$(error_of out/sim2real/made/metrics/background)" \
  'BEGIN { print "mean errors:", ours, tacchi, legacy, none; exit !(ours < 0.005 && ours < tacchi && tacchi < none && none < legacy) }' || fail "mean errors in the box"
# Lights fitted to the balls explain what lit them; all of it for no rival.
rivals=out/paper/rivals/made/metrics
for method in tacto taxim fots; do
  awk -v ours="$(error_of out/sim2real/made/metrics/ours)" -v rival="$(error_of $rivals/$method)" -v none="$(error_of out/sim2real/made/metrics/background)" \
    'BEGIN { print "mean errors:", ours, rival, none; exit !(ours < rival && rival < none) }' || fail "$method: mean error in the box"
done
for sheet in real_same_optics real_other_optics real_published_optics; do
  grep -q "paper_results/$sheet.png" $real/table.md && [ -s $real/paper_results/$sheet.png ] || fail "no sheet $sheet"
done
# Tacchi's ball stands where ours does.
grep -q 'depth_mm: 0.8, steps: 1' $real/motions/objects/ball/motion.yaml || fail "other depths"

stamp() { find out -name '*.yaml' -not -name '*.timings.yaml' -printf '%p %T@\n' | sort; }
stamp > before.txt
goal made || fail "paper-real again"
stamp | cmp - before.txt || fail "a second run did something"
sed -i 's/ambient: 0.8/ambient: 0.7/' $made/legacy_tacchi.yaml
goal made || fail "paper-real with other optics"
stamp | comm -13 before.txt - | sed 's/ .*//' > after.txt
grep -q legacy-tacchi after.txt || fail "other optics change nothing"
! grep -qE 'mpm.yaml|calibrate.yaml|sim2real/|rivals/|simulated/tacchi/|legacy-depth-based/' after.txt || { cat after.txt; fail "more than the rows of those optics was made anew"; }

cp configs/studies/sim2real/made.yaml configs/studies/sim2real/other.yaml
! goal other || fail "a benchmark without its table"
grep -q 'configs/studies/sim2real/other/table.yaml does not exist' log.txt || { cat log.txt; fail "what is missing is not said"; }
[ ! -e out/sim2real/other ] || fail "something ran"

# Networks of three simulators on these photographs: two balls and a pyramid, two poses of each, small networks.
[ -x "$bin/depthnet" ] || { echo "depthnet is not built (libtorch-dev)"; exit 77; }
mkdir -p shared/data/tacipc_release/objects
write_pyramid shared/data/tacipc_release/objects/peak.stl
sed -i 's/only: \[.*\], unit: mm/only: [peak], unit: mm/; s/val_objects: .*/val_objects: [ball_2]}/; s/\[-4, 4\]/[-1, 1]/g; s/\[0.2, 1.1\], steps: 4/[0.3, 0.6], steps: 2/' configs/studies/depth/dataset.yaml
cp configs/gels/tiny.yaml configs/studies/depth/gel.yaml
"$bin/tacipc" set configs/depthnet/default.yaml network.levels=3 network.base_channels=4 network.reduction=1 > net.yaml && mv net.yaml configs/depthnet/default.yaml
depth() {
  make -s -f Makefile.data depth-benchmark CASES=$cases DEPTH_CASES=$cases DEPTH_PRINTED= DEPTH_BALLS='2 4' DEPTH_POSES=2 DEPTH_EPOCHS=2 DEPTH_SEEDS="$1" \
    OUT=out BUILD="$build_dir" PACKAGES=no SHARED=shared > log.txt 2>&1
}
cases=configs/studies/sim2real/made.yaml read=out/depth/read/made
depth "1 2" || { cat log.txt; fail "depth-benchmark"; }
for table in photographs_membrane photographs_surface simulated_membrane; do
  for row in "trained on TacIPC" "trained on Tacchi" "trained on the depth-based method" "trained on TacIPC, a quarter of the images, four times the epochs" "trained on TacIPC, every image with the depth of another" "no network: the gel is at rest everywhere"; do
    [ "$(grep -c "^| $row |" $read/tables/$table/table.md)" -ge 4 ] || { cat $read/tables/$table/table.md; fail "no row '$row' in $table"; }
  done
done
grep -q 'trained on TacIPC 2, trained on Tacchi 2' $read/tables/photographs_membrane/table.md || fail "the table does not say how many networks"
[ "$(wc -l < out/depth/lists/tacchi-train.txt) $(wc -l < out/depth/lists/depth-based-val.txt)" = "4 2" ] || fail "other samples than planned"
[ "$(cd out/depth/networks && "$bin/tacipc" get quarter/1/depthnet.yaml summary.images) $("$bin/tacipc" get out/depth/networks/quarter/1/network.yaml schedule.epochs)" = "1 8" ] || fail "no quarter"
[ -s $read/photographs/depth-based/2/sheet.png ] || fail "no sheet of answers"
# Who says that nothing is touched is wrong by all of the depth.
[ "$(grep -c ',pressed,.*,0,' $read/photographs/nothing/1/membrane/samples.csv)" = 2 ] || { cat $read/photographs/nothing/1/membrane/samples.csv; fail "no network, yet some depth"; }
stamp > before.txt
depth "1 2" || fail "depth-benchmark again"
stamp | cmp - before.txt || fail "a second run did something"
depth "1 3" || fail "depth-benchmark with another seed"
stamp | comm -13 before.txt - | sed 's/ .*//' > after.txt
[ "$(grep -c 'networks/.*/depthnet.yaml' after.txt)" = 3 ] && ! grep -vE 'networks/[a-z-]+/3/|networks/[a-z-]+/3.yaml|read/' after.txt || { cat after.txt; fail "another seed is three networks more"; }
# A sample whose rival failed is left out for all; too many are refused, and the lists stay as they are.
lists() { bash pipelines/paper/depth_lists.sh out/depth out/depth/datasets/depth "$bin/tacipc" lists tacipc tacchi depth-based > log.txt 2>&1; }
cp out/depth/lists/made.txt made.txt
rm "$(find out/depth/tacchi -name mpm.yaml | head -n 1)"
! lists || fail "five of six are fewer than nine in ten"
grep -q 'made 5$' log.txt && cmp made.txt out/depth/lists/made.txt || { cat log.txt; fail "lists of five"; }
cases=configs/studies/sim2real/gsmini_balls.yaml
! depth 1 || fail "photographs of unknown depths"
grep -q 'tells no depths' log.txt || { cat log.txt; fail "that depths are missing is not said"; }
echo "12 passed, 0 failed"
