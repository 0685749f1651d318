#!/usr/bin/env bash
# Condenses ninja's output for a log: a line per tenth of the build or 30 s, and every message of a compiler.
set -euo pipefail
tenth=0 said=0
while IFS= read -r line; do
  if [[ "$line" =~ ^\[([0-9]+)/([0-9]+)\]\  ]]; then
    done=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
    if ((all > 9 && (10 * done / all != tenth || SECONDS - said >= 30))); then
      echo "build: $done of $all, $SECONDS s"
      tenth=$((10 * done / all)) said=$SECONDS
    fi
  elif [ "$line" != 'ninja: no work to do.' ]; then
    printf '%s\n' "$line"
  fi
done
