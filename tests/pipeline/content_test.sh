#!/usr/bin/env bash
# The content of inputs counts, not their dates: each file that a goal's records name is replaced by an older file of other content, touched, and
# replaced by a link to a copy. Stages then run again exactly where the content of an input has changed.
# Arguments after the usual two: goals (sample, grasp, scene and robot by default; of demo and paper-quick eight inputs take half an hour).
. "$(dirname "$0")/common.sh"
bin=$build_dir/bin
goals=("${@:3}")
[ ${#goals[@]} -gt 0 ] || goals=(sample grasp scene robot)

write_l part.stl 2
cat > grip.yaml <<'END'
fingers: {}
object: {mass_g: 5}
motion:
  - {kind: close, force_n: 0.3, steps: 1}
  - {kind: lift, distance_mm: 0.1, steps: 1}
END
sed 's/steps: .*/steps: 1/; /smooth/s/$/  # short/' configs/scenes/lift_block.yaml > configs/scenes/short.yaml
mkdir mine
printf 'OFF\n5 6 0\n0 0 0\n3 3 -2\n-3 3 -2\n-3 -3 -2\n3 -3 -2\n3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 1\n3 1 4 3\n3 1 3 2\n' > mine/point.off
cat > mine/slide.xml <<'END'
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <body name="point"><geom type="box" size="0.003 0.003 0.001" pos="0 0 -0.001"/></body>
    <body name="weight" pos="0 0 0.0105">
      <joint name="z" type="slide" axis="0 0 1" damping="6"/>
      <geom name="pad" type="cylinder" size="0.015 0.01" mass="0.06"/>
      <site name="tip"/>
    </body>
  </worldbody>
</mujoco>
END
cat > mine/slide.yaml <<'END'
model: slide.xml
pads: {name: gel, geom: pad, at_mm: [0, 0, -10], turn_deg: [180, 0, 0]}
objects: {name: point, kind: fixed, mesh: point.off, unit: mm}
steps: {seconds: 0.02}
END
variables_of() {
  case $1 in
    sample) echo OBJECT=part.stl MESH=tiny STEPS=1 MOTION=press ;;
    grasp) echo OBJECT=part.stl MESH=tiny GRASP=grip.yaml ;;
    scene) echo SCENE=configs/scenes/short.yaml MESH=tiny ;;
    robot) echo TASK=mine/slide.yaml MESH=tiny ;;
  esac
}
made() { # made GOAL: makes it
  local variables
  read -ra variables <<< "$(variables_of "$1")"
  make -s -f Makefile.data "$1" ${variables[@]+"${variables[@]}"} OUT="$1" BUILD="$build_dir" PACKAGES=no REBUILD=no > said.txt 2>&1 ||
    { tail -5 said.txt >&2; fail "$1 is not made"; }
}
# (Tries of a coupled robot are made together or not at all.)
records() { find "$1" -name '*.timings.yaml' -not -path '*/.*' -not -path '*/windows/*' | sed 's/\.timings\.yaml$/.yaml/' | LC_ALL=C sort; }
# A line per record: its file and the hashes of its inputs.
read_hashes() { records "$1" | while read -r record; do echo "$record $("$bin/tacipc" get "$record" inputs | grep -oE 'hash: .*' | paste -sd' ')"; done; }
# Files outside of what the goal makes that its records name.
inputs() {
  records "$1" | while read -r record; do
    "$bin/tacipc" get "$record" inputs | grep -oP '(^|[ {])path: "?\K[^",}]+' | while read -r path; do realpath -m "$(dirname "$record")/$path"; done
  done | grep "^$PWD/" | grep -v "^$PWD/$1/" | LC_ALL=C sort -u | while read -r path; do [ ! -f "$path" ] || echo "$path"; done
}

count=0
for goal in "${goals[@]}"; do
  made "$goal"
  mapfile -t files < <(inputs "$goal")
  [ ${#files[@]} -ge 3 ] || fail "$goal names no more than ${#files[@]} inputs"
  step=$(((${#files[@]} + 7) / 8))
  for ((f = 0; f < ${#files[@]}; f += step)); do
    file=${files[f]}
    cp -p "$file" kept
    for how in older newer link; do
      before=$(read_hashes "$goal")
      touch began && sleep 0.01
      case $how in
        older) { cat kept; echo; } > other && touch -d '2001-01-01' other && cp -p other "$file" ;;
        newer) cp kept "$file" && made "$goal" && before=$(read_hashes "$goal") && touch began && sleep 0.01 && touch "$file" ;;
        link) cp -p "$file" "${file%/*}/behind_${file##*/}" && ln -sf "behind_${file##*/}" "$file" ;;
      esac
      made "$goal"
      changed=$({ diff <(echo "$before") <(read_hashes "$goal") || true; } | sed -n 's/^> \([^ ]*\) .*/\1/p')
      ran=$(records "$goal" | while read -r record; do [ ! "${record%.yaml}.timings.yaml" -nt began ] || echo "$record"; done)
      [ "$ran" = "$changed" ] || fail "$goal: $file, $how: ran: $ran; other inputs: $changed"
      [ $how != older ] || [ -n "$ran" ] || fail "$goal: $file: an older file of other content was not seen"
      [ $how = older ] || [ -z "$ran" ] || fail "$goal: $file: $how, the same content: ran: $ran"
    done
    count=$((count + 1))
  done
done
echo "$count passed, 0 failed"
