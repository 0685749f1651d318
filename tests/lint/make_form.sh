#!/usr/bin/env bash
# Form of the pipelines: lines of at most 160 characters; no argument of a macro beyond the seventh position: longer lists are key=value (`fields`).
set -euo pipefail
export LC_ALL=C.UTF-8
cd "$1"
faults=0
complain() { # complain PATTERN REASON FILE …
  local hits
  hits=$(grep -nHE "$1" "${@:3}" || true)
  [ -z "$hits" ] || { cut -c 1-200 <<< "$hits"; echo "  ^ $2"; faults=1; }
}
mapfile -t rules < <(printf 'Makefile.data\n'; find pipelines -name '*.mk' | sort)
mapfile -t scripts < <(find pipelines -name '*.sh' | sort)
complain '^.{161}' 'a line may have 160 characters' "${rules[@]}" "${scripts[@]}"
complain '\$[({]([89]|[1-9][0-9]+)[)}]' 'a macro may take seven arguments by position' "${rules[@]}"
exit $faults
