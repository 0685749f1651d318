#!/usr/bin/env bash
# An open mesh whose undercut matters: `sample` presses what its side shows, and with WRAP a surface wrapped around it; a dataset does the same.
. "$(dirname "$0")/common.sh"
[ -x "$build_dir/bin/wrap" ] || { echo "wrap is not built (libcgal-dev)"; exit 77; }

# A knob under a plate, in mm: one sheet, open at the plate's rim and down the neck. Between knob and plate is an undercut of 1.4 mm.
/usr/bin/python3 - > mushroom.off <<'END'
from math import cos, sin, pi
rings = [(0.8, 0.1), (1.4, 0.6), (1.5, 1.0), (1.2, 1.4), (0.3, 1.6), (0.3, 3.0), (2.5, 3.0)]
n = 24
points = [(0, 0, 0)] + [(r * cos(2 * pi * i / n), r * sin(2 * pi * i / n), z) for r, z in rings for i in range(n)]
at = lambda ring, i: 1 + ring * n + i % n
faces = [(0, at(0, i + 1), at(0, i)) for i in range(n)]
for ring in range(len(rings) - 1):
    for i in range(n): faces += [(at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)), (at(ring, i), at(ring + 1, i + 1), at(ring + 1, i))]
print("OFF")
print(len(points), len(faces), 0)
for point in points: print(*point)
for face in faces: print(3, *face)
END

value() { "$build_dir/bin/tacipc" get "$@"; }
sample() { make -s -f Makefile.data sample OBJECT=mushroom.off FACE=-z MESH=tiny STEPS=1 DEPTH_MM=0.3 OUT=made BUILD="$build_dir" PACKAGES=no REBUILD=no "$@" > said.txt 2>&1; }
folder=made/sample/mushroom
volume() { value $folder/object/decimate.yaml summary.volume_mm3; }
page() { cat $folder/report/index.html; }

sample || fail "no sample of what the side shows: $(cat said.txt)"
[ "$(value $folder/object/decimate.yaml summary.repairs.height_field.side)" = -z ] || fail "the open mesh is not taken by its side"
[ ! -e $folder/wrap ] || fail "wrapped without being asked to"
filled=$(volume)

sample WRAP=0.4 || fail "no sample of a wrap: $(cat said.txt)"
grep -q 'wrap: warning: the mesh is replaced by a surface wrapped around it, .* mm from it in the mean' said.txt || fail "the log does not say so: $(cat said.txt)"
[ "$(value $folder/wrap/wrap.yaml summary.alpha_mm)" = 0.4 ] || fail "wrapped with another alpha"
error() { value $folder/wrap/wrap.yaml "summary.seen_mesh_to_wrap_mm.$1"; }
# From above one sees down the neck, which is filled.
awk -v mean="$(error mean)" -v max="$(error max)" 'BEGIN { exit !(mean > 0.02 && mean < 0.1 && max > 1) }' || fail "the wrap is $(error mean) mm off in the mean, $(error max) mm at most"
[ "$(value $folder/object/decimate.yaml summary.repairs.height_field --default none)" = none ] || fail "the wrap is not taken"
volume | awk -v filled="$filled" '{ exit !($1 > 0 && $1 < 0.6 * filled) }' || fail "the undercut is filled: $(volume) mm3 of $filled"
page | grep -q "wrapped around it, which fills gaps" || fail "the page does not say so"
page | grep -q 'wrap/wrap.yaml' || fail "the page does not link the record"
before=$(find made -name '*.yaml' -printf '%p %T@\n' | sort)
sample WRAP=0.4
[ "$before" = "$(find made -name '*.yaml' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"

code=0
sample WRAP=-1 || code=$?
[ "$code" = 2 ] && grep -qE "object.yaml:[0-9]+:18: wrap.alpha_mm: -1 is outside" said.txt || fail "WRAP=-1 is not refused: $(cat said.txt)"
sample || fail "not without the wrap again: $(cat said.txt)"
[ "$(volume)" = "$filled" ] || fail "the wrap stays when it is no longer asked for"
! page | grep -q "wrapped around it" || fail "the page still tells of the wrap"

# The same in a dataset.
cat > set.yaml <<'END'
seed: 1
sensors: {sensor: configs/sensors/mctac.yaml, mesh: configs/gels/tiny.yaml}
objects: {meshes: mushroom.off, unit: mm, up: +z, wrap: {alpha_mm: 0.4}}
motions: {name: press, samples: 1, motion: {kind: press, depth_mm: 0.3, steps: 1}}
END
make -s -f Makefile.data dataset CONFIG=set.yaml OUT=made BUILD="$build_dir" PACKAGES=no REBUILD=no > said.txt 2>&1 || fail "no dataset: $(cat said.txt)"
cmp made/datasets/set/objects/mushroom/wrap/object.ply <(sample WRAP=0.4 && cat $folder/wrap/object.ply) || fail "the dataset's wrap is another"
[ -s "$(echo made/datasets/set/samples/*/*/render/render.yaml)" ] || fail "the dataset's sample is not made"
echo "1 passed, 0 failed"
