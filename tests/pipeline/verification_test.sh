#!/usr/bin/env bash
# The goal verification on a tiny case and tiny long rows: one page over all of them, whoever made them and in whatever order.
. "$(dirname "$0")/common.sh"
rm configs/studies/verification/*.yaml
scene='gel:
  box: {size_mm: [6, 6, 2], near_mm: 1, near_half_mm: 1, growth: 1.2, far_mm: 2, layer_mm: 1, layer_growth: 1.2}
material: {law: neo_hookean, density_kg_m3: 1010, youngs_modulus_pa: 1.0e+5, poissons_ratio: 0.3}
shape:
  sphere: {radius_mm: 4, edge_mm: 0.8, fine_radius_mm: 1.5}
press:
  time_step_s: 0.02
  barrier: {relative_d_hat: 2.0e-3, relative_stiffness: 0.1}
  friction: {coefficient: 0.5, relative_speed_threshold: 4.0e-3, lag: once}
  newton: {relative_velocity_tolerance: 1.0e-2}
motion:
  - {kind: press, depth_mm: 0.2, steps: 1}
  - {kind: shear, direction_deg: 0, distance_mm: 0.1, steps: 1}'
printf 'title: a tiny case\nsource: none\n%s\nexpect:\n  - {quantity: press_force_n, at_least: 1.0e-3}\n' "$scene" > configs/studies/verification/tiny.yaml
printf 'title: a tiny scene\n%s\nfront: {half_mm: 1, pitch_mm: 0.5}\nrefine:\n%s\n%s\n' "$scene" \
  '  - {parameter: time_step, coarsest: 1, factor: 2, levels: 3}' '  - {parameter: d_hat, coarsest: 1, factor: 2, levels: 3}' > configs/studies/refinement/sphere_shear.yaml
page=out/verification/page/verification.md
count=0

ends() { # ends CODE GOAL… [VARIABLE=value …]
  local code=$1 got=0
  shift
  make -s -f Makefile.data "$@" REFINEMENT_STUDIES='time_step d_hat' FREE_OBJECT_TESTS='stages/gel/press/press_test=RigidMotion.*' SHARED=no_such_folder OUT=out \
    BUILD="$build_dir" PACKAGES=no >log.txt 2>&1 || got=$?
  [ "$got" = "$code" ] || { cat log.txt; fail "'make $*' ended with $got, expected $code"; }
  count=$((count + 1))
}
shows() { grep -qE -- "$2" "$1" || { cat "$1" log.txt; fail "$1 does not show '$2'"; }; }
untouched() { [ -z "$(find out -newer "$1" -name "$2")" ] || fail "$2 was made again"; }

# The cases alone: their page stands in OUT/docs, and says what has not been run.
ends 0 verification-cases
cmp $page out/docs/verification.md || fail "out/docs/verification.md is not the page"
shows $page '^\| \[a tiny case\].*\| holds \|$'
shows $page '^\| Refinement \|.*not run\*\*: `make -f Makefile.data refinement` \|$'
shows $page '^\| Stress campaign \|.*not run\*\*: `make -f Makefile.data stress` \|$'
shows $page '^\| Markers under board3 \|.*skipped\*\*: needs data/tacipc_release/objects/board3.obj; there is no folder no_such_folder'

# Everything; a campaign of two cases is not the one that the documentation shows.
cp out/docs/verification.md before.md
ends 0 verification N=2
cmp before.md out/docs/verification.md || fail "a small campaign went to OUT/docs"
[ ! -e out/docs/stress.md ] || fail "a small campaign went to OUT/docs"
shows $page '^\| \[Refinement\]\(verification/refinement.md\) \|.*\(time step\), .* \| holds \|$'
shows $page '^\| \[Stress campaign\]\(stress.md\) \|.*\| 2 of 2 cases of seed 1 converged, .* \| holds \|$'
[ -e out/docs/verification/refinement.md ] && [ -e out/docs/verification/refinement_d_hat.svg ] && [ -e out/docs/verification/tiny.svg ] || fail "out/docs/verification lacks files"

# What is done stays done, and the cases alone forget no long row.
touch done.txt
cp $page before.md
ends 0 refinement
ends 0 verification-cases N=2
cmp before.md $page || fail "the order of the goals shows in the page"
ends 0 verification N=2
cmp before.md $page || fail "the order of the goals shows in the page"
for record in verify.yaml refinement.yaml refinement_table.yaml stress_case.yaml stress_table.yaml; do untouched done.txt $record; done

# A campaign of 300 cases, by its record: the documentation shows it.
mkdir -p out/stress/1/first_300
printf 'stage: stress_table\nsummary:\n  holds: true\n  found: all 300\n' > out/stress/1/first_300/stress_table.yaml
ends 0 verification-cases
shows out/docs/verification.md '^\| \[Stress campaign\]\(stress.md\) \|.*\| all 300 \| holds \|$'

# A long row that missed: the page is written, the goal fails, but not that of the cases.
sed -i 's/^  holds: true/  holds: false/' out/refinement/page/refinement_table.yaml
rm $page
ends 2 verification N=2
shows $page '^\| \[Refinement\].*\| \*\*missed\*\* \|$'
ends 2 refinement
ends 0 verification-cases N=2

# Work that failed: so too, with the reason; it is tried again.
sed -i 's/newton: {/newton: {max_iterations: 1, max_halvings: 0, /' configs/studies/refinement/sphere_shear.yaml
mkdir -p out/board3/focused_0200um-friction_viscous/page
echo 'message: too late to judge' > out/board3/focused_0200um-friction_viscous/page/marker_curve.failed.yaml
for _ in 1 2; do
  rm $page
  ends 2 verification N=2
  shows log.txt 'out/refinement/d_hat/refinement.yaml: not made'
  shows $page '^\| \[Refinement\].*\| time_step failed: .*; d_hat failed: .* \| \*\*missed\*\* \|$'
  shows $page '^\| Markers under board3 \|.*\| \*\*failed\*\*: too late to judge \|$'
done
shows out/docs/verification/refinement.md '^\*\*failed\*\*: '

# Nothing of this has touched the sources; docs-update copies the pages, and a cost model only where one was measured.
[ ! -e docs ] || fail "docs/ was written"
cmp configs/studies/speed/cost_model.yaml "$source_dir/configs/studies/speed/cost_model.yaml" || fail "the cost model was written"
ends 0 docs-update
diff -r out/docs docs || fail "docs-update did not copy the pages"
cmp configs/studies/speed/cost_model.yaml "$source_dir/configs/studies/speed/cost_model.yaml" || fail "a cost model that nobody measured was copied"
mkdir -p out/bench/page
echo 'press_frame_s: 1' > out/bench/page/cost_model.yaml
ends 0 docs-update
cmp configs/studies/speed/cost_model.yaml out/bench/page/cost_model.yaml || fail "the measured cost model was not copied"
mv out/docs moved
ends 2 docs-update
shows log.txt 'docs-update: there is no out/docs'
echo "$count passed, 0 failed"
