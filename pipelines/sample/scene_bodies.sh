#!/usr/bin/env bash
# Prints a scene's data for make: scene_bodies.sh TACIPC SCENE.yaml. Lines list its gels, the soft bodies given as a
# surface, the surface of each, and all files that its bodies name. A missing file, or a name that make would take for
# several files, is an error: message and exit 1.
set -euo pipefail
export LC_ALL=C
tacipc=$1 scene=$2 gels='' soft='' files='' surfaces='' absent=-
folder=./
case $scene in */*) folder=${scene%/*}/ ;; esac
fault() { echo "SCENE: $scene: body $name names '$file', $1" >&2; exit 1; }
file_of() { # file_of NAMED: sets file to the path of a body's file, relative to the current folder
  case $1 in
    "$absent") file='' && return ;;
    /*) file=$1 ;;
    *) file=$folder$1 ;;
  esac
  case $file in
    *[!A-Za-z0-9._/+-]*) fault 'which has characters other than letters, digits and . _ / + - in it; rename or link the file' ;;
  esac
  [ -f "$file" ] || fault 'which does not exist'
  files+=" $file"
}
bodies=$("$tacipc" get "$scene" bodies --fields name,kind,material,mesh --default "$absent")
[ "$bodies" != "$absent" ] || "$tacipc" get "$scene" bodies
while IFS=$'\t' read -r name kind material mesh; do
  case $name in
    '' | "$absent" | *[!A-Za-z0-9_-]*) echo "SCENE: $scene: '$name': a name has letters, digits, _ and - alone" >&2; exit 1 ;;
  esac
  case $kind in
    gel) gels+=" $name" ;;
    *)
      file_of "$material"
      file_of "$mesh"
      case $kind,$file in
        soft,*.msh) ;;
        soft,?*) soft+=" $name" surfaces+="scene_surface_$name := $file"$'\n' ;;
      esac ;;
  esac
done <<< "$bodies"
printf '%s' "scene_gels :=$gels
scene_soft :=$soft
scene_files :=$files
$surfaces"
