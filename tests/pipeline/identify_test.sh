#!/usr/bin/env bash
# A press with known mechanics is measured, between the nodes; identify finds them by presses at the nodes, the sensor file that it writes presses like
# the truth, and a card is made of it. Another prior presses nothing again; what is wrong is told.
. "$(dirname "$0")/common.sh"
bin=$build_dir/bin
[ -x "$bin/identify" ] || { echo "identify is not built (libceres-dev)"; exit 77; }

mkdir -p mine shared/data
cat > mine/mesh.yaml <<'END'
kind: generate
seed: 1
sizing: {centre_mm: 1.2, centre_radius_mm: 4, inner_mm: 2, inner_radius_mm: 6, rim_mm: 4, rim_exponent: 1, back_mm: 3, depth_exponent: 0.7}
tetrahedra: {radius_edge_ratio: 1.4, circumradius_ratio: 0.85, min_dihedral_deg: 10, optimization_level: 4, smoothing_sweeps: 5}
limits: {max_vertices: 20000, min_dihedral_deg: 2}
END
cat > mine/press.yaml <<'END'
time_step_s: 0.1
dynamics: quasi_static
barrier: {relative_d_hat: 5.0e-4, relative_stiffness: 0.1, pairs: once}
friction: {coefficient: 0.6, relative_speed_threshold: 1.0e-3}
newton: {relative_velocity_tolerance: 1.0e-4}
END
cat > mine/gel.yaml <<'END'
title: gel
sensor: ../configs/sensors/mctac.yaml
mesh: mesh.yaml
press: press.yaml
draws: 2000
members: 3
parameters:
  youngs_modulus_pa: {mean: 1.0e+5, factor: 2}
  thickness_mm: {mean: 2.2, sigma: 0.5, nodes: [1.6, 2.2, 2.8]}
  mount_compliance_mm_per_n: {mean: 0.02, sigma: 0.05, bounds: [0, 0.5]}
measurements:
  - {name: small, kind: press, ball: {radius_mm: 2, edge_mm: 0.5}, file: data/small.csv, columns: {depth_mm: depth, force_n: force}, factors: {force_n: -1}, sigma: {relative: 0.005, force_n: 0.001}, fit_to_mm: 0.7, predict_mm: [0.85], simulate: {to_mm: 0.9, press_frames: 9}}
  - {name: large, kind: press, ball: {radius_mm: 7, edge_mm: 0.8}, file: data/large.csv, columns: {depth_mm: depth, force_n: force}, sigma: {relative: 0.005, force_n: 0.001}, simulate: {to_mm: 0.9, press_frames: 9}}
checks: [{name: other_law, changes: [material.law=stvk_hencky]}, {name: same, press: press.yaml}]
END

# The truth lies between the nodes; its rows are those of a press.
"$bin/tacipc" set configs/sensors/mctac.yaml material.youngs_modulus_pa=1.5e5 gel.thickness_mm=2.35 +mount.compliance_mm_per_n=0.03 > mine/truth.yaml
"$bin/tetmesh" --sensor mine/truth.yaml --config mine/mesh.yaml --out truth/gel > said.txt 2>&1 || fail "tetmesh failed: $(tail -2 said.txt)"
measured() { # measured NAME RADIUS EDGE SIGN SENSOR GEL OUT
  echo "ball: {radius_mm: $2, edge_mm: $3}" > mine/ball.yaml
  echo 'motion: {kind: press, depth_mm: 0.8, steps: 8}' > mine/motion.yaml
  "$bin/indenter" --config mine/ball.yaml --out "$7/$1/ball" >> said.txt 2>&1 && "$bin/press" --name "$1" --object "$7/$1/ball/object.ply" \
    --object-config configs/objects/embossed.yaml --gel "$6" --sensor "$5" --config mine/press.yaml --sample mine/motion.yaml --out "$7/$1/press" >> said.txt 2>&1 ||
    fail "the measured press of $1 failed: $(tail -2 said.txt)"
  /usr/bin/python3 - "$7/$1/press" "$4" > "shared/data/$1.csv.new" <<'END'
import sys
import numpy as np
force = -np.load(sys.argv[1] + "/wrench.npy")[:, 2]
# The holder's way, of which the last frame is 0.8 mm deep.
holder = np.load(sys.argv[1] + "/holder_pose.npy")[:, 2, 3]
print("depth,force")
for z, f in zip(holder, force):
    depth = 0.8 - 1e3 * (z - holder[-1])
    if depth > 0.05:
        print(f"{depth:.6f},{float(sys.argv[2]) * f:.6f}")
END
  mv "shared/data/$1.csv.new" "shared/data/$1.csv"
}
measured small 2 0.5 -1 mine/truth.yaml truth/gel/gel.msh truth
measured large 7 0.8 1 mine/truth.yaml truth/gel/gel.msh truth

identify() { make -s -f Makefile.data identify IDENTIFY=mine/gel.yaml SHARED=shared OUT="$scratch/out" BUILD="$build_dir" PACKAGES=no REBUILD=no > said.txt 2>&1; }
identify || { tail -5 said.txt >&2; fail "the goal failed"; }
fit=out/identify/gel/fit
/usr/bin/python3 - $fit/identify.yaml <<'END' || { cat $fit/table.md >&2; fail "the mechanics are others"; }
import re, sys
text = open(sys.argv[1]).read()
found = {n: (float(v), float(s)) for n, v, s in re.findall(r"- name: (\w+)\n +value: (\S+)\n +sigma: (\S+)", text)}
truth = {"youngs_modulus_pa": 1.5e5, "thickness_mm": 2.35, "mount_compliance_mm_per_n": 0.03}
for name, value in truth.items():
    got, sigma = found[name]
    # The nodes' gels have other meshes than the truth: a per cent.
    assert abs(got - value) < 3 * sigma + 0.02 * value, (name, got, sigma, value)
    assert sigma < {"youngs_modulus_pa": 2e4, "thickness_mm": 0.2, "mount_compliance_mm_per_n": 0.02}[name], (name, sigma)
# Rows of the small ball beyond 0.7 mm were not fitted.
rows = re.findall(r"depth_mm: (\S+)\n +force_n: (\S+)(?:\n .*?)*?\n +fitted: (\w+)\n +measured_n: (\S+)", text)
predicted = [(float(f), float(m)) for d, f, fitted, m in rows if fitted == "false"]
assert predicted and all(abs(f / m - 1) < 0.03 for f, m in predicted), predicted
END
grep -q 'youngs_modulus_pa: .*# \[fitted ± ' $fit/sensor.yaml || fail "the sensor file does not say what was fitted"
grep -q 'poissons_ratio: 0.43  # \[measured\] paper' $fit/sensor.yaml || fail "the sensor file does not say what was measured"
[ "$(grep -c 'name: m0' $fit/ensemble.yaml)" = 3 ] || fail "there are not three members"
grep -q 'sensor: sensor.yaml' $fit/ensemble.yaml || fail "the ensemble is not of the fitted sensor"
# A check that changes nothing: no error of the model.
awk '/^  modulus_error:/ { inside = 1 } inside && /same:/ { exit !($2 < 1e-12 && $2 > -1e-12) }' $fit/identify.yaml || fail "a check that changes nothing changes the modulus"
for picture in curve_small residual_large profile_thickness_mm; do [ -s $fit/$picture.svg ] || fail "there is no $picture.svg"; done

# The sensor file presses like the truth.
"$bin/tetmesh" --sensor $fit/sensor.yaml --config mine/mesh.yaml --out again/gel > said.txt 2>&1 || fail "tetmesh failed: $(tail -2 said.txt)"
cp shared/data/large.csv large.csv
measured large 7 0.8 1 $fit/sensor.yaml again/gel/gel.msh again
/usr/bin/python3 - large.csv shared/data/large.csv <<'END'
import sys
last = [float(open(f).read().split()[-1].split(",")[1]) for f in sys.argv[1:]]
assert abs(last[1] / last[0] - 1) < 0.03, last
END
cp large.csv shared/data/large.csv

presses() { find out/identify/gel/runs -name press.yaml -printf '%p %T@\n' | sort; }
before=$(presses)
sed -i 's/factor: 2/factor: 1.5/' mine/gel.yaml
identify || fail "another prior failed: $(tail -3 said.txt)"
[ "$before" = "$(presses)" ] || fail "another prior pressed again"

cat > mine/card.yaml <<'END'
kind: card
title: a gel
mechanics: [gel.yaml]
END
make -s -f Makefile.data blind-card CASES=mine/card.yaml SHARED=shared OUT="$scratch/out" BUILD="$build_dir" PACKAGES=no REBUILD=no > said.txt 2>&1 || fail "the card failed: $(tail -3 said.txt)"
grep -q 'predicted: inside\|predicted: outside' out/cards/card/card.md || fail "the card predicts nothing"
[ -s out/cards/card/gel_curve_small.svg ] || fail "the card has no curve"
[ "$("$bin/tacipc" get out/cards/card/card.yaml mechanics.gel.unknowns[0].name)" = youngs_modulus_pa ] || fail "card.yaml does not name the modulus"

wrong() { # wrong MESSAGE FILE
  refused 2 "$1" make -s -f Makefile.data identify IDENTIFY="$2" SHARED=shared OUT="$scratch/wrong" BUILD="$build_dir" PACKAGES=no REBUILD=no
}
sed 's/nodes: \[1.6, 2.2, 2.8\]/nodes: [2.8, 1.6]/' mine/gel.yaml > mine/nodes.yaml
wrong 'nodes: must ascend' mine/nodes.yaml
sed 's/bounds: \[0, 0.5\]/bounds: [0.1, 0.5]/' mine/gel.yaml > mine/bounds.yaml
wrong 'mount_compliance_mm_per_n.bounds: must be the least and the largest value' mine/bounds.yaml
sed 's/small.csv/gone.csv/' mine/gel.yaml > mine/gone.yaml
wrong 'there is no shared/data/gone.csv, which mine/gone.yaml names' mine/gone.yaml
sed 's/quasi_static/implicit_euler/' mine/press.yaml > mine/moving.yaml
sed 's/press: press.yaml/press: moving.yaml/' mine/gel.yaml > mine/dynamics.yaml
wrong 'dynamics: must be quasi_static' mine/dynamics.yaml
sed 's/name: other_law/name: n00/' mine/gel.yaml > mine/twice.yaml
wrong 'two folders would be called n00' mine/twice.yaml
wrong 'IDENTIFY: nothing.yaml does not exist' nothing.yaml
refused 2 'is no card' make -s -f Makefile.data blind-card CASES=mine/gel.yaml OUT="$scratch/wrong" BUILD="$build_dir" PACKAGES=no REBUILD=no
echo "1 passed, 0 failed"
