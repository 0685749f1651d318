#!/usr/bin/env bash
# All sides of one object on one sheet: each pressed at its place, in quarter turns, from a 3MF file whose unit is its own.
. "$(dirname "$0")/common.sh"

/usr/bin/python3 - <<'END'
import zipfile
model = """<?xml version="1.0" encoding="UTF-8"?>
<model unit="inch" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>
<object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="0.4" y="0" z="0"/><vertex x="0" y="0.3" z="0"/>
<vertex x="0" y="0" z="0.2"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/>
<triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/></triangles></mesh></object></resources><build><item objectid="1"/></build></model>"""
types = """<?xml version="1.0" encoding="UTF-8"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"/>"""
links = """<?xml version="1.0" encoding="UTF-8"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>"""
with zipfile.ZipFile("corner.3mf", "w") as file:
    for name, text in [("[Content_Types].xml", types), ("_rels/.rels", links), ("3D/3dmodel.model", model)]: file.writestr(name, text)
END

gallery() { make -s -f Makefile.data gallery OBJECT=corner.3mf MESH=tiny DEPTH_MM=0.2 STEPS=1 OUT=one BUILD="$build_dir" PACKAGES=no "$@"; }
value() { "$build_dir/bin/tacipc" get "$@"; }
gallery TURNS="0 90" > said.txt 2>&1 || fail "no gallery: $(cat said.txt)"
decimate=one/sample/corner/object/decimate.yaml
[ "$(value $decimate summary.unit) $(value $decimate summary.unit_from)" = "in mesh format" ] || fail "the model's unit is not taken"
value $decimate 'summary.extents_mm[0]' | awk '{ exit !($1 > 10.159 && $1 < 10.161) }' || fail "0.4 inches are $(value $decimate 'summary.extents_mm[0]') mm"
for side in +x -x +y -y +z -z; do
  for turn in 0 90; do
    pose=one/sample/corner/gallery/${side}_$turn
    [ "$(value "$pose/sample.yaml" placement.face) $(value "$pose/sample.yaml" placement.rotate_deg)" = "$side $turn" ] || fail "$pose is another pose"
    [ -s "$pose/render/render.yaml" ] || fail "$pose is not rendered"
  done
done
[ -s one/sample/corner/gallery/report/contact_sheet.png ] || fail "there is no sheet"

# A quarter turn takes the object's place along: x, y become -y, x.
unturned=$(value one/sample/corner/gallery/+y_0/sample.yaml 'placement.center_mm' | tr -d '[],') turned=$(value one/sample/corner/gallery/+y_90/sample.yaml 'placement.center_mm' | tr -d '[],')
awk -v a="$unturned" -v b="$turned" 'BEGIN { split(a, u, " "); split(b, t, " "); exit !(t[1] + u[2] == 0 && t[2] == u[1]) }' ||
  fail "($unturned) turned by 90 degrees is ($turned)"

before=$(find one -name '*.yaml' -printf '%p %T@\n' | sort)
gallery TURNS="0 90" > said.txt 2>&1
[ "$before" = "$(find one -name '*.yaml' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"
for wrong in TURNS=45 FACE=+x; do
  code=0
  gallery "$wrong" > said.txt 2>&1 || code=$?
  [ "$code" = 2 ] && grep -Eq "TURNS: '45' must be some of|gallery: presses all sides" said.txt || fail "$wrong is not refused: $(cat said.txt)"
done
echo "1 passed, 0 failed"
