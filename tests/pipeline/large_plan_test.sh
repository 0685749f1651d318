#!/usr/bin/env bash
# A dataset of many samples of which one was made and the others are links to it: what planning, looking and packing cost when nothing is
# computed. SAMPLES=2000 unless given; SAMPLES=100000 gives the figures of docs/datasets.md (some 3 GB in TMPDIR).
. "$(dirname "$0")/common.sh"
samples=${SAMPLES:-2000}
mkdir mine meshes
mv pyramid.stl meshes
sed -i 's/width_px: 64/width_px: 16/; s/height_px: 48/height_px: 12/' configs/sensors/mctac.yaml
cat > mine/set.yaml <<END
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects: {meshes: ../meshes, unit: mm}
motions:
  - {name: down, samples: $samples, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: [0.2, 0.3], steps: 1}}
outputs: {pack: none, shard_mb: 0.9}
END
goal() { # goal GOAL [VARIABLE=value …]
  make -s -f Makefile.data "$1" CONFIG=mine/set.yaml OUT=out BUILD="$build_dir" PACKAGES=no REBUILD=no "${@:2}"
}
export -f goal
export build_dir
# measured NAME COMMAND...: wall and processor seconds, and the most memory that one of its processes had; fails as the command does.
measured() {
  /usr/bin/python3 - "$@" <<'END'
import os, resource, subprocess, sys, time
name, start = sys.argv[1], time.monotonic()
with open("said.txt", "w") as said:
    code = subprocess.call(sys.argv[2:], stdout=said, stderr=said)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
line = f"{name}: {time.monotonic() - start:.1f} s, {used.ru_utime + used.ru_stime:.1f} s of processor, {used.ru_maxrss / 1024:.0f} MB"
print(line)
open("measured.txt", "a").write(line + "\n")
if code: print(open("said.txt").read())
sys.exit(code)
END
}
below() { # below MB NAME: memory of what was measured last by this name
  awk -F, -v name="$2:" -v most="$1" 'index($0, name) == 1 { mb = $3 + 0 } END { exit !(mb && mb < most) }' measured.txt || fail "$2 takes more than $1 MB"
}
set=out/datasets/set

measured plan bash -c 'goal plan' || fail "no plan"
goal dataset-shared > said.txt 2>&1
first=$("$build_dir/bin/tacipc" table $set/plan/samples.csv --columns folder --where index=0)
first=${first#samples/}
goal dataset-some SAMPLES="$first" > said.txt 2>&1 || fail "the first sample is not made: $(cat said.txt)"
# Each folder of a thousand has a copy, as a file has no more than 65,000 names; the others of the folder are links to it.
/usr/bin/python3 - $set "$first" <<'END'
import csv, os, shutil, sys
dataset, first = sys.argv[1:]
made = os.path.join(dataset, "samples", first)
folders, files = [], []
for at, below, names in os.walk(made):
    at = os.path.relpath(at, made)
    folders.append(at)
    files += [os.path.join(at, name) for name in names if not name.startswith((".lock", ".making"))]
copies = {}
with open(os.path.join(dataset, "plan/samples.csv")) as plan:
    for row in csv.DictReader(plan):
        sample = os.path.join(dataset, row["folder"])
        if sample == made: continue
        block = os.path.dirname(sample)
        shutil.rmtree(sample)
        if block not in copies:
            copies[block] = sample
            shutil.copytree(made, sample, ignore=shutil.ignore_patterns(".lock*", ".making"))
            continue
        for folder in folders: os.mkdir(os.path.normpath(os.path.join(sample, folder)))
        for file in files: os.link(os.path.join(copies[block], file), os.path.join(sample, file))
END

measured "dataset, nothing to do" bash -c 'goal dataset' || fail "there is something to do"
grep -q "$samples made, 0 failed" said.txt || fail "not all counts: $(cat said.txt)"
measured status bash -c 'goal status' || fail "no status"
measured "pack" bash -c 'goal pack PACK=slim' || fail "it is not packed"
[ "$(tail -n +2 $set/pack/manifest.csv | grep -c ',made,')" = "$samples" ] || fail "not all is packed"
(cd $set/pack && sha256sum --quiet -c checksums.sha256) || fail "the checksums do not hold"
echo "$(find $set/pack/shards -name '*.h5' | wc -l) shards of at most $(find $set/pack/shards -name '*.h5' -printf '%s\n' | sort -n | tail -n 1) bytes"
awk '/^peak_memory_mb:/ && $2 > most { most = $2 } END { printf "the largest pack: %.0f MB\n", most }' $set/shards/*/pack.timings.yaml
awk '/^peak_memory_mb:/ { printf "card: %.0f MB\n", $2 }' $set/pack/card.timings.yaml
measured "pack, nothing to do" bash -c 'goal pack PACK=slim' || fail "a second packing fails"
for what in plan "dataset, nothing to do" status "pack" "pack, nothing to do"; do below "${MOST_MB:-150}" "$what"; done
echo "1 passed, 0 failed"
