#!/usr/bin/env bash
# A network that reads depth, from simulated presses to photographs: trained on 48 small images it beats the median depth and the same network trained on
# shuffled pairs on 24 of other objects; in Python it says the same; one thread and two end in the same bytes. Photographs that are not as those of the training were
# are found and named, nine of ten at least, and none of twenty as trained.
. "$(dirname "$0")/common.sh"
[ -x "$build_dir/bin/depthnet" ] || { echo "depthnet is not built (libtorch-dev)"; exit 77; }
value() { "$build_dir/bin/tacipc" get "$@"; }
goal() { make -s -f Makefile.data "$@" BUILD="$build_dir" OUT=made PACKAGES=no REBUILD=no JOBS=2 > said.txt 2>&1; }

# Pyramids and prisms of some heights and numbers of sides, tip down, mm.
mkdir meshes
/usr/bin/python3 - <<'END'
from math import cos, sin, pi
for name, sides, radius, tip in [("three", 3, 3, 0), ("four", 4, 3, 0.8), ("five", 5, 2.5, 0), ("six", 6, 2, 1), ("many", 24, 2.5, 0), ("stump", 24, 2.5, 1.2), ("test_a", 4, 2.8, 0.3), ("test_b", 7, 2.4, 0.7), ("test_c", 5, 2.7, 0.5)]:
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
# Lamps low beside the gel, as most sensors have them: shades of up to 60 codes.
sed -i 's/z_mm: -13.0/z_mm: -7.2/; s/rgb: \[30, 30, 30\]/rgb: [5, 5, 5]/' configs/sensors/mctac.yaml
grep -q 'z_mm: -7.2' configs/sensors/mctac.yaml && grep -q 'rgb: \[5, 5, 5\]' configs/sensors/mctac.yaml || fail "the lamps are where they were"
cat > touch.yaml <<'END'
seed: 1
sensors: {sensor: configs/sensors/mctac.yaml, mesh: configs/gels/tiny.yaml}
objects: {meshes: meshes, unit: mm, up: +z}
render: configs/render/many_frames.yaml
motions:
  - name: press
    samples: 8
    placement: {center_mm: {x: [-2, 2], y: [-1, 1]}, rotate_deg: [0, 360]}
    motion: {kind: press, depth_mm: [0.4, 0.8], steps: 1}
splits: {test_objects: [test_a, test_b, test_c]}
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
assert len(truths) == 24 and set(truths) == set(errors("net")), (len(truths), sorted(errors("net")))
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

# Images of 20 samples of the test objects as photographs, and what may happen to photographs.
/usr/bin/python3 - $data > ids.txt <<'END'
import glob, os, struct, sys, zlib
import h5py, numpy as np
def write(path, image):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    height, width, _ = image.shape
    rows = b"".join(b"\0" + row.tobytes() for row in np.ascontiguousarray(image))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(path, "wb") as png:
        png.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)))
        png.write(chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
def middle(image, part=4):  # without a quarter at each border, as large as before
    height, width, _ = image.shape
    rows = height // part + np.arange(height) * (part - 2) // part
    columns = width // part + np.arange(width) * (part - 2) // part
    return image[rows][:, columns]
changes = {"as_trained": lambda i: i, "swapped": lambda i: i[:, :, ::-1], "turned": lambda i: i[::-1, ::-1], "mirrored": lambda i: i[:, ::-1],
           "reduced": lambda i: i[::2, ::2], "middle": middle}
samples = {}
for path in sorted(glob.glob(f"{sys.argv[1]}/shards/*/*.h5")):
    with h5py.File(path) as shard:
        for id, sample in shard["data"].items():
            if sample.attrs["split"] == "test": samples[id] = sample["obs/rgb"][:]
ids = sorted(samples)[::-1][:20]
for kind, change in changes.items():
    for id in ids: write(f"photos/{kind}/{id}.png", change(samples[id][-1]))
    write(f"photos/{kind}/background.png", change(samples[ids[0]][0]))
print(*ids, sep="\n")
END
mapfile -t ids < ids.txt
[ ${#ids[@]} = 20 ] || fail "${#ids[@]} photographs"
# Other lamps: each of the ring's one place on, and the red one weaker.
sed -e '/index:/{s/intensity: 1.00/intensity: 0.70/;s/index: 7/index: 0/;t;s/index: 6/index: 7/;s/index: 4/index: 5/;s/index: 3/index: 4/;s/index: 1/index: 2/}' \
  configs/sensors/mctac.yaml > other.yaml
mkdir -p photos/other_lamps
for id in "${ids[@]:0:10}"; do
  "$build_dir/bin/render" --log-level warning --out "other/$id" --press "$(dirname "$(find $data/samples -path "*$id/press/press.yaml")")" \
    --gel $data/gels/*/gel.msh --sensor other.yaml --config configs/render/many_frames.yaml
  cp "other/$id/frame_0001/tactile.png" "photos/other_lamps/$id.png"
done
cp "other/${ids[0]}/frame_0000/tactile.png" photos/other_lamps/background.png

model=$(echo $data/depthnet/net/model_*.onnx)
photographs() { # photographs OUT BACKGROUND IMAGE …
  local out=$1 background=$2
  shift 2
  "$build_dir/bin/predict" --out "$out" --model "$model" --background "$background" --images "$@" 2> predicted.txt
}
row() { # row WHAT IMAGES FOUND NAMED LEAST MOST: of the table in docs/depthnet.md
  printf '| %s | %d | %d | %d | %.1f to %.1f |\n' "$@" | tee -a table.txt
}
echo "| Photographs | Number | Found | Named so | Distance |"
# told WHAT FOLDER DEVIATION COUNT
told() {
  local images=() record=predicted/$2/predict.yaml distances
  for id in "${ids[@]:0:$4}"; do images+=("photos/$2/$id.png"); done
  photographs "predicted/$2" "photos/$2/background.png" "${images[@]}" || fail "$1: $(cat predicted.txt)"
  distances=$(for id in "${ids[@]:0:$4}"; do value "$record" "summary.distance_from_training.$id"; done | sort -g)
  row "$1" "$4" "$(value "$record" summary.unlike_training.images)" "$(value "$record" "summary.unlike_training.deviations.$3" --default 0)" \
    "$(head -n 1 <<< "$distances")" "$(tail -n 1 <<< "$distances")"
}
told "as trained" as_trained none 20
told "red and blue swapped" swapped red_blue_swapped 10
told "turned by 180°" turned turned_180 10
told "mirrored left to right" mirrored mirrored_left_right 10
told "the middle half, enlarged" middle other_lamps 10
told "other lamps" other_lamps other_lamps 10
# Another touched image in the place of the gel at rest, and images of another size, each by itself.
for i in {0..9}; do
  photographs "touched/$i" "photos/as_trained/${ids[i + 10]}.png" "photos/as_trained/${ids[i]}.png" || fail "touched background: $(cat predicted.txt)"
  value "touched/$i/predict.yaml" summary.unlike_training.largest_distance >> touched.txt
  value "touched/$i/predict.yaml" summary.unlike_training.deviations.background_touched --default 0 >> named.txt
  photographs "reduced/$i" photos/reduced/background.png "photos/reduced/${ids[i]}.png" && fail "an image of another size is read"
  grep -q 'has 32 x 24 pixels; the network is for images of 64 x 48' predicted.txt && echo 1 >> reduced.txt
done
row "a touched image as background" 10 "$(awk '$1 > 1' touched.txt | wc -l)" "$(awk '{ n += $1 } END { print n }' named.txt)" \
  "$(sort -g touched.txt | head -n 1)" "$(sort -g touched.txt | tail -n 1)"
printf '| of another size (refused) | 10 | %d | %d | |\n' "$(wc -l < reduced.txt)" "$(wc -l < reduced.txt)" | tee -a table.txt
awk -F'|' 'NR == 1 ? $4 != 0 : $4 < 9 || ($2 !~ /middle/ && $5 < 9) { print; bad = 1 } END { exit bad || NR != 8 }' table.txt || fail "photographs that differ are not found"
refused 1 "the image and its background have red and blue swapped" "$build_dir/bin/predict" --strict --out strict --model "$model" \
  --background photos/swapped/background.png --images "photos/swapped/${ids[0]}.png"

# Validation images of a sensor with other lamps lie outside the training, and those of the same do not.
"$build_dir/bin/tacipc" set net.yaml schedule.epochs=1 schedule.warmup_epochs=0 > short.yaml
renders() { find $data/samples -path '*render/render.yaml' | sort | grep "$@" | xargs -n 1 dirname; }
mapfile -t trained < <(renders -v test_)
mapfile -t same < <(renders test_ | sed -n 1,10p)
validated() { # validated OUT RENDER …
  local out=$1
  shift
  "$build_dir/bin/depthnet" --out "$out" --config short.yaml --renders "${trained[@]}" --validation "$@" 2> said.txt || fail "$out: $(cat said.txt)"
}
validated validated_same "${same[@]}"
[ "$(value validated_same/depthnet.yaml summary.unlike_training.images)" = 0 ] || fail "validation images of the same sensor: $(cat said.txt)"
validated validated_other other/*
[ "$(value validated_other/depthnet.yaml summary.unlike_training.images)" -ge 9 ] || fail "validation images of another sensor are not found"
grep -q 'images of the validation (.*are unlike those of the training' said.txt || fail "nothing is said of the validation: $(cat said.txt)"
