#!/usr/bin/env bash
# The goal track on a pyramid pressed and dragged: every visible marker is found near where it is projected to, with the
# same bytes on one thread and two, and nothing to do a second time.
. "$(dirname "$0")/common.sh"

sed -i 's/width_px: 64/width_px: 320/; s/height_px: 48/height_px: 240/' configs/sensors/mctac.yaml
track() { # track OUT [VARIABLE=value …]
  local out=$1
  shift
  make -s -f Makefile.data track OBJECT=pyramid.stl MESH=tiny MOTION=shear STEPS=2 DEPTH_MM=0.3 SHEAR_MM=0.2 MOVE_STEPS=2 OUT="$out" BUILD="$build_dir" PACKAGES=no "$@" 2> said.txt ||
    { tail -5 said.txt >&2; fail "the goal failed"; }
}
track one THREADS=1 > summary.txt
track two THREADS=2 > /dev/null
same_files one two
value() { sed -n "s/^$1: //p" summary.txt; }
[ "$(value frames)" = "[0, 1, 2, 3, 4]" ] || { cat summary.txt; fail "not every frame was rendered"; }
[ "$(value known_places_lost)" = 0 ] || { cat summary.txt; fail "markers were lost"; }
[ "$(value known_places)" = $((5 * $(value markers))) ] || { cat summary.txt; fail "not every place is known"; }
awk -v e="$(value mean_error_px)" 'BEGIN { exit !(e < 0.1) }' || { cat summary.txt; fail "markers are not where they are projected to"; }
before=$(find one -name '*.yaml' -printf '%p %T@\n' | sort)
track one > /dev/null
[ "$before" = "$(find one -name '*.yaml' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"

# Without printed markers there is nothing to see.
sed -i '/^  radius_mm: 0.2/,/^  albedo_src/d' configs/sensors/mctac.yaml
make -s -f Makefile.data track OBJECT=pyramid.stl MESH=tiny STEPS=2 DEPTH_MM=0.3 OUT=three BUILD="$build_dir" PACKAGES=no > /dev/null 2> said.txt && fail "markers that are not printed were tracked"
grep -q 'frame_0000/marker.png: is not there; the sensor prints no markers' said.txt || { tail -3 said.txt; fail "why there are no tracks is not said"; }
echo "1 passed, 0 failed"
