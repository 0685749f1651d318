#!/usr/bin/env bash
# A network that reads depth, from simulated presses to photographs: trained on 48 small images it beats the median depth and the same network trained on
# shuffled pairs on 16 of other objects; in Python it says the same; one thread and two end in the same bytes.
. "$(dirname "$0")/common.sh"
[ -x "$build_dir/bin/depthnet" ] || { echo "depthnet is not built (libtorch-dev)"; exit 77; }
value() { "$build_dir/bin/tacipc" get "$@"; }
goal() { make -s -f Makefile.data "$@" BUILD="$build_dir" OUT=made PACKAGES=no REBUILD=no JOBS=2 > said.txt 2>&1; }

# Pyramids and prisms of some heights and numbers of sides, tip down, mm.
mkdir meshes
/usr/bin/python3 - <<'END'
from math import cos, sin, pi
for name, sides, radius, tip in [("three", 3, 3, 0), ("four", 4, 3, 0.8), ("five", 5, 2.5, 0), ("six", 6, 2, 1), ("many", 24, 2.5, 0), ("stump", 24, 2.5, 1.2), ("test_a", 4, 2.8, 0.3), ("test_b", 7, 2.4, 0.7)]:
    ring = lambda r, z: [(r * cos(2 * pi * i / sides), r * sin(2 * pi * i / sides), z) for i in range(sides)]
    points = [(0, 0, 0)] + ring(max(tip, 0.05), 0) + ring(radius, 1.5) + [(0, 0, 1.5)]
    faces = []
    for i in range(sides):
        a, b, c, d = 1 + i, 1 + (i + 1) % sides, 1 + sides + i, 1 + sides + (i + 1) % sides
        faces += [(0, b, a), (a, b, d), (a, d, c), (len(points) - 1, c, d)]
    with open(f"meshes/{name}.off", "w") as out:
        out.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        for point in points: out.write("%g %g %g\n" % point)
        for face in faces: out.write("3 %d %d %d\n" % face)
END
cat > touch.yaml <<'END'
seed: 1
sensors: {sensor: configs/sensors/mctac.yaml, mesh: configs/gels/tiny.yaml}
objects: {meshes: meshes, unit: mm, up: +z}
render: configs/render/many_frames.yaml
motions:
  - name: press
    samples: 8
    placement: {center_mm: {x: [-2, 2], y: [-1, 1]}, rotate_deg: [0, 360]}
    motion: {kind: press, depth_mm: [0.3, 0.7], steps: 1}
splits: {test_objects: [test_a, test_b]}
maps: [tactile, indentation]
END
goal dataset CONFIG=touch.yaml || fail "no dataset: $(cat said.txt)"
"$build_dir/bin/tacipc" set configs/depthnet/default.yaml network.levels=3 network.base_channels=8 network.reduction=1 \
  schedule.epochs=40 schedule.learning_rate=0.003 augmentation.drift_codes=2 augmentation.noise_codes=1 augmentation.reference_codes=4 augmentation.shift_px=2 > net.yaml
"$build_dir/bin/tacipc" set net.yaml +shuffle_pairs=true > shuffled.yaml
data=made/datasets/touch
for net in net shuffled; do goal depthnet CONFIG=touch.yaml NET=$net.yaml || fail "$net: $(cat said.txt)"; done
[ "$(value $data/depthnet/net/depthnet.yaml summary.images)" = 48 ] || fail "trained on $(value $data/depthnet/net/depthnet.yaml summary.images) images"
[ -s $data/depthnet/net/test/sheet.png ] || fail "no sheet"

# The mean depth in contact, the same network on shuffled pairs, and what Python says of a test image.
/usr/bin/python3 - $data <<'END' || fail "see above"
import csv, glob, sys
import h5py, numpy as np, torch
data = sys.argv[1]
def errors(name):
    with open(f"{data}/depthnet/{name}/test/samples.csv") as file: return {row["name"]: row for row in csv.DictReader(file) if row["region"] == "pressed"}
truths, network, worst = {}, torch.jit.load(f"{data}/depthnet/net/model.pt"), 0
trained, deepest = [], []
for path in sorted(glob.glob(f"{data}/shards/*/*.h5")):
    with h5py.File(path) as shard:
        for id, sample in shard["data"].items():
            rgb, depth = sample["obs/rgb"][:], sample["obs/indentation_mm"][:]
            if sample.attrs["split"] == "train": trained.append(depth[1])
            if sample.attrs["split"] != "test": continue
            truths[f"{id}/frame_0001"] = depth[1]
            said = network(torch.from_numpy(rgb[1:2]), torch.from_numpy(rgb[0:1]))[0].numpy()
            deepest.append(f"{id} {said.max()}\n")
            touched = depth[1] > 0.02
            error = abs(said - depth[1])[touched].mean()
            worst = max(worst, abs(error - float(errors("net")[f"{id}/frame_0001"]["mae_mm"])))
open("deepest.txt", "w").writelines(deepest)
assert len(truths) == 16 and set(truths) == set(errors("net")), (len(truths), sorted(errors("net")))
assert worst < 1e-4, f"Python's answers differ by {worst} mm"
touched = lambda maps: np.concatenate([m[m > 0.02] for m in maps])
constant = abs(touched(truths.values()) - np.median(touched(trained))).mean()
of = lambda name: np.mean([float(row["mae_mm"]) for row in errors(name).values()])
print(f"in contact: network {of('net'):.4f} mm, shuffled pairs {of('shuffled'):.4f} mm, the median depth {constant:.4f} mm")
assert of("net") < 0.6 * constant and of("net") < 0.6 * of("shuffled")
END

# An image alone is read, too.
render=$(dirname "$(find $data/samples -path '*test_a*' -name render.yaml | sort | head -n 1)")
"$build_dir/bin/predict" --log-level warning --out read --model $data/depthnet/net/model_*.onnx --images "$render/frame_0001/tactile.png" --background "$render/frame_0000/tactile.png"
[ -s read/indentation/tactile.png ] && [ -s read/indentation/tactile.exr ] || fail "no depth of a photograph"
id=$(basename "$(dirname "$render")")
awk -v id="$id" -v said="$(value read/predict.yaml summary.deepest_mm.tactile)" '$1 == id { found = 1; d = said - $2; exit !(d < 1e-5 && d > -1e-5 && said > 0.1) } END { if (!found) exit 1 }' deepest.txt ||
  fail "predict and Python differ: $(value read/predict.yaml summary.deepest_mm.tactile), $(grep "^$id " deepest.txt)"

"$build_dir/bin/depthnet" --log-level warning --out again --threads 1 --config net.yaml --shards $data/shards/shards.txt
cmp again/model.pt $data/depthnet/net/model.pt || fail "other bytes with one thread"
