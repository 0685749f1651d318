#!/usr/bin/env bash
# A dataset of two sensors as LeRobot datasets, read back by pyarrow, and the lines of docs/pack.md that train on each layout.
. "$(dirname "$0")/common.sh"
/usr/bin/python3 -m venv --system-site-packages python
python/bin/pip install --quiet --disable-pip-version-check 'pyarrow==19.0.*' 'pillow==11.*' 2> said.txt || fail "pyarrow cannot be installed: $(cat said.txt)"
python=$PWD/python/bin/python
sed -i 's/width_px: .*/width_px: 48/; s/height_px: .*/height_px: 36/' configs/sensors/gelsight_mini.yaml
mkdir mine
cat > mine/set.yaml <<'END'
seed: 1
sensors:
  - {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
  - {sensor: ../configs/sensors/gelsight_mini.yaml, mesh: ../configs/gels/tiny.yaml}
objects:
  - {meshes: .., only: [pyramid, tilted], unit: mm}
render: ../configs/render/many_frames.yaml
motions:
  - {name: down, samples: 2, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: [0.2, 0.3], steps: 2}}
  - name: drag
    samples: 1
    placement: {rotate_deg: [0, 90]}
    motion: [{kind: press, depth_mm: [0.2, 0.3], steps: 1}, {kind: shear, distance_mm: 0.1, direction_deg: 30, steps: 2}]
splits: {test_objects: [tilted]}
outputs: {shard_mb: 1}
END
sed 's/ 0 0 0$/ 0.3 0.2 0/' pyramid.stl > tilted.stl
goal() { make -s -f Makefile.data "$1" CONFIG=mine/set.yaml OUT=out BUILD="$build_dir" PACKAGES=no REBUILD=no "${@:2}"; }
goal dataset JOBS=2 > said.txt 2>&1 || fail "no dataset: $(tail -5 said.txt)"
set=out/datasets/set
for format in webdataset folder univtac lerobot; do goal repack FORMAT=$format > said.txt 2>&1 || fail "no $format: $(cat said.txt)"; done

[ "$(find $set/repack/lerobot -mindepth 1 -maxdepth 1 -type d | wc -l)" = 2 ] || fail "there is not one LeRobot dataset per sensor: $(ls $set/repack/lerobot)"
for sensor in mctac gelsight_mini; do
  "$python" "$source_dir/tests/pipeline/check_lerobot.py" $set/repack/lerobot/$sensor $set/shards/*/*.h5 || fail "the LeRobot dataset of $sensor does not hold what was packed"
  grep -q '"splits": {' $set/repack/lerobot/$sensor/meta/info.json || fail "there are no splits"
done
"$python" - $set/repack/lerobot/mctac <<'END'
import pyarrow.parquet as parquet, sys
tasks = parquet.read_table(sys.argv[1] + "/meta/tasks.parquet").column("task").to_pylist()
assert sorted(tasks) == ["press pyramid", "press pyramid, then shear", "press tilted", "press tilted, then shear"], tasks
END
before=$(find $set/repack/lerobot -type f -printf '%p %T@\n' | sort)
goal repack FORMAT=lerobot > said.txt 2>&1
[ "$before" = "$(find $set/repack/lerobot -type f -printf '%p %T@\n' | sort)" ] || fail "a second run did something"
mv $set/repack/lerobot first
goal repack FORMAT=lerobot > said.txt 2>&1
same_files first $set/repack/lerobot
mapfile -t shards < <(find $set/shards -name '*.h5' | LC_ALL=C sort)
printf 'x' >> "${shards[0]}"
rm -r $set/repack/lerobot
goal repack FORMAT=lerobot > said.txt 2>&1 && fail "a damaged shard is taken"
[ ! -e $set/repack/lerobot/repack.yaml ] || fail "a damaged shard left a record"
"$build_dir/bin/repack" --config configs/datasets/repack/lerobot.yaml --shard "${shards[1]}" --out x 2> said.txt && fail "one shard is taken"
grep -q 'lerobot takes --shards' said.txt || fail "a single shard is not refused: $(cat said.txt)"
rm -rf $set/repack/lerobot
mv first $set/repack/lerobot

# The lines of the page: the network, then each layout by itself.
"$python" - "$source_dir/docs/pack.md" $set <<'END' || fail "the lines of docs/pack.md do not train"
import contextlib, io, math, re, sys
page = open(sys.argv[1]).read()
begin, *layouts = re.findall(r"```python\n(.*?)```", page[page.index("## Training on it"):], re.DOTALL)
assert len(layouts) == 5
for lines in layouts:
    assert len(lines.splitlines()) <= 10, lines
    names, said = {}, io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(re.sub(r'(?m)^D = .*$', f"D = {sys.argv[2]!r}", begin), names)
        exec(lines, names)
    losses = [float(line) for line in said.getvalue().split()]
    assert len(losses) > 3 and all(map(math.isfinite, losses)), (lines, losses)
END
echo "1 passed, 0 failed"
