#!/usr/bin/env bash
# Who includes whom: the rooms of common/ in their order, stages nothing but common/, and the parts of press only inwards; and no source
# above 450 lines.
set -euo pipefail
cd "$1"
faults=0
complain() { # complain PATTERN WHERE REASON
  local hits
  hits=$(grep -rnE "#include \"$1" "$2" --include=*.h --include=*.cpp || true)
  [ -z "$hits" ] || { echo "$hits"; echo "  ^ $3"; faults=1; }
}
complain '(stages|verification|bench|tests)/' common 'common may not include what is built on it'
complain '(verification|bench|tests)/' stages 'a stage may not include a study or a test'
for stage in stages/*/*/; do
  name=${stage%/}
  hits=$(grep -rnoE '#include "stages/[a-z_]+/[a-z_]+/' "$stage" | grep -v "\"$name/\$" || true)
  [ -z "$hits" ] || { echo "$hits"; echo "  ^ a stage may not include another"; faults=1; }
done
# Each room of common/ may include those before it in this list.
later=""
for room in command optics benchmark sample rival sensor mesh image format stage config base; do
  [ -z "$later" ] || complain "common/($later)/" "common/$room" "$room comes before these in common/ (docs/design.md)"
  later="${later:+$later|}$room"
done
for folder in common/*/; do [[ "|$later|" = *"|$(basename "$folder")|"* ]] || { echo "$folder: not in the order of rooms"; faults=1; }; done
# Each room of press may include those before it in this list, and nothing else of press: contact is geometry only, energies know no solver,
# the solver knows no motion, a world knows no drive, a drive no files.
inner=""
for room in contact energy solve measure world drive files; do
  inner="${inner:+$inner|}$room"
  hits=$(grep -rnE '#include "stages/gel/press/' "stages/gel/press/$room" | grep -vE "\"stages/gel/press/($inner)/" || true)
  [ -z "$hits" ] || { echo "$hits"; echo "  ^ press/$room may include only press/($inner)"; faults=1; }
done
for folder in stages/gel/press/*/; do
  [[ "|$inner|" = *"|$(basename "$folder")|"* ]] || { echo "$folder: not in the order of the rooms of press"; faults=1; }
done
# No two units of press include each other.
mutual=$(grep -rnoE '#include "stages/gel/press/[a-z_/]+\.h"' stages/gel/press | sed -E 's/^([^:]+)\.(h|cpp):[0-9]+:#include "([^"]+)\.h"$/\1 \3/' |
  awk '$1 != $2 { if (($2, $1) in seen) print $1, "and", $2; seen[$1, $2] }' | sort -u)
[ -z "$mutual" ] || { echo "$mutual"; echo "  ^ these units include each other"; faults=1; }
for header in tetgen.h embree3/ OpenMesh/ cholmod.h CGAL/ opencv2/ yaml-cpp/ hdf5.h libdeflate.h archive.h draco/ pugixml.hpp nlohmann/ openssl/ Imath/ zlib.h png.h \
  turbojpeg.h onnx/ ceres/ Imf; do
  files=$(grep -rlE "#include <$header" common stages --include=*.cpp --include=*.h || true)
  # What derives from a class of OpenMesh shows it.
  bad=$(grep -E '\.h$' <<<"$files" | grep -vx stages/object/decimate/collapse_mesh.h || true)
  [ -z "$bad" ] || { echo "$bad: includes <$header>; only a .cpp may"; faults=1; }
done
# libtorch is one stage's business, headers too.
bad=$(grep -rlE '#include <(torch|ATen|c10)/' common stages --include=*.cpp --include=*.h | grep -v '^stages/image/depthnet/' || true)
[ -z "$bad" ] || { echo "$bad: includes libtorch; only depthnet may"; faults=1; }
# Its files are programs: none is read.
bad=$(grep -rnE 'jit::load|pickle_load|torch::load|InputArchive|torch/serialize' common stages --include=*.cpp --include=*.h || true)
[ -z "$bad" ] || { echo "$bad"; echo "  ^ reads a file of libtorch, which is a program"; faults=1; }
# MuJoCo is one stage's business, too.
bad=$(grep -rlE '#include <mujoco/' common stages --include=*.cpp --include=*.h | grep -v '^stages/robot/robot/' || true)
[ -z "$bad" ] || { echo "$bad: includes MuJoCo; only robot may"; faults=1; }
while read -r lines file; do
  [ "$file" = total ] || [ "$lines" -le 450 ] || { echo "$file: $lines lines, at most 450: cut it where it changes the subject"; faults=1; }
done < <(find common stages verification bench \( -name '*.h' -o -name '*.cpp' \) -exec wc -l {} +)
# Arrays between stages are named where they are declared.
owners='^(common/sample/|stages/gel/export/surface_arrays\.cpp|stages/image/(calibrate/rival_mode\.cpp|track/track_arrays\.h))'
bad=$(grep -rnE '"[a-z_/]*[a-z_]\.npy"' common stages verification bench --include=*.cpp --include=*.h | grep -vE "$owners" || true)
[ -z "$bad" ] || { echo "$bad"; echo "  ^ an array is declared in a unit of common/sample, not named by others"; faults=1; }
exit $faults
