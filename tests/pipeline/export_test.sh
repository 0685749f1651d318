#!/usr/bin/env bash
# A sample as VTK files: the goal finds gel and object in the press's record, makes the sample first where it must, and has
# nothing to do a second time.
. "$(dirname "$0")/common.sh"

export_goal() { make -s -f Makefile.data export OUT=one BUILD="$build_dir" PACKAGES=no "$@"; }

tiny_sample one
export_goal SAMPLE=one/sample/pyramid/
for kind in surface volume object; do
  for frame in 0000 0001 0002; do
    grep -qa 'AppendedData encoding="raw"' "one/sample/pyramid/export/${kind}_$frame.vtu" || fail "${kind}_$frame.vtu is missing"
  done
  [ "$(grep -c '<DataSet' "one/sample/pyramid/export/$kind.pvd")" = 3 ] || fail "$kind.pvd does not list three frames"
done
[ "$(head -c 4 one/sample/pyramid/export/sample.glb)" = glTF ] || fail "sample.glb is no glTF file"
stamp() { find one -name '*.yaml' -printf '%p %T@\n' | sort; }
before=$(stamp)
export_goal SAMPLE=one/sample/pyramid
[ "$before" = "$(stamp)" ] || fail "a second run did something"

# With stress in the press file: the tensors of the volume, pressure on the surface.
sed '$a stress: true' configs/press/default.yaml > configs/press/stressed.yaml
tiny_sample stressed PRESS=stressed
export_goal SAMPLE=stressed/sample/pyramid
grep -qa 'Name="stress" NumberOfComponents="6"' stressed/sample/pyramid/export/volume_0002.vtu || fail "no stress in volume_0002.vtu"
grep -qa 'Name="pressure"' stressed/sample/pyramid/export/surface_0002.vtu || fail "no pressure in surface_0002.vtu"
[ -f stressed/sample/pyramid/render/frame_0002/pressure.exr ] || fail "no pressure.exr"
cmp one/sample/pyramid/press/positions.npy stressed/sample/pyramid/press/positions.npy || fail "measuring stress changes the press"
[ ! -f one/sample/pyramid/press/stress.npy ] || fail "stress without being asked"

code=0
export_goal 2>said.txt || code=$?
[ "$code" = 2 ] && grep -q 'export: say which sample' said.txt || fail "no sample is not refused"
echo "1 passed, 0 failed"
