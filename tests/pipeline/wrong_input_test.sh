#!/usr/bin/env bash
# What a user may get wrong: one clear message, exit 1 or 2, no result.
. "$(dirname "$0")/common.sh"
bin=$build_dir/bin
count=0

# refuses CODE 'MESSAGE PART' RECORD COMMAND…: exit code and message as said, no record, nothing half-written.
refuses() {
  local code=$1 message=$2 record=$3 got=0
  shift 3
  "$@" >stdout.txt 2>stderr.txt || got=$?
  [ "$got" = "$code" ] || { cat stderr.txt; fail "'$*' ended with $got, expected $code"; }
  grep -qF -- "$message" stderr.txt || { cat stderr.txt; fail "'$*' did not say '$message'"; }
  [ ! -s stdout.txt ] || fail "'$*' wrote to standard output"
  [ ! -e "$record" ] || fail "'$*' left $record"
  # A stage that can go on may keep what it has solved, but nothing half-written.
  [ -z "$(find . -path '*/.partial-*' -type f -not -path '*/.scratch/*' -not -name .resume-key -print -quit)" ] || fail "'$*' left a partial file"
  find . -depth -name '.partial-*' -exec rm -rf {} +
  count=$((count + 1))
}
decimate() { "$bin/decimate" --mesh "$1" --object configs/objects/millimetres.yaml --config configs/objects/decimate/default.yaml --out o "${@:2}"; }
refuse_mesh() { refuses 1 "$2" o/decimate.yaml decimate "$1"; }
echo 'unit: mm' > configs/objects/millimetres.yaml

head -c 60 pyramid.stl > cut.stl;                       refuse_mesh cut.stl 'cut.stl'
printf 'solid x\nendsolid x\n' > empty.stl;             refuse_mesh empty.stl 'has no triangles'
: > nothing.obj;                                        refuse_mesh nothing.obj 'the file is empty'
sed 's/vertex 0 0 0/vertex nan 0 0/' pyramid.stl > nan.stl; refuse_mesh nan.stl 'not finite'
printf 'v 0 0 0\nv 5 0 0\nv 0 5 0\nf 1 2 3\n' > open.obj;   refuse_mesh open.obj 'open mesh'
printf 'v 0 0 0\nv 5 0 0\nv 0 5 0\nf 1 2 9\n' > index.obj;  refuse_mesh index.obj 'index.obj:4'
head -c 5000 /dev/zero > zeros.stl;                     refuse_mesh zeros.stl 'zeros.stl'

"$bin/tetmesh" --sensor configs/sensors/mctac.yaml --config configs/gels/tiny.yaml --out gel --log-level off
"$bin/decimate" --mesh pyramid.stl --object configs/objects/millimetres.yaml --config configs/objects/decimate/default.yaml --out ok --log-level off
press() { "$bin/press" --config configs/press/paper.yaml --sensor "$1" --sample configs/motions/press_0500um.yaml --gel "$2" --object ok/object.ply --out "${3:-p}" --log-level "${4:-warning}"; }
head -c 3000 gel/gel.msh > cut.msh
refuses 1 'cut.msh' p/press.yaml press configs/sensors/mctac.yaml cut.msh

cat > faults.yaml <<'YAML'
name: five
gel: {outline: disk, radius_mm: 15, thickness_mm: -2}
material: {law: neo_hookean, density_kg_m3: 1010, young_modulus_pa: 1e5, poissons_ratio: 0.5, poissons_ratio: 0.4}
coating: {albedo: [0.5, 0.5, 0.5]}
leds: {list: [{position_mm: [0, 0, -9], rgb_linear: [1, 1, 1], intensity: 1}]}
camera: {position_mm: [0, 0, -12], width_px: 64, height_px: 48, window_mm: [8, 6]}
response: {mean_level: 0.5, curve: srgb}
YAML
refuses 2 "faults.yaml:2:16: gel.outline: 'disk' is not one of disc, rectangle (did you mean disc?)" p/press.yaml press faults.yaml gel/gel.msh
for part in 'faults.yaml:2:51: gel.thickness_mm: -2 is outside [0.001, 10000]' 'material.young_modulus_pa: unknown key (did you mean youngs_modulus_pa?)' \
            'material.youngs_modulus_pa: missing' 'material.poissons_ratio: key given twice' 'material.poissons_ratio: 0.5 is outside'; do
  grep -qF "$part" stderr.txt || { cat stderr.txt; fail "the faults do not name '$part'"; }
done

refuses 2 '--depth' o/decimate.yaml decimate pyramid.stl --depth 3
refuses 2 '--config is required' p/press.yaml "$bin/press" --out p
echo > file_in_the_way
refuses 1 'file_in_the_way' file_in_the_way/press.yaml press configs/sensors/mctac.yaml gel/gel.msh file_in_the_way
if [ "$(id -u)" != 0 ]; then
  mkdir locked && chmod a-w locked
  refuses 1 'Permission denied' locked/p/press.yaml press configs/sensors/mctac.yaml gel/gel.msh locked/p
fi

mkdir -p with_pipe/sub
mkfifo with_pipe/sub/frame.png
refuses 2 'with_pipe/sub/frame.png is a pipe or a device' r/render.yaml timeout 20 "$bin/render" --config configs/render/default.yaml \
  --sensor configs/sensors/mctac.yaml --gel gel/gel.msh --press with_pipe --out r

# A full disk, as a limit on the size of files.
limited() { (ulimit -f 8; "$@"); }
refuses 1 'cannot be written' g/tetmesh.yaml limited "$bin/tetmesh" --sensor configs/sensors/mctac.yaml --config configs/gels/tiny.yaml --out g
refuses 1 'cannot be written' p/press.yaml limited press configs/sensors/mctac.yaml gel/gel.msh
sed -i 's/^vertices: .*/vertices: 3000/' configs/objects/patterns/star.yaml
refuses 1 'cannot be written' e/emboss.yaml limited "$bin/emboss" --config configs/objects/patterns/star.yaml --out e
press configs/sensors/mctac.yaml gel/gel.msh ready off
refuses 1 'cannot be written' r/render.yaml limited "$bin/render" --config configs/render/default.yaml --sensor configs/sensors/mctac.yaml --gel gel/gel.msh --press ready --out r

"$bin/emboss" --config configs/objects/patterns/star.yaml --out fine --log-level off
echo 'unit: m' > configs/objects/metres.yaml
refuses 1 'cannot be written' d/decimate.yaml limited "$bin/decimate" --mesh fine/object.ply --object configs/objects/metres.yaml --config configs/objects/decimate/default.yaml --out d
refuses 1 '/proc/tacipc' /proc/tacipc/press.yaml press configs/sensors/mctac.yaml gel/gel.msh /proc/tacipc

make_refuses() { # make_refuses 'MESSAGE PART' VARIABLE=value…
  local message=$1
  shift
  if make -s -f Makefile.data sample BUILD="$build_dir" PACKAGES=no OUT=m "$@" >stdout.txt 2>stderr.txt; then fail "make sample $* succeeded"; fi
  grep -qF -- "$message" stderr.txt || { cat stderr.txt; fail "make sample $* did not say '$message'"; }
  count=$((count + 1))
}
make_refuses 'say which object'
make_refuses 'no_such.stl does not exist' OBJECT=no_such.stl
make_refuses 'there is no configs/sensors/digi.yaml' OBJECT=pyramid.stl SENSOR=digi
make_refuses "OBJECT: 'a(1).stl' has characters" 'OBJECT=a(1).stl'
make_refuses "OBJECT: 'b&c.stl' has characters" 'OBJECT=b&c.stl'
make_refuses "NAME: 'my part' has characters" OBJECT=pyramid.stl 'NAME=my part'
for name in ../x . .. a/../../x /tmp/x; do make_refuses "NAME: '$name' leads out of m" OBJECT=pyramid.stl NAME=$name; done
make_refuses "MOTION: 'slide' is none of press, shear, twist, tilt, hold, release" OBJECT=pyramid.stl MOTION=shear+slide
make_refuses 'MOTION: no_such.yaml does not exist' OBJECT=pyramid.stl MOTION=no_such.yaml
for path in 'my path.csv' gone.csv; do echo "motion: {kind: path, file: $path}" > "${path%%[ .]*}.yaml"; done
touch 'my path.csv'
make_refuses "MOTION: my.yaml names the path 'my path.csv', which has characters" OBJECT=pyramid.stl MOTION=my.yaml
make_refuses "MOTION: gone.yaml names the path 'gone.csv', which does not exist" OBJECT=pyramid.stl MOTION=gone.yaml
make_refuses 'TWIST_DEG: has no effect with MOTION=shear' OBJECT=pyramid.stl MOTION=shear TWIST_DEG=3
make_refuses 'ROTATE: has no effect with MOTION=configs/motions/press_0500um.yaml' OBJECT=pyramid.stl MOTION=configs/motions/press_0500um.yaml ROTATE=3
make_refuses 'DEPTH_MM, FORCE_N: say one of them' OBJECT=pyramid.stl DEPTH_MM=1 FORCE_N=2
make_refuses 'PRESS: there is no configs/press/fast.yaml' OBJECT=pyramid.stl PRESS=fast
make_refuses 'configs/press/paper.yaml:1:1: friction.coefficient: there is no such key' OBJECT=pyramid.stl PRESS=paper FRICTION=0.3
make_refuses "'up' is not one of" OBJECT=pyramid.stl MESH=tiny FACE=up
echo "$count passed, 0 failed"
