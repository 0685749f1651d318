#!/usr/bin/env bash
# faults_table.sh RECORD…: counts how often each stage met and handled each fault. Fails if one was not handled.
set -euo pipefail
tables=()
for record in "$@"; do tables+=("$(dirname "$record")/injected.csv"); done
awk -F, '
  FNR == 1 { next }
  { ++all[$2 "," $3]; stages[$2]; if ($4 != "missed") ++struck[$2 "," $3]; if ($4 == "find") ++finds[$2] }
  function cell(fault) { return struck[s "," fault] + 0 " of " all[s "," fault] + 0 }
  END {
    print "| Stage | Killed | Short write | Full disk | Damaged input | Finds |"
    print "|---|---|---|---|---|---|"
    for (s in stages)
      print "| `" s "` | " cell("kill") " | " cell("short") " | " cell("full") " | " cell("damaged") " | " finds[s] + 0 " |" | "LC_ALL=C sort"
  }' "${tables[@]}"
echo
echo 'Struck of injected: a call that ends before the blow falls, and damage that the stage does not read, are not struck.'
! grep -h '^  finds: [1-9]' "$@" > /dev/null ||
  { echo "faults: there are finds, in finds/ beside the records; after mending remove their faults.yaml" >&2; exit 1; }
