#!/usr/bin/env bash
# What estimate says after a pilot is what the dataset then costs, within a quarter: processor seconds and bytes on disk.
. "$(dirname "$0")/common.sh"
sed -i 's/^vertices: .*/vertices: 3000/' configs/objects/patterns/*.yaml
mkdir mine meshes
mv pyramid.stl meshes
cat > mine/set.yaml <<'END'
seed: 3
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects:
  - {emboss: ../configs/objects/patterns, only: [star, dots]}
  - {meshes: ../meshes, unit: mm}
motions:
  - {name: down, samples: 4, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: [0.2, 0.4], steps: 2}}
  - name: along
    samples: 4
    placement: {center_mm: {x: [-1, 1], y: [-1, 1]}, rotate_deg: [0, 90]}
    motion: [{kind: press, depth_mm: [0.2, 0.4], steps: 2}, {kind: shear, distance_mm: [0.1, 0.3], direction_deg: [0, 360], steps: 4}]
outputs: {pack: none}
END
goal() { # goal GOAL [VARIABLE=value …]
  make -s -f Makefile.data "$1" CONFIG=mine/set.yaml OUT=out BUILD="$build_dir" PACKAGES=no REBUILD=no JOBS=2 "${@:2}"
}
set=out/datasets/set
within() { # within WHAT SAID MEASURED
  awk -v said="$2" -v measured="$3" -v what="$1" 'BEGIN { printf "%s: %g estimated, %g measured\n", what, said, measured; exit !(said > 0.75 * measured && said < 1.25 * measured) }' || fail "the estimate of $1 is off by more than a quarter"
}
goal estimate PILOT=8 > said.txt 2>&1 || fail "no estimate: $(cat said.txt)"
[ "$(find $set/samples -name render.yaml | wc -l)" = 8 ] || fail "it is not a pilot of eight samples"
line=$(grep '^set: 24 samples: ' said.txt) || fail "the estimate does not say: $(cat said.txt)"
grep -q '^  measured on 8 made samples' said.txt || fail "the pilot does not count: $(cat said.txt)"
goal dataset > said.txt 2>&1 || fail "the dataset is not made: $(cat said.txt)"
within processor "$(sed 's/.*samples: \([0-9.e+-]*\) core-hours.*/\1/' <<< "$line" | awk '{ print 3600 * $1 }')" \
  "$(find $set/samples -name '*.timings.yaml' -exec sed -n 's/^processor_s: //p' {} + | awk '{ s += $1 } END { print s }')"
within disk "$(sed 's/.*, \([0-9.e+-]*\) GB on disk$/\1/' <<< "$line" | awk '{ print 1e9 * $1 }')" "$(du -sk $set/samples/*/* | awk '{ s += 1024 * $1 } END { print s }')"
echo "1 passed, 0 failed"
