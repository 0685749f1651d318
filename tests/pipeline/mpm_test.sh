#!/usr/bin/env bash
# Material points from a mesh to Tacchi's image on a tiny gel: equal bytes with one and two threads, nothing to do a second
# time, and what the stages after it read.
. "$(dirname "$0")/common.sh"

# Coarse numerics, and a block of 6 x 6 x 1.6 mm in place of the published one.
sed -i -e 's/counts: .*/counts: [31, 31, 9]/; s/samples_per_mm2: 600 .*/samples_per_mm2: 60/' configs/rivals/mpm/legacy.yaml
sed -i -e 's/rows: 19 /rows: 3 /; s/columns: 19/columns: 3/; s/window_mm: .*/window_mm: [5.0, 3.75]/' configs/sensors/mctac.yaml
sample() { make -s -f Makefile.data mpm-sample OBJECT=pyramid.stl STEPS=2 MPM=legacy BUILD="$build_dir" PACKAGES=no "$@"; }
material_points() { # material_points OUT [VARIABLE=value …]
  local out=$1
  shift
  sample DEPTH_MM=0.4 OUT="$out" "$@"
}
material_points one THREADS=1
material_points two THREADS=2
same_files one two
folder=one/sample/pyramid/mpm-legacy
for file in markers.npy object_pose.npy frame_0002/indentation.exr frame_0002/depth.exr; do
  [ -s "$folder/$file" ] || fail "$file is missing"
done
grep -q '^  largest_mach: 0\.' "$folder/mpm.yaml" || fail "the record does not tell how fast the object was"

stamp() { find one -name '*.yaml' -not -name '*.timings.yaml' -printf '%p %T@\n' | sort; }
before=$(stamp)
material_points one
[ "$before" = "$(stamp)" ] || fail "a second run did something"

# Its depth maps are what the depth-based stage shades: Tacchi's own image. The picture of the gel at rest is one colour
# everywhere, hence a background.
"$build_dir/bin/baseline" --config configs/rivals/baseline/tacchi.yaml --sensor configs/sensors/mctac.yaml --background "$folder/frame_0000/indentation.png" \
  --depth "$folder"/frame_*/depth.exr --out tacchi
[ -s tacchi/frame_0002/tactile.png ] || fail "there is no image"
cmp -s tacchi/frame_000{0,2}/tactile.png && fail "the press does not show"
# What is seen of the gel at rest and pressed is what the stage before saw; a texture lies over it.
cmp -s tacchi/frame_0002/indentation.exr "$folder/frame_0002/indentation.exr" && fail "a front that bulges is not cut off"

# Loads are not prescribed motions, and a spacing must fit the gel.
if sample OUT=one NAME=loaded FORCE_N=1 2> said.txt; then fail "a load was accepted"; fi
grep -q 'mpm moves it by prescribed motions only' said.txt || fail "the refusal does not say why"
sed -i 's/spacing_mm: 0.1 *$/spacing_mm: 0.3/' configs/rivals/mpm/physical.yaml
if material_points one MPM=physical 2> said.txt; then fail "a spacing that does not fit was accepted"; fi
grep -q 'is not a multiple of the spacing of 0.3 mm' said.txt || fail "the refusal does not say why"
echo "1 passed, 0 failed"
