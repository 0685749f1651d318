#!/usr/bin/env bash
# Prints a line for make with the path files that a motion names: motion_paths.sh TACIPC [MOTION.yaml]. A missing file,
# or a name that make would take for several files, is an error: message and exit 1.
set -euo pipefail
export LC_ALL=C
tacipc=$1 motion=${2:-} named='' paths=''
fault() { echo "MOTION: $motion names the path '$name', $1" >&2; exit 1; }
[ -z "$motion" ] || named=$("$tacipc" paths "$motion")
while IFS= read -r name; do
  case $name in
    '') continue ;;
    *[!A-Za-z0-9._/+-]*) fault 'which has characters other than letters, digits and . _ / + - in it; rename or link the file' ;;
  esac
  [ -f "$name" ] || fault 'which does not exist'
  paths+=" $name"
done <<< "$named"
echo "motion_paths :=$paths"
