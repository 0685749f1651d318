#!/usr/bin/env bash
# Clocks that jump: files of a finished sample and a finished dataset get times far back or still to come, one after the other (SEED=1 draws which).
# The same line then ends in the same bytes and finds nothing more to do, or says what is wrong with which file.
. "$(dirname "$0")/common.sh"
mkdir mine
cat > mine/set.yaml <<'END_OF_SET'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects: {meshes: .., only: [pyramid], unit: mm}
motions:
  - {name: down, samples: 2, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: [0.2, 0.3], steps: 1}}
outputs: {pack: slim}
END_OF_SET
dataset() { make -s -f Makefile.data dataset CONFIG=mine/set.yaml OUT="$1" BUILD="$build_dir" PACKAGES=no REBUILD=no; }
sample() { tiny_sample "$1" REBUILD=no; }
draw() { # draw N: a number below N in $drawn
  drawing=$((${drawing:-0} + 1))
  local hash
  hash=$(sha256sum <<< "${SEED:-1} $drawing")
  drawn=$((16#${hash:0:12} % $1))
}
# What lies there but for times: contents of a folder.
contents() { (cd "$1" && find . -type f -not -name '.*' -not -path '*/.*/*' -not -name '*.log' -not -name '*timings*' -not -name '*.mk' -not -name '*.inputs' -print0 | LC_ALL=C sort -z | xargs -0 md5sum); }
times() { (cd "$1" && find . -name '*.yaml' -not -name '*.timings.yaml' -not -path '*/.*' -printf '%p %T@\n' | LC_ALL=C sort); }

for goal in sample dataset; do
  "$goal" "$goal" > said.txt 2>&1 || fail "$goal is not made: $(cat said.txt)"
  whole=$(contents "$goal")
  for offset in '-10 years' '-1 day' '-1 hour' '-1 second' '+2 seconds' '+1 hour' '+1 day' '+1 year'; do
    mapfile -t files < <(find "$goal" -type f -not -name '.*' -not -path '*/.*/*' -not -name '*.log' | LC_ALL=C sort)
    draw "${#files[@]}"
    file=${files[drawn]}
    touch -d "$offset" "$file"
    if "$goal" "$goal" > said.txt 2>&1; then
      [ "$whole" = "$(contents "$goal")" ] || fail "$file of $offset: other bytes: $(diff <(echo "$whole") <(contents "$goal"))"
      before=$(times "$goal")
      "$goal" "$goal" > said.txt 2>&1 || fail "$file of $offset: the second run fails: $(cat said.txt)"
      # make itself warns of what is to come.
      [ "$before" = "$(times "$goal")" ] || grep -q 'in the future' said.txt || fail "$file of $offset: made again in every run"
    else
      grep -qF "$file, of " said.txt || fail "$file of $offset: refused without its name: $(cat said.txt)"
    fi
    touch "$file"
    "$goal" "$goal" > said.txt 2>&1 || fail "$file touched: $(cat said.txt)"
    [ "$whole" = "$(contents "$goal")" ] || fail "$file touched: other bytes: $(diff <(echo "$whole") <(contents "$goal"))"
  done
done
echo "1 passed, 0 failed"
