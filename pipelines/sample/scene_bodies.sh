#!/usr/bin/env bash
# What make must know of a scene: scene_bodies.sh TACIPC SCENE.yaml. Lines with its gels, the soft bodies that are given as a surface, the
# surface of each, and all files that its bodies name. One that is not there, or that make would take for several, is a fault: said, and exit 1.
set -euo pipefail
export LC_ALL=C
tacipc=$1 scene=$2 gels='' soft='' files='' surfaces='' body=0
fault() { echo "SCENE: $scene: body $name names '$file', $1" >&2; exit 1; }
file_of() { # file_of KEY: sets file to what a body names under a key, as seen from here
  file=$("$tacipc" get "$scene" "bodies[$body].$1" --default '')
  case $file in
    '') return ;;
    /*) ;;
    *) file=$(dirname "$scene")/$file ;;
  esac
  case $file in
    *[!A-Za-z0-9._/+-]*) fault 'which has characters other than letters, digits and . _ / + - in it; rename or link the file' ;;
  esac
  [ -f "$file" ] || fault 'which does not exist'
  files+=" $file"
}
bodies=$("$tacipc" get "$scene" bodies --fields name,kind)
while IFS=$'\t' read -r name kind; do
  case $name in
    '' | *[!A-Za-z0-9_-]*) echo "SCENE: $scene: '$name': a name has letters, digits, _ and - alone" >&2; exit 1 ;;
  esac
  case $kind in
    gel) gels+=" $name" ;;
    *)
      file_of material
      file_of mesh
      case $kind,$file in
        soft,*.msh) ;;
        soft,?*) soft+=" $name" surfaces+="scene_surface_$name := $file"$'\n' ;;
      esac ;;
  esac
  body=$((body + 1))
done <<< "$bodies"
printf '%s' "scene_gels :=$gels
scene_soft :=$soft
scene_files :=$files
$surfaces"
