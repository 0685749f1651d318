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
code=0
export_goal 2>said.txt || code=$?
[ "$code" = 2 ] && grep -q 'export: say which sample' said.txt || fail "no sample is not refused"
echo "1 passed, 0 failed"
