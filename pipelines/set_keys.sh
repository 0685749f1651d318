#!/usr/bin/env bash
# A configuration with some of its values changed: set_keys.sh FILE [section.key=value …] > changed.yaml
# Keys stand at most one level deep, one a line. `section.key=` takes the key out, `section=` the section; a key that is not there is added to its
# section, and a section that is not there at the end.
set -euo pipefail
file=$1
shift
printf '%s\n' "$@" | awk -v file="$file" '
  /^$/ { next }
  { at = index($0, "="); if (!at) { print file ": " $0 ": say key=value" > "/dev/stderr"; exit bad = 2 }
    path = substr($0, 1, at - 1); wanted[++count] = path; value[path] = substr($0, at + 1) }
  function rest(of, i, path) { # the keys of a section that did not stand there
    for (i = 1; i <= count; ++i) { path = wanted[i]
      if (!(path in done) && value[path] != "" && (of == "" ? path !~ /\./ : index(path, of ".") == 1)) {
        done[path] = 1; print (of == "" ? path : "  " substr(path, length(of) + 2)) ": " value[path] } } }
  END {
    if (bad) exit bad
    while ((got = (getline line < file)) > 0) {
      if (match(line, /^[a-z_0-9]+:/)) { if (section != "") rest(section); section = path = substr(line, 1, RLENGTH - 1); indent = ""
        gone = path in value && value[path] == "" }
      else if (gone) continue
      else if (match(line, /^  [a-z_0-9]+:/)) { path = section "." substr(line, 3, RLENGTH - 3); indent = "  " }
      else { print line; continue }
      if (!(path in value)) print line
      else { done[path] = 1; if (value[path] != "") print indent substr(path, index(path, ".") + 1) ": " value[path] }
    }
    if (got < 0) { print file ": cannot be read" > "/dev/stderr"; exit 1 }
    if (section != "") rest(section)
    rest("")
    for (i = 1; i <= count; ++i) { path = wanted[i]
      if (path in done || value[path] == "" || path !~ /\./) continue
      section = substr(path, 1, index(path, ".") - 1); print section ":"; rest(section) }
  }'
