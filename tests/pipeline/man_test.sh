#!/usr/bin/env bash
# The front door lists every stage with the summary of its own; the manual page of a stage has every flag of its --help.
. "$(dirname "$0")/common.sh"
bin=$build_dir/bin
stages=$(sed -n '/^set(all_stages/,/)/p' "$source_dir/CMakeLists.txt" | tr -d '()' | grep -oE '[a-z]+/[a-z_]+')

"$bin/tacipc" help > help.txt
for stage in $stages; do
  name=${stage#*/}
  summary=$("$bin/$name" --summary)
  [ -n "$summary" ] || fail "$name has no summary"
  grep -qxF "$(printf '  %-14s %s' "$name" "$summary")" help.txt || fail "$name is not listed with its summary"
  grep -qx "${stage%/*}" help.txt || fail "there is no group ${stage%/*}"
  "$bin/$name" --help-man > page.1
  for flag in $("$bin/$name" --help | grep -oE '^ +(-h,)?--[a-z-]+' | grep -oE -e '--[a-z-]+'); do
    grep -qF -e "${flag//-/\\-}" page.1 || fail "$flag of $name is not in its manual page"
  done
  if grep -qE -e '--summary|--help-man' <<< "$("$bin/$name" --help)"; then fail "$name shows its hidden flags"; fi
  if command -v groff > /dev/null && command -v preconv > /dev/null; then
    groff -K utf8 -man -Tutf8 -ww page.1 2> said.txt > read.txt || fail "groff: $name"
    [ ! -s said.txt ] || fail "groff of $name: $(cat said.txt)"
  fi
done

# With the programs in PATH a shell takes `export` for its own command: help and documents call stages in a way that works.
for stage in $stages; do
  name=${stage#*/}
  [ "$name" = survey ] || [ "$("$bin/$name" --help | grep '^Usage: ')" = "Usage: tacipc $name [OPTIONS]" ] || fail "$name says another way to call it: $("$bin/$name" --help | grep '^Usage: ')"
done
[ "$(PATH=$bin:$PATH bash -c 'tacipc export --version')" = "$("$bin/export" --version)" ] || fail "tacipc export is not the stage"
"$bin/export" --nonsense 2> said.txt || true
grep -q '(see tacipc export --help)$' said.txt || fail "export leads to the shell's own: $(cat said.txt)"
for builtin in $(compgen -b | grep "^[a-z]"); do
  if grep -nE "^$builtin --?[a-z]" "$source_dir"/README.md "$source_dir"/docs/*.md; then fail "$builtin is called, which is a command of the shell"; fi
done

code=0
"$bin/tacipc" press --nonsense 2> said.txt || code=$?
[ $code = 2 ] || fail "tacipc press ends with $code"
"$bin/tacipc" help press | cmp - <("$bin/press" --help) || fail "help press is not press --help"
grep -q '^OpenBLAS [0-9]' <<< "$("$bin/tacipc" --version)" || fail "no version of OpenBLAS"
