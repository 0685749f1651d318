#!/usr/bin/env bash
# What a run of a dataset ends with: all that is made is packed, failed samples are listed, what is not kept is dropped; nothing is done twice.
. "$(dirname "$0")/common.sh"
sed -i 's/^vertices: .*/vertices: 3000/' configs/objects/patterns/*.yaml
mkdir mine
cat > mine/set.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects:
  - {emboss: ../configs/objects/patterns, only: [star]}
  - {meshes: .., only: [pyramid], unit: mm}
motions:
  - {name: down, samples: 2, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: [0.2, 0.3], steps: 1}}
  - {name: hard, samples: 1, press: hopeless.yaml, motion: {kind: press, depth_mm: 0.2, steps: 1}}
splits: {test_objects: [star]}
outputs: {pack: slim, keep: []}
END
cat configs/press/default.yaml > mine/hopeless.yaml
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
touch mine/set.yaml configs/datasets/pack/slim.yaml # the same plan and profile, later
goal out dataset > said.txt 2>&1 || fail "a run after all was dropped fails: $(cat said.txt)"
[ "$before" = "$(stamp)" ] || fail "a run after all was dropped did something: $(diff <(echo "$before") <(stamp))"
grep -q '^set: 6 samples: 6 made, 0 failed' said.txt || fail "dropped samples do not count"

# What can no longer be packed stays as it was, and what users download with it; another card and keys that no sample depends on ask for nothing of it.
whole() { (cd $set/pack && sha256sum --quiet -c checksums.sha256) && [ "$(find $set/pack/shards -name '*.h5' | wc -l)" = 2 ]; }
shards() { stat -c '%n %y' $set/shards/*/*.h5; }
before=$(stamp)
goal out pack PACK=full > said.txt 2>&1 && fail "what is gone was packed"
grep -q 'was dropped after packing and cannot be packed again; clean-press, then it is made again' said.txt || fail "it is not said why: $(cat said.txt)"
grep -q 'shards/[a-z]*-00000-of-00001 stays as it was before' said.txt || fail "it is not said what became of the shard: $(cat said.txt)"
whole || fail "a shard that was refused took what was packed with it"
goal out pack PACK=slim > said.txt 2>&1 || fail "with the profile of before it is not as before: $(cat said.txt)"
[ "$before" = "$(stamp | grep -v '/pack\.failed\.yaml ')" ] || fail "a shard that was refused did something: $(diff <(echo "$before") <(stamp))"
packed=$(shards)
sed -i 's/keep: \[\]}/keep: [], shard_mb: 900}/' mine/set.yaml
echo 'stop_after_failures: 7' >> mine/set.yaml
goal out dataset > said.txt 2>&1 || fail "a key that no sample depends on asks for them: $(cat said.txt)"
sed -i 's/^purpose:.*/purpose: Another one./' configs/datasets/card/default.yaml
goal out pack > said.txt 2>&1 || fail "what is packed gets no other card: $(cat said.txt)"
grep -qx 'Another one\.' $set/pack/README.md && whole && [ "$packed" = "$(shards)" ] || fail "another card is not there, or packed anew"
[ -s $set/pack/sensors/mctac/markers-tiny.csv ] || fail "the download has no markers"
for shard in "$set"/pack/shards/*.h5; do
  [ "$(/usr/bin/python3 -c 'import h5py, sys; print(h5py.File(sys.argv[1]).attrs["config_sha256"])' "$shard")" = "$(sha256sum < $set/pack/dataset.yaml | cut -c1-64)" ] || fail "$shard is of another dataset.yaml"
done

# A file of the dataset that is wrong leaves the plan, by which parts and status go on.
cp mine/set.yaml right.yaml
echo 'stop_after_failure: 7' >> mine/set.yaml
before=$(stamp)
for goal in plan dataset; do
  code=0
  goal out $goal > said.txt 2>&1 || code=$?
  [ "$code" = 2 ] && [ "$(grep -c 'unknown key (did you mean stop_after_failures?)' said.txt)" = 1 ] || fail "$goal does not refuse a wrong key: $(cat said.txt)"
  grep -q 'plan stays as it was before' said.txt || fail "it is not said what became of the plan: $(cat said.txt)"
done
goal out dataset-part PART=0 PARTS=2 > said.txt 2>&1 && goal out status >> said.txt 2>&1 || fail "without another plan there is none: $(cat said.txt)"
grep -q '^set: 6 samples: 6 made, 0 failed' said.txt && [ "$before" = "$(stamp)" ] || fail "a wrong key did something: $(cat said.txt)"
cp right.yaml mine/set.yaml

# What begins while the plan is replaced waits for the new one.
(
  flock 9
  mv $set/plan/plan.yaml replaced.yaml
  sleep 2
  mv replaced.yaml $set/plan/plan.yaml
) 9> $set/plan/.lock-plan &
for _ in $(seq 100); do [ -e $set/plan/plan.yaml ] || break; sleep 0.02; done
goal out pack > pack.txt 2>&1 &
packing=$!
goal out dataset-part PART=0 PARTS=2 > said.txt 2>&1 || fail "a part does not wait for a plan that is being replaced: $(cat said.txt)"
grep -q 'new or changed' said.txt && fail "a part made the plan anew while another did: $(cat said.txt)"
wait $packing || fail "packing does not wait for a plan that is being replaced: $(cat pack.txt)"

# Dropped samples are made again to the same records, which have the hashes of what was dropped.
goal out reproduce K=2 > said.txt 2>&1 && [ "$(grep -c ': equal bytes$' said.txt)" = 2 ] || fail "dropped samples cannot be reproduced: $(cat said.txt)"
cp -a out tampered
for record in tampered/datasets/set/samples/000/*/render/render.yaml; do
  sed -i -E '/^outputs:/,/^summary:/s|(indentation\.exr: )[0-9a-f]{4}|\1beef|' "$record"
done
goal tampered reproduce K=1 > said.txt 2>&1 && fail "other bytes than the record's went unseen"
grep -q 'reproduce: 1 of 1 samples differ' said.txt || fail "it is not said that a sample differs: $(cat said.txt)"
goal out clean-press
goal out dataset > said.txt 2>&1 || fail "what was dropped is not made anew: $(cat said.txt)"
[ "$(files press.yaml)" = 6 ] || fail "not all was made anew"

# Or nothing of this.
sed -i 's/pack: slim, keep: \[\], shard_mb: 900/pack: none/' mine/set.yaml
goal plain dataset > /dev/null 2>&1 || fail "without packing it is not made"
[ ! -e plain/datasets/set/pack ] || fail "it is packed though it should not"
[ "$(find plain/datasets/set/samples -name positions.npy | wc -l)" = 6 ] || fail "what is not packed is dropped"

# Two endings at once: one packs and drops, the other finds it done.
sed -i 's/pack: none/pack: slim, keep: []/' mine/set.yaml
goal plain plan > /dev/null 2>&1
for task in 0 1 2; do
  if [ $task = 2 ]; then goal plain pack PACK=slim > last_$task.txt 2>&1 & else goal plain dataset-last > last_$task.txt 2>&1 & fi
  endings[task]=$!
done
for task in 0 1 2; do wait "${endings[task]}" || fail "an ending beside others fails: $(cat last_$task.txt)"; done
[ "$(cat last_?.txt | grep -c '^pack: [a-z]*-00000-of-00001: ')" = 2 ] && [ "$(cat last_?.txt | grep -c '^card: ')" = 1 ] || fail "it is packed more than once: $(cat last_?.txt)"
(cd plain/datasets/set/pack && sha256sum --quiet -c checksums.sha256) || fail "the checksums do not hold"
[ "$(find plain/datasets/set/samples -name positions.npy | wc -l)" = 0 ] || fail "what is packed is not dropped"
echo "1 passed, 0 failed"
