#!/usr/bin/env bash
# The whole chain on a tiny gel: equal bytes with one and two threads, nothing to do a second time, and a changed
# configuration redoes what depends on it and nothing else.
. "$(dirname "$0")/common.sh"

tiny_sample one THREADS=1
tiny_sample two THREADS=2
same_files one two
for file in press/press.yaml render/render.yaml report/index.html report/contact_sheet.png; do
  [ -s "one/sample/pyramid/$file" ] || fail "$file is missing"
done
grep -q '^    balance_relative: 0.001$' one/sample/pyramid/press/press.yaml || fail "the press does not tell its limits"
grep -q 'converged: true' one/sample/pyramid/press/press.yaml || fail "the press did not converge"

stamp() { find one -name '*.yaml' -not -name '*.timings.yaml' -printf '%p %T@\n' | sort; }
before=$(stamp)
tiny_sample one
[ "$before" = "$(stamp)" ] || fail "a second run did something"

sleep 1.1
touch configs/render/default.yaml pyramid.stl
tiny_sample one
[ "$before" = "$(stamp)" ] || fail "later dates redid something"
echo '# says the same' >> configs/render/default.yaml
touch -d '2001-01-01' configs/render/default.yaml
tiny_sample one
changed=$(comm -13 <(echo "$before") <(stamp) | cut -d' ' -f1 | xargs -n1 basename | sort | tr '\n' ' ')
[ "$changed" = "render.yaml report.yaml " ] || fail "another render configuration of an earlier date redid: $changed"
tiny_sample two
same_files one two

# Another object in the place of this one, copied with its earlier date, and as a link.
cp pyramid.stl kept.stl
sed 's/ 2$/ 1.5/' kept.stl > flatter.stl
touch -d '2001-01-01' flatter.stl
cp -p flatter.stl pyramid.stl
tiny_sample one
cmp -s {one,two}/sample/pyramid/object/object.ply && fail "another object of an earlier date changed nothing"
ln -sf kept.stl pyramid.stl
tiny_sample one
cmp {one,two}/sample/pyramid/object/object.ply || fail "a link to the first object is not seen"
rm pyramid.stl
mv kept.stl pyramid.stl
rm -rf one/sample
tiny_sample one
same_files one two

# Another file under the same name is another sample.
tiny_sample one OBJECT=flatter.stl NAME=pyramid
cmp -s {one,two}/sample/pyramid/object/object.ply && fail "another object changed nothing"
tiny_sample one
same_files one two

# A motion after the press, with friction: in the record, on the page, and redone when the coefficient changes.
drag() { tiny_sample one NAME=dragged MOTION=shear+release MOVE_STEPS=2 SHEAR_MM=0.2 "$@"; }
drag FRICTION=0.5
record=one/sample/dragged/press/press.yaml
grep -q '^  friction_coefficient: 0.5$' $record || fail "the friction coefficient is not in the record"
[ "$(grep -c 'phase: shear$' $record)" = 2 ] || fail "there are not two frames of shear"
[ "$(grep -c 'phase: release$' $record)" = 2 ] || fail "there are not two frames of release"
grep -q 'Tangential over press force' one/sample/dragged/report/index.html || fail "the page has no friction curve"
before=$(cat $record)
drag
grep -q '^  friction_coefficient: 0.7$' $record || fail "the coefficient of the press configuration is not in the record"
drag FRICTION=0.5
[ "$before" = "$(cat $record)" ] || fail "the same friction gave another record"

# The friction of a sensor's own gel goes before that, and a mount that gives way leaves where the holder was.
sed 's/^  outline: disc/  friction: 0.4\n&/; s/^material:/mount: {compliance_mm_per_n: 0.05}\n&/' configs/sensors/mctac.yaml > configs/sensors/held.yaml
drag SENSOR=held FRICTION=0.5
grep -q '^friction_from: sensor$' $record || fail "the record does not say whose friction it is"
grep -q '^  friction_coefficient: 0.4$' $record || fail "the friction of the sensor's gel does not count"
[ -s one/sample/dragged/press/holder_pose.npy ] || fail "where the holder was is not written"

# A path: its rows are in a file that the motion names, and another path is another sample.
mkdir moves
echo 'motion: {kind: path, file: "down.csv"}  # beside this file' > moves/down.yaml
path() { printf '0,0,0,0,0,0,0,1\n0.01,0,0,%s,0,0,0,1\n' "$1" > moves/down.csv; }
along() { make -s -f Makefile.data sample OBJECT=pyramid.stl NAME=along MESH=tiny MOTION=moves/down.yaml OUT=one BUILD="$build_dir" PACKAGES=no; }
path -0.0001
along
before=$(cat one/sample/along/press/press.yaml)
sleep 1.1
path -0.0002
along
[ "$before" != "$(cat one/sample/along/press/press.yaml)" ] || fail "another path changed nothing"

# Embossed objects: touching the decimation's configuration leaves the embossing alone.
sed -i 's/^vertices: .*/vertices: 3000/' configs/objects/patterns/star.yaml
emboss_star() { make -s -f Makefile.data "$PWD/e/objects/star/decimate.yaml" OUT="$PWD/e" BUILD="$build_dir" PACKAGES=no; }
emboss_star
[ -s e/emboss/star/emboss.yaml ] || fail "the record of the embossing is gone"
before=$(find e -name '*.yaml' -not -name '*.timings.yaml' -printf '%f %T@\n' | sort)
sleep 1.1
touch configs/objects/decimate/default.yaml
emboss_star
changed=$(comm -13 <(echo "$before") <(find e -name '*.yaml' -not -name '*.timings.yaml' -printf '%f %T@\n' | sort) | cut -d' ' -f1 | tr '\n' ' ')
[ "$changed" = "decimate.yaml " ] || fail "touching the decimation's configuration redid: $changed"
# A press asks for huge pages (VmFlags hg), whoever starts it, unless its environment says otherwise.
asks() { # asks [VARIABLE=value]: while the press of `two` is made again
  rm -rf again
  env "$@" "$build_dir"/bin/press --out again --gel two/gels/mctac-tiny/gel.msh --object two/sample/pyramid/object/object.ply --sensor configs/sensors/mctac.yaml \
    --config configs/press/default.yaml --sample two/sample/pyramid/sample.yaml > /dev/null 2>&1 &
  local asked=no
  while kill -0 $! 2> /dev/null; do
    if grep -q '^VmFlags:.* hg' "/proc/$!/smaps" 2> /dev/null; then asked=yes; fi
    sleep 0.01
  done
  wait $! || fail "the press failed"
  [ $asked = yes ]
}
if [ -e /sys/kernel/mm/transparent_hugepage ]; then
  asks || fail "a press does not ask for huge pages"
  if asks GLIBC_TUNABLES=glibc.malloc.hugetlb=0; then fail "a press asks for huge pages against its environment"; fi
fi
echo "1 passed, 0 failed"
