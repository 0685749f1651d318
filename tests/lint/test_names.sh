#!/usr/bin/env bash
# A test is found beside its namesake: tests/<folder>/<unit>[_<what>]_test.cpp tests <folder>/<unit>.{h,cpp}, a group of such units
# (hdf5_test: hdf5_reader, hdf5_writer), or the folder itself (press_program_test in tests/stages/gel/press).
set -euo pipefail
cd "$1"
faults=0
while read -r test; do
  folder=$(dirname "${test#tests/}")
  name=$(basename "$test" _test.cpp)
  found=$(for unit in "$folder"/*.h "$folder"/*.cpp "tests/$folder"/*.h "$folder"; do
    unit=$(basename "${unit%.*}")
    if [[ "${name}_" = "${unit}_"* || "${unit}_" = "${name}_"* ]]; then echo "$unit"; fi
  done)
  if [ -z "$found" ]; then echo "$test: there is no $folder/$name.h or .cpp whose test this could be"; faults=1; fi
done < <(find tests -name '*_test.cpp' | LC_ALL=C sort)
exit $faults
