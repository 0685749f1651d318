#!/usr/bin/env bash
# press on little memory (ulimit -v), called without make: it ends, with the result of a run that had enough or with one message and no result.
. "$(dirname "$0")/common.sh"
unset OPENBLAS_NUM_THREADS OMP_NUM_THREADS

tiny_sample whole
"$build_dir/bin/tacipc" set configs/press/default.yaml +newton.linear_solver=direct > direct.yaml
press() { # press OUT CONFIG [COMMAND …]: with a command in front
  local out=$1 config=$2
  shift 2
  "$@" "$build_dir/bin/press" --log-level warning --out "$out" --config "$config" --sensor configs/sensors/mctac.yaml --sample whole/sample/pyramid/sample.yaml \
    --gel whole/gels/mctac-tiny/gel.msh --object whole/sample/pyramid/object/object.ply --object-config whole/sample/pyramid/object.yaml
}
for solver in default direct; do
  config=$([ $solver = direct ] && echo direct.yaml || echo configs/press/default.yaml)
  press enough/$solver "$config"
  codes=
  for megabytes in 60 70 80 90 100 120 140 160 180 200 220 240 260 280 400; do
    rm -rf little
    mkdir little
    code=0
    (ulimit -v $((megabytes * 1000)) && press little/$solver "$config" timeout -s KILL 60) > said.txt 2>&1 || code=$?
    at="$solver on $megabytes MB"
    case $code in
      0) same_files enough/$solver little/$solver ;;
      1) grep -q '^press: error: out of memory' said.txt && [ "$(wc -l < said.txt)" = 1 ] || fail "$at: $(cat said.txt)" ;;
      127) grep -q 'error while loading shared libraries' said.txt || fail "$at: $(cat said.txt)" ;;
      130) grep -q '^OpenBLAS' said.txt || fail "$at: $(cat said.txt)" ;;  # before the program begins
      *) fail "$at: ended with $code: $(cat said.txt)" ;;
    esac
    [ $code = 0 ] || [ ! -e little/$solver/press.yaml ] || fail "$at: failed, and left a record"
    codes+=" $code"
  done
  [[ $codes = *" 0" ]] || fail "$solver: never enough:$codes"
  # The direct solver's BLAS needs 128 MiB at once.
  [ $solver = default ] || [[ $codes = *" 1 "* ]] || fail "$solver: always enough:$codes"
done
