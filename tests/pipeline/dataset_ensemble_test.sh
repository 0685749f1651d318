#!/usr/bin/env bash
# Samples pressed by members of an ensemble, too: deviations are those of the members' presses, equal bytes whole and in parts; a press that failed
# is told; without the ensemble all is as if there had been none.
. "$(dirname "$0")/common.sh"
python=/usr/bin/python3 # Debian's, which has the packages
sed -i 's/^vertices: .*/vertices: 3000/' configs/objects/patterns/star.yaml
sed -i 's/^material:/mount: {compliance_mm_per_n: 0, shear_compliance_mm_per_n: 0}\n&/' configs/sensors/mctac.yaml
sed -i 's/^ *material.poissons_ratio: 0.426$/&\n      mount.compliance_mm_per_n: 0.02/' configs/sensors/ensembles/mctac_guess.yaml
cp configs/datasets/tiny_ensemble.yaml configs/datasets/set.yaml
goal() { # goal OUT GOAL [VARIABLE=value …]
  local out=$1 goal=$2
  shift 2
  make -s -f Makefile.data "$goal" CONFIG=configs/datasets/set.yaml OUT="$out" BUILD="$build_dir" PACKAGES=no REBUILD=no "$@"
}
set_of() { echo "$1/datasets/set"; } # set_of OUT
check() { "$python" "$source_dir/tests/pipeline/check_ensemble.py" "$(set_of "$1")" 2 "${@:2}"; }
bytes() { (cd "$(set_of "$1")" && find ensemble* gels samples shards pack -type f -not -name '*.log' -not -name '*timings*' -not -name '.*' \
  -not -name '*.inputs' -not -name checksums.sha256 -not -name card.yaml -print0 | sort -z | xargs -0 md5sum); }

goal whole dataset JOBS=2 THREADS=1 > whole.txt 2>&1 || fail "the dataset is not made: $(tail -5 whole.txt)"
check whole || fail "deviations are not those of the members"
[ "$(find "$(set_of whole)/samples" -path '*/ensemble/*/press/press.yaml' | wc -l)" = 6 ] || fail "not every member and the nominal sensor have pressed"
grep -q 'Of these presses 4 by members are there; 0 presses are missing' "$(set_of whole)/pack/README.md" || fail "the card does not tell of the members"
grep -qF '| `ensemble/press_force_N_sigma` | float32 | (T) | N |' "$(set_of whole)/pack/README.md" || fail "the card does not describe the deviations"
grep -q '^  ensemble: 6 presses beside the samples made: 6 made, 0 failed, 0 left$' <<< "$(goal whole status)" || fail "the status does not count the members"
spent=$(find "$(set_of whole)/samples" -name '*.timings.yaml' -exec sed -n 's/^processor_s: //p' {} + | awk '{ s += $1 } END { printf "%.3g", s / 3600 }')
goal whole estimate > estimate.txt
grep -qF ": $spent core-hours" estimate.txt || fail "the estimate is not what the samples and members took, $spent core-hours: $(cat estimate.txt)"
before=$(bytes whole)
goal whole dataset > /dev/null 2>&1
[ "$before" = "$(bytes whole)" ] || fail "a second run did something"

goal parts dataset-shared > /dev/null 2>&1
for part in 1 0; do goal parts dataset-part PART=$part PARTS=2 THREADS=2 > part.txt 2>&1 || fail "a part is not made: $(cat part.txt)"; done
goal parts dataset-last > /dev/null 2>&1
[ "$before" = "$(bytes parts)" ] || fail "the parts are not the whole"
goal whole reproduce K=1 > again.txt 2>&1 || fail "a sample is not made again as it was: $(cat again.txt)"

# A member that fails: the sample is made, and says how many there are; made good later it is packed again.
first=$(cd "$(set_of whole)/samples/000" && echo *000000)
mv "$(set_of whole)/samples/000/$first/ensemble/m01/press/press.yaml" kept.yaml
printf 'stage: press\nmessage: did not converge\n' > "$(set_of whole)/samples/000/$first/ensemble/m01/press/press.failed.yaml"
goal whole dataset > whole.txt 2>&1 || fail "a member that failed is not left alone"
grep -q '6 presses beside the samples made: 5 made, 1 failed, 0 left$' whole.txt || fail "the run does not tell of the member: $(cat whole.txt)"
check whole "$first=m01" || fail "a missing member is not told"
grep -q '3 by members are there; 1 presses are missing' "$(set_of whole)/pack/README.md" || fail "the card does not tell that a member is missing"
goal whole retry > /dev/null 2>&1 || fail "the member is not tried again"
check whole || fail "the member that was made good does not count"

# Dropped with the presses of the samples, members leave their records; there is nothing to make again.
goal parts dataset > /dev/null 2>&1 || fail "a finished dataset is not left alone"
"$build_dir/bin/survey" drop "$(set_of parts)" press > /dev/null
[ -z "$(find "$(set_of parts)/samples" -name 'positions.npy')" ] || fail "arrays of dropped presses are there"
[ "$(find "$(set_of parts)/samples" -path '*/ensemble/*/press/press.yaml' | wc -l)" = 6 ] || fail "records of dropped members are gone"
packed=$(sha256sum "$(set_of parts)"/pack/shards/*.h5)
goal parts dataset > /dev/null 2>&1 || fail "a dropped dataset is not left alone"
[ -z "$(find "$(set_of parts)/samples" -name 'positions.npy')" ] || fail "dropped presses were made again"
[ "$packed" = "$(sha256sum "$(set_of parts)"/pack/shards/*.h5)" ] || fail "a dropped dataset was packed again"
goal parts clean-press > /dev/null
[ -z "$(find "$(set_of parts)/samples" -path '*/ensemble/*' -name 'press.yaml')" ] || fail "clean-press leaves presses of members"

# Wrong ensembles.
sed -i 's/members: 2/members: 9/' configs/datasets/set.yaml
refused 2 'set.yaml:5:' goal whole plan
grep -q 'ensemble.members: 9 are more than the 4 of the file' said.txt || fail "too many members: $(cat said.txt)"
sed -i 's/members: 9/members: 2/' configs/datasets/set.yaml
sed -i 's/^sensor: .*/sensor: ..\/digit.yaml/' configs/sensors/ensembles/mctac_guess.yaml
refused 2 'which is none of this dataset' goal whole plan

# Without it nothing is left of it.
sed -i '/^ensemble:/d' configs/datasets/set.yaml
goal whole dataset > /dev/null 2>&1
goal without dataset > /dev/null 2>&1
for what in shards pack; do
  diff -r --exclude='*.log' --exclude='*timings*' --exclude=checksums.sha256 --exclude=card.yaml --exclude='*.inputs' "$(set_of whole)/$what" "$(set_of without)/$what" || fail "$what still knows of the ensemble"
done
