#!/usr/bin/env bash
# Bundles all inputs of one sample and a script that makes it again: dataset_bundle.sh DATASET SAMPLE ARCHIVE PROGRAMS
# It also works for failed samples: dataset_stage.sh keeps the command of each stage that it starts, and its make
# prerequisites.
# shellcheck disable=SC2016  # what replay.sh expands, not this
set -euo pipefail
export LC_ALL=C
dataset=$1 sample=$2 archive=$3 programs=$4
tacipc=$programs/tacipc
folder=$("$tacipc" table "$dataset/plan/samples.csv" --columns folder --where id="$(basename "$sample")")
[ -n "$folder" ] || { echo "bundle: $(basename "$sample") is no sample of $dataset" >&2; exit 1; }
folder=$(realpath "$dataset/$folder")
# A finger of a grasp was pressed together with the other one, in the folder above its own.
declare -A ran=([press]=$folder/press [render]=$folder/render)
grasp=$folder
case $folder in */left | */right) grasp=$(dirname "$folder") ran[press]=$grasp ;; esac
if [ ! -e "${ran[press]}/.command" ]; then
  why=$("$tacipc" get "${ran[press]}/press.failed.yaml" message --default '' 2> /dev/null || true)
  echo "bundle: $(basename "$sample") has not been tried${why:+: $why}" >&2
  exit 1
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/expected"

# Files that the commands name, their make prerequisites, and the plan's copies of paths that a motion follows.
: > "$work/named"
for stage in press render; do
  [ -e "${ran[$stage]}/.command" ] || continue
  while read -r word; do
    if [ -f "$word" ]; then realpath "$word"; fi
  done < <(tr ' ' '\n' < "${ran[$stage]}/.command") | { grep -v -e '/bin/[a-z]*$' -e "/$stage.yaml$" || true; } >> "$work/named"
  for found in "${ran[$stage]}/$stage"{,.failed}.yaml; do
    if [ -e "$found" ]; then cp "$found" "$work/expected/"; fi
  done
done
"$tacipc" paths "$grasp/sample.yaml" | while read -r path; do realpath "$path"; done >> "$work/named"
sort -u "$work/named" | grep -v -e '/decimate.yaml$' -e '/tetmesh.yaml$' -e '/press/press.yaml$' -e "^$grasp/press.yaml\$" -e '/choices/' > "$work/all"

# The folders keep their relative positions, so that records are equal byte for byte.
root=$(dirname "$grasp")
while read -r file; do
  while [[ "$file" != "$root"/* ]]; do root=$(dirname "$root"); done
done < "$work/all"
{
  echo '#!/usr/bin/env bash'
  echo "# Makes $(basename "$sample") again: BIN=folder of the programs bash replay.sh. Equal bytes need the same version and kind of processor."
  echo 'set -uo pipefail'
  echo 'cd "$(dirname "$0")/files"'
  for stage in press render; do
    [ -e "${ran[$stage]}/.command" ] || continue
    echo "echo '$stage:'"
    printf 'OPENBLAS_NUM_THREADS=1 "${BIN:-bin}/%s"' "$stage"
    read -r command < "${ran[$stage]}/.command"
    tr ' ' '\n' <<< "${command#*"/bin/$stage "}" | while read -r word; do
      if [[ "$word" == */* ]] && [ -e "$word" ]; then word=$(realpath --relative-to="$root" "$word"); fi
      printf ' %q' "$word"
    done
    echo
    out=$(realpath --relative-to="$root" "${ran[$stage]}")
    echo "for record in $stage.yaml $stage.failed.yaml; do"
    echo "  [ ! -e ../expected/\$record ] || if cmp -s ../expected/\$record $out/\$record; then echo \"\$record is as it was\";" \
      "else echo \"\$record differs: diff expected/\$record files/$out/\$record\"; fi"
    echo 'done'
  done
} > "$work/replay.sh"
mkdir "$work/files"
while read -r file; do
  mkdir -p "$work/files/$(dirname "${file#"$root"/}")"
  cp "$file" "$work/files/${file#"$root"/}"
done < "$work/all"
mkdir -p "$(dirname "$archive")"
tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime=@0 -cz --transform "s|^|$(basename "$sample")/|" -f "$archive" replay.sh expected files
echo "$archive: $(du -k "$archive" | cut -f1) kB; unpack, then BIN=$programs bash $(basename "$sample")/replay.sh"
