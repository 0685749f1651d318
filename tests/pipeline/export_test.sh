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

refused 2 "FORMAT: 'gif' is neither vtk nor video" export_goal SAMPLE=one/sample/pyramid FORMAT=gif
refused 2 'SLOWER: has no effect without FORMAT=video' export_goal SAMPLE=one/sample/pyramid SLOWER=2
# A video: all frames are rendered first, the page shows them, and a second run has nothing to do.
if [ -x "$build_dir/bin/video" ]; then
  grep -q 'class="film"' one/sample/pyramid/report/index.html && fail "two frames of three make no film"
  export_goal SAMPLE=one/sample/pyramid FORMAT=video > said.txt
  grep -q 'All frames were rendered in one/sample/pyramid/frames' said.txt || fail "said: $(cat said.txt)"
  [ "$(head -c 8 one/sample/pyramid/video/video.mp4 | tail -c 4)" = ftyp ] || fail "video.mp4 is no MP4 file"
  grep -q 'frames: 3' one/sample/pyramid/video/video.yaml || fail "not three frames: $(cat one/sample/pyramid/video/video.yaml)"
  grep -q 'slower: 10' one/sample/pyramid/video/video.yaml || fail "$(cat one/sample/pyramid/video/video.yaml)"
  grep -q 'class="film"' one/sample/pyramid/report/index.html && [ -f one/sample/pyramid/report/films/sample-1.jpg ] || fail "no film on the page"
  before=$(stamp)
  export_goal SAMPLE=one/sample/pyramid FORMAT=video > said.txt
  [ "$before" = "$(stamp)" ] || fail "a second run of the video did something"
  export_goal SAMPLE=one/sample/pyramid FORMAT=video SLOWER=1 > said.txt
  grep -q 'slower: 1$' one/sample/pyramid/video/video.yaml || fail "not at its own pace: $(cat one/sample/pyramid/video/video.yaml)"
  mkdir bin && for program in "$build_dir"/bin/*; do ln -s "$program" bin/; done && rm bin/video
  refused 2 'video: not built for want of libavformat-dev: make -f Makefile.data packages build GROUPS=video' \
    make -s -f Makefile.data export OUT=one BUILD="$PWD" REBUILD=no PACKAGES=no SAMPLE=one/sample/pyramid FORMAT=video SLOWER=3
fi
code=0
export_goal 2>said.txt || code=$?
[ "$code" = 2 ] && grep -q 'export: say which sample' said.txt || fail "no sample is not refused"
echo "1 passed, 0 failed"
