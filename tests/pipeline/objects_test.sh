#!/usr/bin/env bash
# Real objects of different kinds pressed 0.5 mm deep into our own gel, from one command each.
. "$(dirname "$0")/common.sh"
shared=${TACIPC_SHARED:-$source_dir/../shared}
if [ ! -d "$shared" ]; then
  echo "SKIPPED: needs data/tacipc_release and data/printed_indenters below $shared (set TACIPC_SHARED)"
  exit 77
fi
count=0
for object in tacipc_release/objects/coin_5002.obj tacipc_release/objects/dragon_01.obj printed_indenters/cone.stl printed_indenters/cross_lines.stl; do
  make -s -f Makefile.data sample OBJECT="$shared/data/$object" FACE=+z OUT=out BUILD="$build_dir" PACKAGES=no
  record=out/sample/$(basename "${object%.*}")/press/press.yaml
  grep -q '^  converged: true' "$record" || fail "$object did not converge"
  grep -q '^  intersections: 0' "$record" || fail "$object intersects"
  awk '/^  min_distance_m:/ { exit !($2 > 0) }' "$record" || fail "$object touches"
  awk '/^  min_volume_ratio:/ { exit !($2 > 0) }' "$record" || fail "$object inverts"
  count=$((count + 1))
done
echo "$count passed, 0 failed"
