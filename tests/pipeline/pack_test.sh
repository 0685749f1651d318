#!/usr/bin/env bash
# A small dataset from plan's table to what a user downloads: shards, tables, card and checksums, loaded back in Python;
# equal bytes with one and two threads; nothing to do a second time, and a sample made anew packs its shard alone.
. "$(dirname "$0")/common.sh"
cp "$source_dir/CITATION.cff" .
bin=$build_dir/bin
python=/usr/bin/python3 # Debian's, which has the packages

sed -i 's/^frames: last/frames: all/' configs/render/default.yaml
echo 'variants: [{name: white, lights: [{group: red, cct_k: 6500}, {group: green, cct_k: 6500}, {group: blue, cct_k: 6500}]}]' >> configs/render/default.yaml
echo 'unit: mm' > object.yaml
quiet=(--log-level warning)
"$bin"/tetmesh --sensor configs/sensors/mctac.yaml --config configs/gels/tiny.yaml --out gel "${quiet[@]}"
"$bin"/decimate --mesh pyramid.stl --object object.yaml --config configs/objects/decimate/default.yaml --out object "${quiet[@]}"
make_sample() { # make_sample FOLDER DEPTH
  mkdir -p "$1"
  cat > "$1/sample.yaml" <<END
placement: {rotate_deg: 10, center_mm: [0.2, 0.1]}
motion:
  - {kind: press, depth_mm: $2, steps: 2}
  - {kind: shear, distance_mm: 0.1, direction_deg: 30, steps: 1}
END
  "$bin"/press --config configs/press/default.yaml --sensor configs/sensors/mctac.yaml --sample "$1/sample.yaml" --gel gel/gel.msh \
    --object object/object.ply --out "$1/press" "${quiet[@]}"
  "$bin"/render --config configs/render/default.yaml --sensor configs/sensors/mctac.yaml --gel gel/gel.msh --press "$1/press" --out "$1/render" "${quiet[@]}"
}
a=mctac__pyramid__shear__000000 b=mctac__pyramid__shear__000001 c=mctac__cone__shear__000002
mkdir -p one/plan
echo 'name: one' > one/plan/dataset.yaml
cat > one/plan/samples.csv <<END
id,index,split,split_pose,seed,sensor,mesh,object,motion,shard,folder
$a,0,train,train,1,mctac,tiny,pyramid,shear,train-00000-of-00001,samples/000/$a
$b,1,val,train,2,mctac,tiny,pyramid,shear,val-00000-of-00001,samples/000/$b
$c,2,train,val,3,mctac,tiny,cone,shear,train-00000-of-00001,samples/000/$c
END
make_sample one/samples/000/$a 0.4
make_sample one/samples/000/$b 0.3
mkdir -p one/samples/000/$c/press
printf 'stage: press\nmessage: "did not converge, at last"\nframe: 2\n' > one/samples/000/$c/press/press.failed.yaml
cp -r one two

pack_dataset() { # pack_dataset FOLDER [VARIABLE=value …]
  local name=$1
  shift
  make -s -f Makefile.data pack DATASET_DIR="$name/" BUILD="$build_dir" PACKAGES=no "$@" > /dev/null
}
pack_dataset one THREADS=1
pack_dataset two THREADS=2 JOBS=2
sed -i 's/^# two$/# one/' two/pack/README.md # the only file that holds the folder's name
for what in shards pack; do
  diff -r --exclude='*.log' --exclude='*.timings.yaml' --exclude=timings.csv --exclude=card.yaml --exclude=checksums.sha256 --exclude=shards.mk --exclude='*.choice' --exclude='*.inputs' \
    one/$what two/$what || fail "one/$what and two/$what differ"
done
(cd one/pack && sha256sum --quiet -c checksums.sha256 && cd shards && sha256sum --quiet -c -- *.sha256) || fail "the checksums do not hold"
[ "$(cd one/pack && find . -type f | wc -l)" = "$(($(wc -l < one/pack/checksums.sha256) + 6))" ] || # timings, checksums, record, its times, log, lock
  fail "some files have no checksum: $(cd one/pack && find . -type f)"
"$python" "$source_dir/tests/pipeline/check_shard.py" one "$source_dir" || fail "what was packed does not load back"
for said in 'Fields, units and frames' 'What the checks prove' 'balance_relative' 'CC-BY-4.0' 'Citation' '| `obs/indentation_mm` | float32 | (T,H,W) | mm | S |'; do
  grep -qF "$said" one/pack/README.md || fail "the card does not say: $said"
done

stamp() { find one -name pack.yaml -printf '%p %T@\n' -o -name card.yaml -printf '%p %T@\n' | sort; }
before=$(stamp)
pack_dataset one
[ "$before" = "$(stamp)" ] || fail "a second run did something"
sleep 1.1
make_sample one/samples/000/$b 0.2
before=$(stamp)
pack_dataset one
changed=$(comm -13 <(echo "$before") <(stamp) | cut -d' ' -f1 | tr '\n' ' ')
[ "$changed" = "one/pack/card.yaml one/shards/val-00000-of-00001/pack.yaml " ] || fail "a sample made anew redid: $changed"
(cd one/pack && sha256sum --quiet -c checksums.sha256) || fail "the checksums do not hold any more"

# A profile of its own, and what is refused.
pack_dataset two PACK=slim
"$python" - two/pack/shards/train-00000-of-00001.h5 <<'END'
import sys, h5py
with h5py.File(sys.argv[1]) as f:
    for sample in f["data"].values():
        assert "rgb" in sample["obs"] and "normal" not in sample["obs"] and "min_distance_mm" in sample["check"], list(sample["obs"])
END
# Other layouts hold the same numbers, with the same bytes each time.
cp -a one again
for format in webdataset univtac folder; do
  for folder in one again; do
    make -s -f Makefile.data repack DATASET_DIR=$folder FORMAT=$format BUILD="$build_dir" PACKAGES=no > /dev/null
  done
done
same_files one/repack again/repack
"$python" "$source_dir/tests/pipeline/check_repack.py" one/shards one/repack || fail "an export does not hold what was packed"

# More shards than a command line has room for: the card is told by a file.
mkdir -p many/plan fake/bin
echo 'name: many' > many/plan/dataset.yaml
awk 'BEGIN { print "id,index,split,split_pose,seed,sensor,mesh,object,motion,shard,folder"
  for (i = 0; i < 1200; ++i) { id = sprintf("s__o__m__%06d", i); printf "%s,%d,train,train,1,s,m,o,m,train-%s%05d-of-01200,samples/000/%s\n", id, i, "with_a_long_name_so_that_twelve_hundred_of_them_take_more_than_128_kilobytes-", i, id } }' > many/plan/samples.csv
echo '#!/bin/sh
while [ "$1" != --out ]; do shift; done; echo packed > "$2/pack.yaml"' > fake/bin/pack
echo '#!/bin/sh
for word; do case $before in --shards) (cd "${word%/*}" && xargs cat < "${word##*/}") | grep -c packed ;; --out) out=$word ;; esac; before=$word; done; : > "$out/card.yaml"' > fake/bin/card
chmod +x fake/bin/*
ln -s "$build_dir"/bin/{survey,tacipc} fake/bin
fake/bin/survey pack-inputs many configs/datasets/pack/full.yaml
mkdir many/pack && (cd many/shards && sed 's|/pack.yaml||' shards.txt | xargs mkdir && xargs touch < shards.txt && while read -r record; do echo packed > "$record"; done < shards.txt)
make -s -f Makefile.data pack DATASET_DIR=many BUILD=fake PACKAGES=no REBUILD=no > said.txt 2>&1 || fail "twelve hundred shards get no card: $(tail -n 5 said.txt | cut -c1-300)"
grep -qx 1200 said.txt || fail "the card is not told of all shards: $(cut -c1-300 said.txt)"

code=0
pack_dataset nowhere 2> said.txt || code=$?
[ "$code" = 2 ] || fail "a dataset that is not there is not refused"
code=0
make -s -f Makefile.data pack BUILD="$build_dir" PACKAGES=no 2> said.txt || code=$?
[ "$code" = 2 ] && grep -q 'pack: say which dataset' said.txt || fail "no dataset is not refused"
echo "1 passed, 0 failed"
