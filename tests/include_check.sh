#!/usr/bin/env bash
# Who includes whom: stages share nothing but common/, and the parts of press only look inwards.
set -euo pipefail
cd "$1"
faults=0
complain() { # complain PATTERN WHERE REASON
  local hits
  hits=$(grep -rnE "#include \"$1" $2 --include=*.h --include=*.cpp || true)
  [ -z "$hits" ] || { echo "$hits"; echo "  ^ $3"; faults=1; }
}
complain 'stages/' common 'common may not include a stage'
hits=$(grep -nE '#include "common/optics/' common/*.h common/*.cpp || true)
[ -z "$hits" ] || { echo "$hits"; echo '  ^ what has no pictures may not need Embree'; faults=1; }
for stage in stages/*/; do
  name=$(basename "$stage")
  hits=$(grep -rnoE '#include "stages/[a-z_]+/' "$stage" | grep -v "stages/$name/\$" || true)
  [ -z "$hits" ] || { echo "$hits"; echo "  ^ a stage may not include another"; faults=1; }
done
complain 'stages/press/(energy|solve|simulate|outputs)' stages/press/contact 'contact is geometry only'
complain 'stages/press/(solve|simulate|outputs)' stages/press/energy 'energies know no solver'
complain 'stages/press/(simulate|outputs|press_config)' stages/press/solve 'the solver knows no motion'
for header in tetgen.h embree3/ OpenMesh/ cholmod.h opencv2/ yaml-cpp/ hdf5.h archive.h ; do
  files=$(grep -rlE "#include <$header" common stages --include=*.cpp --include=*.h || true)
  bad=$(grep -E '\.h$' <<<"$files" || true)
  [ -z "$bad" ] || { echo "$bad: includes <$header>; only a .cpp may"; faults=1; }
done
exit $faults
