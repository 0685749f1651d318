#!/usr/bin/env bash
# Replaces a stage's program while faults.sh runs a test. The call is first made in a copy of its output folder: once
# undisturbed, then once for each fault. An incomplete result must then have no record, and the same call, repeated,
# must end in the same bytes as the undisturbed one. Finally the call is made as the test intended.
set -uo pipefail
stage=$(basename "$0")
program=$FAULTS_PROGRAMS/$stage
args=() at=-1
for word in "$@"; do [ "$word" = --if-changed ] || args+=("$word"); done # without --if-changed, each call does its work
for ((i = 0; i + 1 < ${#args[@]}; ++i)); do [ "${args[i]}" != --out ] || at=$((i + 1)); done
[ "$at" -ge 0 ] || exec "$program" "$@"

aside=$(mktemp -d)
trap 'umount "$place" 2> /dev/null; rm -rf "$aside"' EXIT
before=$aside/before place=$aside/place clean=$aside/clean said=$aside/said.txt
mkdir "$before"
[ ! -d "${args[at]}" ] || cp -a "${args[at]}/." "$before" 2> /dev/null # other processes may be writing there
rm -rf "$before"/.[!.]*
args[at]=$place

# draw N: sets $drawn to a number below N, by seed and call.
key="$FAULTS_SEED $stage ${*//"$PWD"/}" draws=0 drawn=0
draw() {
  local hash
  draws=$((draws + 1))
  hash=$(sha256sum <<< "$key $draws")
  drawn=$((16#${hash:0:12} % $1))
}
fresh() { rm -rf "$place" && cp -a "$before" "$place"; }
call() { # call [WRAPPER…]: sets $status to its exit status, and writes its messages to $said
  "$@" "$program" "${args[@]}" 2>&1 < /dev/null | cat > "$said"
  status=${PIPESTATUS[0]}
}
same() { diff -rq --exclude='.*' --exclude='*.log' --exclude='*timings*' --exclude='*.failed.yaml' "$@"; }
note() { echo "$FAULTS_TEST,$stage,$1,$2" >> "$FAULTS_FOLDER/injected.csv"; }
bad() { # bad FAULT WHY: records a find, with the data that reproduce it
  note "$1" find
  local kept
  kept=$(mktemp -d "$FAULTS_FOLDER/finds/$stage-$1-XXXX")
  cp "$said" "$kept"
  { echo "# $2, exit status $status; call of $FAULTS_TEST in $PWD:"; printf '%q ' "$program" "${args[@]}"; echo; } > "$kept/command.txt"
  echo "faults: $stage, $1: $2 ($kept)" >> "$FAULTS_FOLDER/finds.txt"
}
borne() { # borne FAULT: checks that no incomplete result has a record, and that the call completes it
  if [ -e "$place/$stage.yaml" ] && ! same "$place" "$clean" > /dev/null && ! same "$place" "$before" > /dev/null; then
    bad "$1" "a record stands over what is not whole"
    return
  fi
  call
  if [ "$status" != 0 ]; then bad "$1" "the next call fails"
  elif ! same "$place" "$clean" >> "$said"; then bad "$1" "the next call ends in other bytes"
  else note "$1" held; fi
}

fresh
began=${EPOCHREALTIME/./}
call
if [ "$status" = 0 ]; then
  took=$((${EPOCHREALTIME/./} - began)) # us
  mv "$place" "$clean"

  fresh
  draw "$took"
  call timeout -s KILL "$(printf '%d.%06d' $((drawn / 1000000)) $((drawn % 1000000 + 1)))"
  if [ "$status" = 137 ]; then borne kill; else note kill missed; fi

  # A file ends in the middle of a write: the kernel writes the rest of the limit, then nothing more.
  largest=$(find "$clean" -type f -not -name '*.log' -printf '%s\n' | sort -n | tail -n 1)
  fresh
  draw "${largest:-1}"
  call prlimit --fsize=$((drawn + 1))
  if [ "$status" = 0 ]; then
    if same "$place" "$clean" >> "$said"; then note short missed; else bad short "it says that it is done"; fi
  elif [ "$status" -gt 2 ] || [ ! -s "$said" ]; then bad short "it does not end with a message"
  else borne short; fi

  if [ -n "$FAULTS_MOUNT" ]; then
    rm -rf "$place" && mkdir "$place"
    draw "$(du -sk --apparent-size "$clean" | cut -f1)"
    mount -t tmpfs -o size=$(($(du -sk "$before" | cut -f1) + drawn + 4))k none "$place"
    cp -a "$before/." "$place"
    call
    if [ "$status" = 0 ]; then
      if same "$place" "$clean" >> "$said"; then note full missed; else bad full "it says that it is done"; fi
    elif [ "$status" -gt 2 ] || [ ! -s "$said" ]; then bad full "it does not end with a message"
    else
      mount -o remount,size=100% "$place"
      borne full
    fi
    umount "$place"
  fi

  # Damaged results of earlier stages: copies of inputs that have a record.
  roots=()
  for ((i = 0; i < ${#args[@]}; ++i)); do
    input=${args[i]}
    [ "$i" != "$at" ] && [ -e "$input" ] || continue
    [ -d "$input" ] || input=$(dirname "$input")
    for record in "$input"/*.yaml; do
      if grep -qsx "stage: $(basename "$record" .yaml)" "$record"; then
        [ "${args[i - 1]}" != --plan ] || input=$(dirname "$input") # a plan refers to samples in its own folder
        roots+=("$input")
        break
      fi
    done
  done
  if [ "${#roots[@]}" != 0 ]; then
    whole=("${args[@]}")
    damaged() { # damaged: flips a bit or cuts off the end of one file of one input; other inputs stay
      draw "${#roots[@]}"
      local root=${roots[drawn]} files victim size
      rm -rf "$aside/input"
      cp -a "$root" "$aside/input" 2> /dev/null
      for ((i = 0; i < ${#whole[@]}; ++i)); do [ "$i" = "$at" ] || args[i]=${whole[i]/#"$root"/"$aside/input"}; done
      fresh
      call
      [ "$status" = 0 ] || { note damaged missed; return; } # its inputs cannot be moved
      rm -rf "$aside/moved"
      mv "$place" "$aside/moved"
      mapfile -t files < <(find "$aside/input" -type f -size +0 -not -name '.*' -not -name '*.log' -not -name '*timings*' \
        -not -path '*/shards/*' -not -path '*/pack/*' -not -path '*/report/*' -printf '%P\n' | LC_ALL=C sort)
      draw "${#files[@]}"
      victim=$aside/input/${files[drawn]} size=$(stat -c %s "$aside/input/${files[drawn]}")
      touch -r "$victim" "$aside/time"
      draw "$size"
      local byte=$drawn
      draw 16
      if [ "$drawn" -ge 8 ]; then truncate -s "$byte" "$victim"; else
        printf '%b' "\\x$(printf %x $(($(od -An -tu1 -j"$byte" -N1 "$victim") ^ (1 << drawn))))" | dd of="$victim" bs=1 seek="$byte" conv=notrunc status=none
      fi
      touch -r "$aside/time" "$victim"
      fresh
      call
      echo "damaged: ${victim#"$aside/input/"} of $root" >> "$said"
      if [ "$status" = 0 ]; then
        # The record covers everything in a folder, whether it is read or not.
        if same --exclude="$stage.yaml" "$place" "$aside/moved" >> "$said"; then note damaged missed; else bad damaged "it takes a damaged file"; fi
      elif [ "$status" -gt 2 ]; then bad damaged "it does not end with a message"
      elif ! head -n -1 "$said" | grep -qF -e "$(basename "$victim")" -e "$(basename "$(dirname "$victim")")" -e "$aside/input"; then
        bad damaged "it does not name the file"
      elif [ -e "$place/$stage.yaml" ] && ! same "$place" "$before" > /dev/null; then bad damaged "a record stands over it"
      else note damaged held; fi
    }
    for _ in 1 2 3; do damaged; done
    args=("${whole[@]}")
  fi
fi
umount "$place" 2> /dev/null
rm -rf "$aside"
trap - EXIT
exec "$program" "$@"
