#!/usr/bin/env bash
# A folder of thirty meshes, as people bring them, of which five are broken in five ways, one so that the reader crashes: a dataset of
# twenty-five objects and five rows of failures with their reasons.
. "$(dirname "$0")/common.sh"
sed -i 's/width_px: 64/width_px: 16/; s/height_px: 48/height_px: 12/' configs/sensors/mctac.yaml
mkdir mine meshes
cat > mine/set.yaml <<'END'
seed: 1
sensors: {sensor: ../configs/sensors/mctac.yaml, mesh: ../configs/gels/tiny.yaml}
objects: {meshes: ../meshes, unit: auto}
maps: [tactile]
motions:
  - {name: down, samples: 1, placement: {rotate_deg: [0, 90]}, motion: {kind: press, depth_mm: 0.2, steps: 1}}
outputs: {pack: slim}
END
/usr/bin/python3 - <<'END'
import json, struct, zipfile
points = [(0, 0, 0), (3, 3, 2), (-3, 3, 2), (-3, -3, 2), (3, -3, 2)]  # a pyramid, mm, its tip down
faces = [(0, 2, 1), (0, 3, 2), (0, 4, 3), (0, 1, 4), (1, 2, 3), (1, 3, 4)]
core = 'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"'
production = 'xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" requiredextensions="p"'

def lines(form, rows): return "".join(form % row for row in rows)
def stl(): return "solid a\n" + "".join("facet normal 0 0 0\nouter loop\n" + lines("vertex %d %d %d\n", [points[c] for c in f]) + "endloop\nendfacet\n" for f in faces) + "endsolid\n"
def obj(of=faces): return lines("v %d %d %d\n", points) + lines("f %d %d %d\n", [tuple(c + 1 for c in f) for f in of])
def off(): return "OFF\n5 6 0\n" + lines("%d %d %d\n", points) + lines("3 %d %d %d\n", faces)
def ply():
    header = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
    return header + lines("%d %d %d\n", points) + lines("3 %d %d %d\n", faces)
def glb(padded):
    data = b"".join(struct.pack("<3f", *(c / 1000 for c in p)) for p in points) + bytes(c for f in faces for c in f)
    data += bytes(-len(data) % 4)
    text = json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "buffers": [{"byteLength": len(data)}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "bufferViews": [{"buffer": 0, "byteLength": 60}, {"buffer": 0, "byteOffset": 60, "byteLength": 18}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"}, {"bufferView": 1, "componentType": 5121, "count": 18, "type": "SCALAR"}]}).encode()
    text += b" " * ((-len(text) if padded else 1 - len(text)) % 4)
    return b"glTF" + struct.pack("<III", 2, 28 + len(text) + len(data), len(text)) + b"JSON" + text + struct.pack("<I", len(data)) + b"BIN\0" + data
def threemf(name, by_path=False, links=None):
    mesh = "<mesh><vertices>" + lines('<vertex x="%d" y="%d" z="%d"/>', points) + "</vertices><triangles>" + lines('<triangle v1="%d" v2="%d" v3="%d"/>', faces) + "</triangles></mesh>"
    def model(objects, build): return f'<model {core} {production}><resources>{objects}</resources><build>{build}</build></model>'
    box = f'<object id="1">{mesh}</object>'
    kind = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    with zipfile.ZipFile(name, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("_rels/.rels", links or f'<Relationships><Relationship Type="{kind}" Target="/3D/a.model"/></Relationships>')
        file.writestr("Metadata/thumbnail.png", b"\x89PNG\r\n\x1a\n")
        if by_path: file.writestr("3D/part.model", model(box, ""))
        file.writestr("3D/a.model", model("" if by_path else box, '<item objectid="1" p:path="/3D/part.model"/>' if by_path else '<item objectid="1"/>'))
def write(name, content):
    with open("meshes/" + name, "wb") as file: file.write(content if isinstance(content, bytes) else content.encode())

for i in range(25):
    kind = i % 8
    if kind == 0: write(f"good{i:02}.stl", stl())
    if kind == 1: write(f"good{i:02}.obj", b"\xef\xbb\xbf" + obj().encode())
    if kind == 2: write(f"good{i:02}.off", off())
    if kind == 3: write(f"good{i:02}.ply", ply())
    if kind in (4, 5): threemf(f"meshes/good{i:02}.3mf", by_path=kind == 5)
    if kind in (6, 7): write(f"good{i:02}.glb", glb(padded=kind == 6))
write("crash.stl", stl())
write("cut.glb", glb(padded=True)[:-10])
write("open.obj", obj(faces[:-1]))
threemf("meshes/stranger.3mf", links="hello")
write("wide.obj", obj().encode("utf-16"))
END
[ "$(find meshes -type f | wc -l)" = 30 ] || fail "not thirty meshes"
# In place of a reader that crashes.
mkdir -p crashing/bin
for program in "$build_dir"/bin/*; do ln -s "$program" crashing/bin/; done
rm crashing/bin/decimate
printf '#!/bin/sh\ncase "$*" in */crash.stl*) kill -SEGV $$ ;; esac\nexec %s/bin/decimate "$@"\n' "$build_dir" > crashing/bin/decimate
chmod +x crashing/bin/decimate

goal() { # goal BUILD GOAL [VARIABLE=value …]
  make -s -f Makefile.data "$2" CONFIG=mine/set.yaml OUT=out BUILD="$1" PACKAGES=no REBUILD=no "${@:3}"
}
set=out/datasets/set
counts() { grep -qx "set: 30 samples: $1 made, $2 failed, 0 running, 0 left" said.txt || fail "not $1 made and $2 failed: $(cat said.txt)"; }
ledger_has() { grep -q "^objects/$1,decimate,\".*$2.*\",objects/$1/decimate.log," $set/failures.csv || fail "the ledger does not say '$2' of $1: $(cat $set/failures.csv)"; }

goal "$PWD/crashing" dataset JOBS=2 > said.txt 2>&1 && fail "broken meshes went unseen"
counts 25 5
[ "$(wc -l < $set/failures.csv)" = 6 ] || fail "not five rows of failures: $(cat $set/failures.csv)"
ledger_has crash 'killed by signal 11'
ledger_has cut 'meshes/cut.glb: is cut off: '
ledger_has open 'open mesh: boundary loop of 3 edges'
ledger_has stranger 'meshes/stranger.3mf: _rels/.rels: is not XML'
ledger_has wide 'meshes/wide.obj: is UTF-16 (little-endian) text; save it as UTF-8'
[ "$(grep -c ',made,' $set/pack/manifest.csv)" = 25 ] || fail "not 25 objects are packed: $(cat $set/pack/manifest.csv)"
[ "$(grep -c '^mctac__[a-z]*__down__[0-9]*,press,.*its object cannot be made: ' $set/pack/failures.csv)" = 5 ] || fail "the pack does not list what failed: $(cat $set/pack/failures.csv)"
[ "$(find $set/objects -name object.ply -exec md5sum {} + | cut -d' ' -f1 | wc -l)" = 25 ] || fail "not 25 objects are made"

# Left alone until asked for, or until the mesh is another one.
before=$(find $set -name '*.yaml' -printf '%p %T@\n' | sort)
goal "$build_dir" dataset > said.txt 2>&1 && fail "old failures went unseen"
counts 25 5
[ "$before" = "$(find $set -name '*.yaml' -printf '%p %T@\n' | sort)" ] && [ "$(wc -l < $set/failures.csv)" = 6 ] || fail "a second run did something"
cp meshes/good01.obj meshes/wide.obj
goal "$build_dir" dataset > said.txt 2>&1 && fail "the other failures went unseen"
counts 26 4
goal "$build_dir" retry > said.txt 2>&1 && fail "meshes that are broken for good went unseen"
counts 27 3
[ "$(wc -l < $set/failures.csv)" = 9 ] || fail "not three more rows after a retry: $(cat $set/failures.csv)"
# A mesh that is broken now takes what was made of it along.
printf 'v 0 0 0\n' > meshes/good01.obj
goal "$build_dir" dataset > said.txt 2>&1 && fail "a mesh that became broken went unseen"
counts 26 4
ledger_has good01 'meshes/good01.obj: has no triangles'
echo "1 passed, 0 failed"
