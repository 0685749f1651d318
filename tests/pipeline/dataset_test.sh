#!/usr/bin/env bash
# A dataset from one file: equal bytes whole, in parts and by two runs at once; failures are noted, left alone and retried; a changed
# motion redoes just its own samples; a killed run loses nothing. Leaves pages for dataset_page_test.sh.
. "$(dirname "$0")/common.sh"
sed -i 's/^vertices: .*/vertices: 3000/' configs/objects/patterns/*.yaml
mkdir mine
cat > mine/set.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects:
  - {emboss: ../configs/objects/patterns, only: [star, gear]}
  - {meshes: .., only: [pyramid], unit: mm}
motions:
  - name: down
    samples: 2
    placement: {center_mm: {x: [-1, 1], y: [-1, 1]}, rotate_deg: [0, 90]}
    motion: {kind: press, depth_mm: [0.2, 0.3], steps: 1}
  - name: along
    samples: 1
    file: along.yaml
splits: {val: 0.1, test_objects: [star]}
outputs: {pack: none}
stop_after_failures: 3
END
echo 'motion: [{kind: press, depth_mm: 0.2, steps: 1}, {kind: path, file: away.csv}]' > mine/along.yaml
printf '0,0,0,0,0,0,0,1\n0.01,0.0001,0,0,0,0,0,1\n' > mine/away.csv
goal() { # goal OUT GOAL [VARIABLE=value …]
  local out=$1 goal=$2
  shift 2
  make -s -f Makefile.data "$goal" CONFIG=mine/set.yaml OUT="$out" BUILD="$build_dir" PACKAGES=no REBUILD=no "$@"
}
table() { "$build_dir/bin/tacipc" table "$1/datasets/set/plan/samples.csv" "${@:2}"; } # table OUT [FLAG …]
stamp() { find "$1/datasets/set/samples" -name '*.yaml' -not -name '*.timings.yaml' -printf '%p %T@\n' | sort; }
samples() { (cd "$1/datasets/set" && find gels objects samples -type f -not -name '*.log' -not -name '*.timings.yaml' -not -path '*/.*' -print0 | sort -z | xargs -0 md5sum); }

grep -q '^set: 9 samples: 9 made, 0 failed, 0 running, 0 left$' <<< "$(goal whole dataset JOBS=2 2> messages)" || { cat messages; fail "not all samples are made"; }
[ "$(table whole --columns id | sort -u | wc -l)" = 9 ] || fail "ids are not unique"
[ "$(table whole --columns split --where object=star | sort -u)" = test ] || fail "star is not in test"
[ "$(md5sum whole/datasets/set/samples/000/*/render/frame_0000/tactile.png | cut -d' ' -f1 | sort -u | wc -l)" = 9 ] || fail "samples have the same noise"
before=$(stamp whole)
goal whole dataset > /dev/null
[ "$before" = "$(stamp whole)" ] || fail "a second run did something"

# Of runs that miss the plan together one makes it.
mkdir -p race/datasets
touch race_{0,1,2}.txt
for task in 0 1 2; do goal race plan > race_$task.txt 2>&1 & done
wait
[ "$(cat race_?.txt | grep -c 'samples; look at')" = 3 ] || fail "a plan is not made: $(cat race_?.txt)"
[ "$(cat race_?.txt | grep -c 'new or changed')" = 1 ] || fail "a plan is made more than once: $(cat race_?.txt)"

# Two parts at once, one of them given twice. A new file in a folder of meshes does not take the plan from under them.
goal parts dataset-shared > /dev/null 2>&1
touch .
for task in 0 1 2; do goal parts dataset-part PART=$((task % 2)) PARTS=2 JOBS=1 > part_$task.txt 2>&1 & done
wait
[ "$(cat part_?.txt | grep -c ' 0 left$')" = 3 ] || fail "a part is not made: $(cat part_?.txt)"
grep -q 'new or changed' part_?.txt && fail "a part made the plan anew: $(cat part_?.txt)"
[ "$(samples whole)" = "$(samples parts)" ] || fail "the parts are not the whole"

# Only what a change concerns.
sleep 1.1
printf '0,0,0,0,0,0,0,1\n0.01,0.0002,0,0,0,0,0,1\n' > mine/away.csv
goal whole dataset > /dev/null
comm -13 <(echo "$before") <(stamp whole) | grep -v '__along__' && fail "another path redid other samples"
comm -13 <(echo "$before") <(stamp whole) | grep -c press.yaml | grep -qx 3 || fail "another path did not redo its samples"
before=$(stamp whole)
sleep 1.1
sed -i 's/samples: 2/samples: 3/' mine/set.yaml
goal whole dataset > /dev/null
[ "$before" = "$(comm -12 <(echo "$before") <(stamp whole))" ] || fail "more samples redid those there were"

# Failures: noted, not tried again unless asked, and a run of them ends the run.
cat configs/press/default.yaml > mine/hopeless.yaml
printf '  max_iterations: 1\n  max_halvings: 0\n' >> mine/hopeless.yaml
sed -i 's/^  - name: along/&\n    press: hopeless.yaml/' mine/set.yaml
goal failing dataset JOBS=1 > failing.txt 2>&1 && fail "a failed sample went unseen"
ledger=failing/datasets/set/failures.csv
grep -q '^set: 12 samples: 9 made, 3 failed, 0 running, 0 left$' failing.txt || fail "the failures are not counted: $(cat failing.txt)"
[ "$(head -n 1 $ledger)" = id,stage,reason,log,time,host ] || fail "the ledger has no heading"
[ "$(grep -c '^mctac__[a-z]*__along__[0-9]*,press,".*Newton.*",samples/000/mctac__[a-z]*__along__[0-9]*/press/press.log,' $ledger)" = 3 ] || fail "the ledger does not tell: $(cat $ledger)"
goal failing dataset > /dev/null 2>&1 && fail "old failures went unseen"
[ "$(wc -l < $ledger)" = 4 ] || fail "failed samples were tried again"
pages=$build_dir/tests/pipeline/dataset_pages  # for dataset_page_test.sh, which opens them in a browser
rm -rf "$pages" && mkdir -p "$pages"
goal failing dataset-report > /dev/null 2>&1 || fail "no pages of a dataset with failures"
grep -q '9 of 12 samples are made' failing/datasets/set/report/index.html || fail "the first page does not say how far it is"
[ "$(find failing/datasets/set/report/samples -name '*.html' | wc -l)" = 12 ] || fail "not every finished sample has a page"
cp -r failing/datasets/set "$pages/failing"
goal failing retry STOP_AFTER=2 JOBS=1 > failing.txt 2>&1 && fail "a retry that fails went unseen"
grep -q '^2 failures in a row' failing.txt || fail "failures in a row did not end the run"
[ "$(wc -l < $ledger)" = 6 ] || fail "a retry did not stop after two failures"
sed -i 's/max_iterations: 1/max_iterations: 200/' mine/hopeless.yaml
goal failing retry > failing.txt || fail "a retry did not complete the dataset"

# A wrong configuration of a stage is not a failed sample.
sed -i 's/^  max_iter/  max_itre/' mine/hopeless.yaml
goal failing dataset > failing.txt 2>&1 && fail "a wrong key was taken"
grep -q 'unknown key (did you mean max_iterations?)' failing.txt || fail "a wrong key was not told"
[ "$(wc -l < $ledger)" = 6 ] || fail "a wrong key counts as a failed sample"
sed -i 's/^  max_itre/  max_iter/' mine/hopeless.yaml

# Killed in the middle, at any moment, then run again.
goal again dataset > /dev/null 2>&1
for moment in 1:0.1 3:0.2 6:0.3; do # presses begun, and seconds after that
  rm -rf killed
  setsid make -s -f Makefile.data dataset CONFIG=mine/set.yaml OUT=killed BUILD="$build_dir" PACKAGES=no REBUILD=no JOBS=2 > /dev/null 2>&1 &
  leader=$!
  for _ in $(seq 2000); do [ "$(find killed -path '*/samples/*' -name press.log 2> /dev/null | wc -l)" -lt "${moment%:*}" ] || break; sleep 0.01; done
  sleep "${moment#*:}"
  kill -KILL -- "-$leader" || fail "the dataset was made before it could be killed"
  wait "$leader" 2> /dev/null || :
  goal killed dataset > /dev/null 2>&1 || fail "what was killed cannot be completed"
  diff <(samples again) <(samples killed) || fail "what was killed ends in other bytes"
done

# A stage that dies by itself, a disk that is full, and a wrong plan.
grep -q '12 made' <<< "$(goal again status)" || fail "status does not count"
goal again clean-render
mkdir broken_bin
for stage in "$build_dir"/bin/*; do ln -s "$stage" "broken_bin/"; done
printf '#!/bin/sh\nkill -SEGV $$\n' > broken
chmod +x broken
mkdir -p broken_build/bin && cp -d broken_bin/* broken_build/bin/ && rm broken_build/bin/render && cp broken broken_build/bin/render
make -s -f Makefile.data dataset CONFIG=mine/set.yaml OUT=again BUILD="$PWD/broken_build" REBUILD=no PACKAGES=no STOP_AFTER=2 JOBS=1 > failing.txt 2>&1 && fail "a crash went unseen"
grep -q 'render failed: killed by signal 11' failing.txt || fail "a crash was not told: $(cat failing.txt)"
goal again retry > /dev/null || fail "crashed samples cannot be made again"
[ "$(samples again)" = "$(samples killed)" ] || fail "crashed samples end in other bytes"

# What it costs, made again, one sample elsewhere (a failed one too), and what is left after packing.
grep -Eq '^set: 12 samples: [0-9.e-]+ core-hours .* GB on disk$' <<< "$(goal again estimate PILOT=4)" || fail "no estimate"
goal again reproduce K=2 | grep -c ': equal bytes$' | grep -qx 2 || fail "samples cannot be reproduced"
replayed() { # replayed OUT ID EXPECTED
  goal "$1" bundle SAMPLE="$2" > /dev/null || fail "no bundle of $2"
  mkdir -p elsewhere
  tar -C elsewhere -xzf "$1/datasets/set/bundles/$2.tar.gz"
  BIN=$build_dir/bin bash "elsewhere/$2/replay.sh" > replayed.txt 2>&1 || true
  grep -qx "$3" replayed.txt || fail "$2 cannot be replayed: $(cat replayed.txt)"
}
id() { table again --columns id --where "object=${1%__*}" --where "motion=${1#*__}" | sed -n 1p; }
replayed again "$(id star__down)" 'render.yaml is as it was'
replayed again "$(id pyramid__along)" 'press.yaml is as it was'
sed -i 's/max_iterations: 200/max_iterations: 1/' mine/hopeless.yaml
goal again dataset > /dev/null 2>&1 && fail "failures went unseen"
replayed again "$(id gear__along)" 'press.failed.yaml is as it was'
sed -i 's/max_iterations: 1$/max_iterations: 200/' mine/hopeless.yaml
goal again dataset > /dev/null || fail "an input that changed did not let failed samples be tried again"
sed -i 's/pack: none/pack: none, keep: [render]/' mine/set.yaml
goal again drop 2> /dev/null && fail "what is not packed was dropped"
mkdir again/datasets/set/pack
sha() { sha256sum < "$1" | cut -c1-64; }
{
  echo id,status,press_sha256,render_sha256
  table again --columns id,object,folder | while IFS=$'\t' read -r id object folder; do
    [ "$object" = gear ] || echo "$id,made,$(sha "again/datasets/set/$folder/press/press.yaml"),$(sha "again/datasets/set/$folder/render/render.yaml")"
  done
} > again/datasets/set/pack/manifest.csv
# One that is not as it was packed, one that another run is at work at.
cp again/datasets/set/pack/manifest.csv manifest.csv
sed -i "/^$(id star__along),/s/,[0-9a-f]*$/,0/" again/datasets/set/pack/manifest.csv
{ flock 9; goal again drop > /dev/null 2> said.txt; } 9> "again/datasets/set/samples/000/$(id pyramid__along)/render/.making"
[ "$(find again/datasets/set/samples -name positions.npy | wc -l)" = 6 ] || fail "what is not as it was packed was dropped, or is being made"
grep -q '^set: 2 samples are not as they were packed, or are being made, and keep their files$' said.txt || fail "it is not told: $(cat said.txt)"
cp manifest.csv again/datasets/set/pack/manifest.csv
goal again drop > /dev/null
[ "$(find again/datasets/set/samples -name positions.npy | grep -vc __gear__)" = 0 ] || fail "files of press are still there"
[ "$(find again/datasets/set/samples -name positions.npy | wc -l)" = 4 ] || fail "what is not packed was dropped"
[ "$(find again/datasets/set/samples -name tactile.png | wc -l)" = 24 ] || fail "files to keep were dropped"
before=$(stamp again)
grep -q '12 made' <<< "$(goal again dataset)" || fail "dropped samples do not count"
[ "$before" = "$(stamp again)" ] || fail "dropped samples were made again"
goal again dataset-report > /dev/null 2>&1 || fail "no pages of a dataset of which files were dropped"
grep -q 'Of 8 samples files were removed after packing' again/datasets/set/report/index.html || fail "the first page does not say what is dropped"
cp -r again/datasets/set "$pages/dropped"
touch configs/render/default.yaml
goal again dataset > failing.txt 2>&1 && fail "images of presses that are gone"
grep -q 'clean-press, then it is made again' failing.txt || fail "it is not told that presses are gone"

# An installed copy runs where it is moved to, and makes the same.
cmake --install "$build_dir" --prefix "$PWD/installed" > /dev/null
mkdir prefixes
mv installed prefixes/moved
cp -r configs/sensors prefixes/moved/share/tacipc/configs/
mv configs configs_here
ln -s prefixes/moved/share/tacipc/configs configs
cp -r configs_here/objects/patterns configs/objects/
make -s -C prefixes/moved/share/tacipc -f Makefile.data dataset-some SAMPLES="000/$(id star__down)" CONFIG="$PWD/mine/set.yaml" OUT="$PWD/moved" > /dev/null 2>&1 || fail "an installed copy does not work"
cmp {killed,moved}/datasets/set/samples/000/"$(id star__down)"/press/positions.npy || fail "an installed copy makes other bytes"

sed -i 's/depth_mm: \[0.2, 0.3\]/depth_mm: [0.2, 2.3]/' mine/set.yaml
goal wrong dataset > failing.txt 2>&1 && fail "a press through the gel was planned"
grep -q 'motion down: a press to 2.3 mm is not possible in the gel of mctac, 2 mm thick' failing.txt || fail "the fault is not told: $(cat failing.txt)"
[ ! -d wrong/datasets/set/samples ] || fail "a wrong plan made samples"
echo "1 passed, 0 failed"
