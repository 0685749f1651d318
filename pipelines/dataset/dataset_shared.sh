#!/usr/bin/env bash
# A gel or an object of a dataset, for make: dataset_shared.sh RECORD PREREQUISITES COMMAND... (prerequisites may have wildcards).
# Several runs may find it missing or old: one makes it, the others wait and take it. Made anew by each, it would be gone for a moment while
# samples are made of it, and newer than they are.
set -euo pipefail
record=$1 prerequisites=$2
shift 2
folder=$(dirname "$record")
mkdir -p "$folder"
exec 9> "$folder/.making"
if ! flock -n 9; then
  flock 9
  ls -a "$folder" > /dev/null  # a client of NFS looks at the folder again
fi
if [ -e "$record" ]; then
  old=no
  for p in $prerequisites; do
    if [ "$p" -nt "$record" ]; then old=yes; fi
  done
  [ "$old" = yes ] || exit 0
fi
exec env "$@"
