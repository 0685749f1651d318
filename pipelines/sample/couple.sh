#!/usr/bin/env bash
# Couples robot and press: both run in turn, time window by time window, until they agree: couple.sh BIN OUT TASK
# ROBOT_ARGUMENTS -- PRESS_ARGUMENTS
# OUT/robot finally holds the whole motion, and robot/scene.yaml its scene. OUT/windows/0007/5/02/{robot,press} is the
# second iteration ("try") of the seventh window, of five frames; OUT/windows/0007/accepted names the iteration in which
# both agree. OUT/solved has the frames of accepted windows, OUT/residuals.csv a line per iteration.
# Existing results of the same inputs are reused, so an interrupted run continues. A window that does not converge is
# halved; if a window of a single frame does not, the run ends: exit 1. If robot, or press for its input, refuses its
# input, the run ends at once with that exit code.
set -euo pipefail
export LC_ALL=C
bin=$1 out=$2
window=$("$bin/tacipc" get "$3" coupling.window_frames --default 5)
most=$("$bin/tacipc" get "$3" coupling.most_tries --default 15)
shift 3
robot=() press=()
while [ "$1" != -- ]; do robot+=("$1"); shift; done
shift
press=("$@")
exact_after=6
mkdir -p "$out/windows" "$out/solved"
exec 9>> "$out/windows.lock" # stages do not keep this lock when the script is killed
flock -w 5 9 || { echo "couple: another run works in $out" >&2; exit 1; }
summary() { "$bin/tacipc" get "$1/robot.yaml" "summary.$2"; }

# robot_try OUT FRAMES BEFORE LAST [FLAG …]: one iteration of a window, after the accepted iteration BEFORE and the last
# one of the same window; either may be empty. A shorter window cannot remedy an error of robot.
robot_try() {
  local known=()
  [ -z "$3" ] || known+=(--start "$3/robot")
  if [ -n "$4" ]; then known+=(--try "$4/robot" --press "$4/press"); elif [ -n "$3" ]; then known+=(--press "$3/press"); fi
  "$bin/robot" "${robot[@]}" --frames "$2" ${known[@]+"${known[@]}"} "${@:5}" --out "$1" 9>&- || exit $?
}

# try_window FRAMES FOLDER: sets `accepted` to the iteration in which both agree; nonzero status if there is none.
try_window() {
  local frames=$1 folder=$2 k=1 now last='' code apart
  : > "$folder/residuals.csv"
  while :; do
    now=$folder/$(printf '%02d' "$k")
    [ -f "$now/robot/robot.yaml" ] || robot_try "$now/robot" "$frames" "$before" "$last"
    if [ -n "$last" ]; then
      # After some iterations the gels' responses may jump, so that no force agrees. Then the robot is loaded by a
      # response as it is, and may end at a slightly different position.
      apart=''
      if [ "$k" -gt "$exact_after" ] && [ "$(summary "$now/robot" converged)" != true ]; then
        rm -rf "$folder/agreed"
        if (robot_try "$folder/agreed/robot" "$frames" "$before" "$last" --exact yes); then apart=$(summary "$folder/agreed/robot" position_residual_m); fi
      fi
      printf '%s,' "$number" "$frames" "$(summary "$now/robot" window_first_frame)" $((k - 1)) "$(summary "$now/robot" residual_n)" \
        "$(summary "$now/robot" residual_relative)" "$(summary "$now/robot" stiffness_n_m)" >> "$folder/residuals.csv"
      echo "$apart" >> "$folder/residuals.csv"
      if [ "$(summary "$now/robot" converged)" = true ]; then
        accepted=$last
        return 0
      fi
      if [ -n "$apart" ] && [ "$(summary "$folder/agreed/robot" converged)" = true ]; then
        cp -rl "$last/press" "$folder/agreed/press"
        basename "$last" > "$folder/agreed/of"
        accepted=$folder/agreed
        return 0
      fi
      [ "$k" -le "$most" ] || return 1
    fi
    if [ ! -f "$now/press/press.yaml" ]; then
      "$bin/press" "${press[@]}" --sample "$now/robot/scene.yaml" --solved "$out/solved" --out "$now/press" 9>&- ||
        { code=$?; [ "$code" -eq 1 ] && return 1; exit "$code"; }
    fi
    last=$now k=$((k + 1))
  done
}

# Inputs of the windows: all inputs of robot and press. Windows of other inputs are not part of this run.
robot_try "$out/windows/begin" "$window" '' ''
{
  awk '/^inputs:/ { on = 1 } /^outputs:/ { on = 0 } /^task:/ { on = 1 } /^config:/ { on = 0 } on && !/^    path: /' "$out/windows/begin/robot.yaml"
  for ((i = 0; i < ${#press[@]}; ++i)); do
    if [ "${press[i]}" = --threads ]; then i=$((i + 1)); elif [ -f "${press[i]}" ]; then sha256sum < "${press[i]}"; else echo "${press[i]}"; fi
  done
  sha256sum < "$bin/robot"
  sha256sum < "$bin/press"
} > "$out/windows/of.txt.new"
if cmp -s "$out/windows/of.txt.new" "$out/windows/of.txt"; then
  if "$bin/tacipc" unchanged "$out/robot/robot.yaml"; then
    rm -rf "$out/windows/begin" "$out/windows/of.txt.new"
    exit 0
  fi
else
  find "$out/windows" "$out/solved" -mindepth 1 -maxdepth 1 ! -name 'of.txt.new' -exec rm -rf {} +
  mv "$out/windows/of.txt.new" "$out/windows/of.txt"
fi
rm -rf "$out/windows/begin" "$out/windows/of.txt.new"

before='' prior=''
for ((w = 1;; ++w)); do
  number=$(printf '%04d' "$w") length=$window
  folder=$out/windows/$number
  if [ ! -f "$folder/accepted" ]; then
    while mkdir -p "$folder/$length" && ! try_window "$length" "$folder/$length"; do
      [ "$length" -gt 1 ] || { echo "couple: window $w does not converge, not even of one frame: $folder" >&2; exit 1; }
      length=$((length / 2))
      echo "couple: window $w does not converge; now with $length frames"
    done
    # From here on the frames of the press are the run's; they are links, so that a run that dies in between finds both.
    ln -f "$accepted"/press/solved/* "$out/solved/"
    echo "${accepted#"$folder"/}" > "$folder/accepted.new"
    mv "$folder/accepted.new" "$folder/accepted"
    # Records, poses and wrenches of the iterations stay.
    rm -rf "$folder"/*/*/press/{gels,soft,solved}
    tail -n 1 "$folder/$length/residuals.csv" |
      awk -F, -v w="$w" '{ printf "couple: window %d: frames %d to %d agree after %d tries, residual %.2g\n", w, $3 + 1, $3 + $2, $4, $6 }'
  fi
  prior=$before
  accepted=$(cat "$folder/accepted")
  before=$folder/$accepted
  case $(summary "$before/robot" finished) in
    true) break ;;
    false) ;;
    *) exit 1 ;;
  esac
done
{ echo 'window,frames,first_frame,try,residual_n,residual_relative,stiffness_n_m,apart_m'; cat "$out"/windows/*/*/residuals.csv; } > "$out/residuals.csv.new"
mv "$out/residuals.csv.new" "$out/residuals.csv"
# The last accepted iteration has the whole motion. It is made again in its final folder, so that the paths in its files
# are right.
frames=${accepted%%/*} last='' flags=()
if [ -f "$before/of" ]; then
  last=$folder/$frames/$(cat "$before/of") flags=(--exact yes)
elif [ "${accepted##*/}" != 01 ]; then
  last=$(printf '%s/%s/%02d' "$folder" "$frames" $((10#${accepted##*/} - 1)))
fi
robot_try "$out/robot" "$frames" "$prior" "$last" ${flags[@]+"${flags[@]}"}
