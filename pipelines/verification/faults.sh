#!/usr/bin/env bash
# faults.sh TEST BIN SEED FOLDER: runs a pipeline test (tests/pipeline/TEST.sh) in which faulty_stage.sh replaces the
# stages and injects faults. FOLDER/injected.csv has a line per fault, FOLDER/finds/ the faults that were not handled,
# with their command; FOLDER/faults.yaml is written last.
set -euo pipefail
test=$1 bin=$(realpath "$2") seed=$3 folder=$4
rm -rf "$folder"
mkdir -p "$folder/build/bin" "$folder/finds"
folder=$(realpath "$folder")
# Programs of a build: faulty_stage.sh in place of each stage, all others unchanged.
for program in "$bin"/*; do
  name=$(basename "$program")
  if compgen -G "stages/*/$name/main.cpp" > /dev/null; then program=$PWD/pipelines/verification/faulty_stage.sh; fi
  ln -s "$program" "$folder/build/bin/$name"
done
echo test,stage,fault,outcome > "$folder/injected.csv"

# A full disk is simulated by a small file system, which may be mounted in a separate name space.
private=()
for try in -m -rm; do
  if unshare $try mount -t tmpfs none "$folder/finds" 2> /dev/null; then private=(unshare "$try") && break; fi
done
[ "${#private[@]}" != 0 ] || echo "faults: $test: no file system may be mounted here: no full disk" >&2

begin=$SECONDS
REBUILD=no FAULTS_PROGRAMS=$bin FAULTS_FOLDER=$folder FAULTS_TEST=$test FAULTS_SEED=$seed FAULTS_MOUNT=${private[*]:+yes} \
  "${private[@]}" bash "$PWD/tests/pipeline/$test.sh" "$PWD" "$folder/build" > "$folder/log.txt" 2>&1 || [ $? = 77 ] ||
  { echo "faults: $test itself fails, see $folder/log.txt" >&2; exit 1; }
finds=$(find "$folder/finds" -name command.txt | wc -l)
printf 'stage: faults\nsummary:\n  test: %s\n  seed: %s\n  injected: %d\n  finds: %d\n  seconds: %d\n' "$test" "$seed" \
  $(($(wc -l < "$folder/injected.csv") - 1)) "$finds" $((SECONDS - begin)) > "$folder/faults.yaml.new"
mv "$folder/faults.yaml.new" "$folder/faults.yaml"
