#!/usr/bin/env bash
# What changes beside or under a run of a dataset: other and older files are chosen, runs meet each other, inputs change in mid-run, a press is
# made anew and interrupted, leftovers of earlier runs, a damaged table, times still to come. What submit hands on.
. "$(dirname "$0")/common.sh"
mkdir mine
mkdir mine/meshes mine/older
cp pyramid.stl mine/meshes
sed 's/vertex \(.*\) 2$/vertex \1 3/' pyramid.stl > mine/older/pyramid.stl
sed 's/coefficient: .*/coefficient: 0.1/' configs/press/default.yaml > mine/slippery.yaml
cp configs/press/default.yaml mine/friction.yaml
cp configs/press/default.yaml mine/twin.yaml
cp configs/gels/tiny.yaml mine/coarse.yaml
sed 's/^frames: .*/frames: all/' configs/render/default.yaml > mine/quick.yaml
touch -d '2020-01-01' mine/*.yaml mine/*/pyramid.stl configs/gels/tiny.yaml
cat > mine/small.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects: {meshes: meshes, unit: mm}
press: friction.yaml
motions:
  - {name: down, samples: 2, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: [0.2, 0.3], steps: 1}}
outputs: {pack: none}
END
small() { # small GOAL [VARIABLE=value …]
  local goal=$1
  shift
  make -s -f Makefile.data "$goal" CONFIG=mine/small.yaml OUT=small BUILD="$build_dir" PACKAGES=no REBUILD=no "$@"
}
set=small/datasets/small
times() { find $set/gels $set/objects $set/samples -name '*.yaml' -not -name '*.timings.yaml' -printf '%p %T@\n' | sort; }

# Two runs from nothing: one makes gel and object, the other waits and takes them.
for task in 0 1; do small dataset JOBS=2 > two_$task.txt 2>&1 & done
wait
[ "$(cat two_?.txt | grep -c '^small: 2 samples: 2 made, 0 failed, 0 running, 0 left$')" = 2 ] || fail "two runs at once do not both complete: $(cat two_?.txt)"
[ "$(cat two_?.txt | grep -c 'the sizing asks for')" = 1 ] || fail "a gel is made more than once: $(cat two_?.txt)"
before=$(times)
small dataset > /dev/null
[ "$before" = "$(times)" ] || fail "two runs at once leave something to do"

# Another file redoes what is made of it however old it is; the same bytes in another place redo nothing.
made_anew() { # made_anew SED-EXPRESSION: names of records, after this was changed in the file
  local before
  before=$(times)
  sed -i "$1" mine/small.yaml
  small dataset > said.txt 2>&1 || fail "$1: $(cat said.txt)"
  comm -13 <(echo "$before") <(times) | sed 's|.*/\([^ ]*\) .*|\1|' | sort -u | tr '\n' ' '
}
says() { grep -q "$1" $set/samples/000/*000000/press/press.yaml || fail "$2 is not used"; }
cp -rp mine/meshes mine/moved
[ "$(made_anew 's|friction.yaml|twin.yaml|; s|meshes: meshes|meshes: moved|')" = '' ] || fail "the same bytes in another place redo something"
[ "$(made_anew 's|twin.yaml|slippery.yaml|')" = 'press.yaml render.yaml ' ] || fail "an older press file redoes something else"
says 'coefficient: 0.1' "an older press file"
cp -p mine/friction.yaml mine/slippery.yaml
[ "$(made_anew '')" = 'press.yaml render.yaml ' ] || fail "a press file that an older one replaced redoes something else"
says 'coefficient: 0.7' "a press file that an older one replaced"
[ "$(made_anew 's|meshes: moved|meshes: older|')" = 'decimate.yaml press.yaml render.yaml ' ] || fail "an older mesh redoes something else"
[ "$(made_anew 's|../configs/gels/tiny.yaml|coarse.yaml|')" = 'press.yaml render.yaml sample.yaml tetmesh.yaml ' ] || fail "another gel redoes something else"
[ "$(made_anew 's|coarse.yaml|../configs/gels/tiny.yaml|')" = 'press.yaml render.yaml sample.yaml ' ] || fail "a gel that was there before redoes something else"
says 'gels/mctac-tiny/gel.msh' "a gel that was there before"
[ "$(made_anew '$s|$|\nrender: quick.yaml|')" = 'render.yaml ' ] || fail "another older render file redoes something else"

# A press that is made anew and interrupted before render: the images of the one before do not count.
stubs() { # stubs STAGE SCRIPT: small_with uses the script for this stage
  mkdir -p stub_build/bin
  rm -f stub_build/bin/*
  ln -s "$build_dir"/bin/* stub_build/bin/
  rm stub_build/bin/"$1"
  printf '#!/bin/bash\n%s\n' "$2" > stub_build/bin/"$1"
  chmod +x stub_build/bin/"$1"
}
small_with() { small "$@" BUILD="$PWD/stub_build" JOBS=1; }
stubs render 'exit 143'
touch mine/slippery.yaml
small_with dataset > said.txt 2>&1 && fail "an interrupted run ends well"
grep -q '^small: 2 samples: 1 made, 0 failed, 0 running, 1 left$' <<< "$(small status)" || fail "new press and old images count as made: $(small status)"

# Inputs that change in mid-run, or are gone for a moment, are no failure and no wrong configuration: the stage runs once more.
stubs press 'echo >> tries
case $(wc -l < tries) in
  1) echo "# a comment" >> mine/slippery.yaml; echo "message: of the old file" > '"$set"'/samples/000/*000000/press/press.failed.yaml; exit 1 ;;
  2) touch '"$set"'/gels/mctac-tiny/tetmesh.yaml; exit 2 ;;
  *) exec '"$build_dir"'/bin/press "$@" ;;
esac'
touch mine/slippery.yaml
small_with dataset > said.txt 2>&1 || fail "an input that changes in mid-run ends it: $(cat said.txt)"
[ "$(wc -l < tries)" = 4 ] || fail "a stage of which an input changed does not run once more"
[ ! -e $set/failures.csv ] || fail "an input that changed is a failure: $(cat $set/failures.csv)"

# What another run of the same process number left does not stop this one.
touch mine/slippery.yaml
bash -c 'mkdir -p "$0/.runs"; echo "nothing more can be written" > "$0/.runs/$(hostname)-$$"; exec make -s -f Makefile.data dataset "$@"' $set \
  CONFIG=mine/small.yaml OUT=small BUILD="$build_dir" PACKAGES=no REBUILD=no > said.txt 2>&1 || fail "what an earlier run left stops this one: $(cat said.txt)"
grep -q '2 made' said.txt || fail "what an earlier run left stops this one: $(cat said.txt)"

# Without a whole table nothing counts as complete, and no failure makes one.
mv $set/plan/samples.csv table.csv
TACIPC=$build_dir/bin/tacipc STOP_AFTER=9 bash pipelines/dataset/dataset_stage.sh $set $set/.runs/test press $set/samples/000/none/press/press.yaml mine/slippery.yaml false 2> said.txt
grep -q ',press,"no reason given",' <<< "$(tail -n 1 $set/failures.csv)" || fail "a failure without a table is not noted: $(cat said.txt)"
[ ! -e $set/plan/samples.csv ] || fail "a failure makes an empty table"
head -n 1 table.csv > $set/plan/samples.csv
"$build_dir/bin/survey" status --all-made $set > said.txt 2>&1 && fail "an empty table is complete: $(cat said.txt)"
grep -q 'has 0 rows where there should be 1' said.txt || fail "it is not told that the table is empty: $(cat said.txt)"
head -n 2 table.csv > $set/plan/samples.csv
"$build_dir/bin/survey" status --all-made $set --first 0 --end 2 > said.txt 2>&1 && fail "half a table is complete: $(cat said.txt)"
mv table.csv $set/plan/samples.csv

# A file of the future.
touch -d '+1 hour' mine/slippery.yaml
timeout 60 make -s -f Makefile.data plan CONFIG=mine/small.yaml OUT=small BUILD="$build_dir" PACKAGES=no REBUILD=no > said.txt 2>&1 && fail "a plan of a file of the future"
grep -q '^plan: mine/slippery.yaml, of .* plan: is newer than anything made now, at ' <(tr '\n' ' ' < said.txt) || fail "a file of the future is not told: $(cat said.txt)"
grep -q 'new or changed' said.txt && fail "a plan is made over and over"
touch mine/slippery.yaml
small dataset > /dev/null 2>&1 || fail "a file of now is refused"
# A record of the future would let every run make again what is made of it.
sample=$(cd $set && ls -d samples/000/*000000)
for record in plan/plan.yaml gels/mctac-tiny/tetmesh.yaml objects/pyramid/decimate.yaml choices/object-pyramid "$sample/sample.yaml" "$sample/press/press.yaml"; do
  [ -e "$set/$record" ] || fail "there is no $record"
  touch -d '+1 hour' "$set/$record"
  before=$(times)
  timeout 60 make -s -f Makefile.data dataset CONFIG=mine/small.yaml OUT=small BUILD="$build_dir" PACKAGES=no REBUILD=no > said.txt 2>&1 && fail "$record of the future is not refused"
  grep -q "^plan: $set/$record, of .* plan: is newer than anything made now, at " <(tr '\n' ' ' < said.txt) || fail "$record of the future is not told: $(cat said.txt)"
  [ "$before" = "$(times)" ] || fail "$record of the future redoes something"
  touch "$set/$record"
  small dataset > said.txt 2>&1 || fail "$record of now is refused: $(cat said.txt)"
done
before=$(times)
small dataset > /dev/null
[ "$before" = "$(times)" ] || fail "records that were touched redo something twice"

# What submit hands on: what is packed and how, and threads; where locks stay on a node it says so.
mkdir commands
printf '#!/bin/sh\necho 7\n' > commands/sbatch
printf '#!/bin/sh\necho /dev/x lustre rw,localflock\n' > commands/findmnt
chmod +x commands/*
PATH=$PWD/commands:$PATH small submit THREADS=3 PACK=slim CARD=mine > said.txt 2>&1 || fail "nothing is submitted: $(cat said.txt)"
for job in shared parts last; do
  grep -q '^exec .* THREADS=3 PACK=slim CARD=mine ' $set/slurm/$job.sh && grep -qx '#SBATCH --cpus-per-task=3' $set/slurm/$job.sh && grep -qx '#SBATCH --mem-per-cpu=667' $set/slurm/$job.sh ||
    fail "$job is not submitted with what was given: $(cat $set/slurm/$job.sh)"
done
grep -q '^submit: locks on this file system stay on one node' said.txt || fail "locks of a node are not told"
echo "1 passed, 0 failed"
