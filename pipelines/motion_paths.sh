#!/usr/bin/env bash
# Prints where the path files lie that a motion names, for make to depend on: motion_paths.sh MOTION.yaml. One that is
# not there, or that make would take for several files, is a fault: said in their place, and exit 1.
set -euo pipefail
export LC_ALL=C
motion=$1
fault() { echo "MOTION: $motion names the path '$name', $1"; exit 1; }

# What stands behind `file:` up to the end of its line or of its map in braces, without comment and quotes.
sed -E 's/(^|[[:space:]])#.*//' "$motion" | { grep -oE "(^|[^[:alnum:]_])file[\"']?[[:space:]]*:[^,}]*" || true; } |
  sed -E "s/^[^:]*:[[:space:]]*[\"']?//; s/[\"']?[[:space:]]*\$//" | while IFS= read -r name; do
  case $name in
    '' | *[!A-Za-z0-9._/+-]*) fault 'which is empty or has characters other than letters, digits and . _ / + - in it; rename or link the file' ;;
    /*) ;;
    *) name=$(dirname "$motion")/$name ;;
  esac
  [ -f "$name" ] || fault 'which does not exist'
  echo "$name"
done
