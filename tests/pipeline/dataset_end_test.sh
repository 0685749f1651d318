#!/usr/bin/env bash
# What a run of a dataset ends with: all that is made is packed, failed samples are listed, what is not kept is dropped; nothing is done twice.
. "$(dirname "$0")/common.sh"
sed -i 's/^vertices: .*/vertices: 3000/' configs/emboss/*.yaml
mkdir mine
cat > mine/set.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/tetmesh/tiny.yaml}
objects:
  - {emboss: ../configs/emboss, only: [star]}
  - {meshes: .., only: [pyramid], unit: mm}
motions:
  - {name: down, samples: 2, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: [0.2, 0.3], steps: 1}}
  - {name: hard, samples: 1, press: hopeless.yaml, motion: {kind: press, depth_mm: 0.2, steps: 1}}
splits: {test_objects: [star]}
outputs: {pack: slim, keep: []}
END
cat configs/press/friction.yaml > mine/hopeless.yaml
printf '  max_iterations: 1\n  max_halvings: 0\n' >> mine/hopeless.yaml
goal() { # goal OUT GOAL [VARIABLE=value …]
  local out=$1 goal=$2
  shift 2
  make -s -f Makefile.data "$goal" CONFIG=mine/set.yaml OUT="$out" BUILD="$build_dir" PACKAGES=no REBUILD=no "$@"
}
set=out/datasets/set
files() { find $set/samples -name "$1" | wc -l; }
stamp() { find $set -name '*.yaml' -not -name '*.timings.yaml' -not -path '*/plan/*' -printf '%p %T@\n' -o -name '*.h5' -printf '%p %T@\n' | sort; }

# Failed samples are in the tables, and what is packed beside them stays until they are made.
goal out dataset JOBS=2 > said.txt 2>&1 && fail "failed samples went unseen"
grep -q '^set: 6 samples: 4 made, 2 failed, 0 running, 0 left$' said.txt || fail "the failures are not counted: $(cat said.txt)"
(cd $set/pack && sha256sum --quiet -c checksums.sha256) || fail "it is not packed"
[ "$(grep -c ',made,' $set/pack/manifest.csv)" = 4 ] && [ "$(grep -c '^mctac__[a-z]*__hard__' $set/pack/failures.csv)" = 2 ] || fail "the tables are wrong: $(cat $set/pack/*.csv)"
grep -q '"path": "obs/normal".*"packed": false' <(tr -d '\n' < $set/pack/schema.json) || fail "it is packed by another profile"
[ "$(files positions.npy)" = 4 ] || fail "what will have to be packed again is dropped"
before=$(stamp)
goal out dataset > said.txt 2>&1 && fail "old failures went unseen"
[ "$before" = "$(stamp)" ] || fail "a second run did something"

# All made: packed, and dropped but for records.
sed -i '/max_iterations/d; /max_halvings/d' mine/hopeless.yaml
goal out dataset > said.txt 2>&1 || fail "it is not completed: $(cat said.txt)"
[ "$(grep -c ',made,' $set/pack/manifest.csv)" = 6 ] && [ "$(wc -l < $set/pack/failures.csv)" = 1 ] || fail "not all is packed"
[ "$(files positions.npy)" = 0 ] && [ "$(files tactile.png)" = 0 ] && [ "$(files press.yaml)" = 6 ] || fail "what is packed is not dropped, or more than that"
before=$(stamp)
touch mine/set.yaml configs/pack/slim.yaml # the same plan and profile, later
goal out dataset > said.txt 2>&1 || fail "a run after all was dropped fails: $(cat said.txt)"
[ "$before" = "$(stamp)" ] || fail "a run after all was dropped did something: $(diff <(echo "$before") <(stamp))"
grep -q '^set: 6 samples: 6 made, 0 failed' said.txt || fail "dropped samples do not count"
goal out pack PACK=full > said.txt 2>&1 && fail "what is gone was packed"
grep -q 'was dropped after packing and cannot be packed again; clean-press, then it is made anew' said.txt || fail "it is not said why: $(cat said.txt)"
goal out clean-press
goal out dataset > said.txt 2>&1 || fail "what was dropped is not made anew: $(cat said.txt)"
[ "$(files press.yaml)" = 6 ] || fail "not all was made anew"

# Or nothing of this.
sed -i 's/pack: slim, keep: \[\]/pack: none/' mine/set.yaml
goal plain dataset > /dev/null 2>&1 || fail "without packing it is not made"
[ ! -e plain/datasets/set/pack ] || fail "it is packed though it should not"
[ "$(find plain/datasets/set/samples -name positions.npy | wc -l)" = 6 ] || fail "what is not packed is dropped"
echo "1 passed, 0 failed"
