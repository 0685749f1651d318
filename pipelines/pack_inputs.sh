#!/usr/bin/env bash
# What each shard of a dataset is packed from: pack_inputs.sh DATASET PROFILE writes DATASET/shards/<shard>.inputs where it is not there with
# these bytes already, and shards.mk with their names. Contents count, not times of plan and profile; of records their times do.
set -euo pipefail
export LC_ALL=C
dataset=$1 profile=$2
plan=$dataset/plan/samples.csv
for file in "$plan" "$dataset/plan/dataset.yaml" "$profile"; do
  [ -e "$file" ] || { echo "pack: there is no $file" >&2; exit 2; }
done
shards=$dataset/shards
mkdir -p "$shards"
new=$shards/.new-$$
rm -rf "$new"
mkdir "$new"
trap 'rm -rf "$new"' EXIT
common=$(sha256sum < "$dataset/plan/dataset.yaml" | cut -c1-64)$(sha256sum < "$profile" | cut -c1-64)

# A line per sample in the order of the plan, which fills one shard of each split after the other: three files are open at a time.
{ [ ! -d "$dataset/samples" ] || find "$dataset/samples" -mindepth 4 -maxdepth 4 \
  \( -name press.yaml -o -name press.failed.yaml -o -name render.yaml -o -name render.failed.yaml \) -printf '%P %T@\n'; } |
  awk -v plan="$plan" -v new="$new" -v common="$common" '
    { n = split($1, p, "/"); found[p[1] "/" p[2], p[n]] = $2 }
    END {
      while ((status = (getline line < plan)) > 0) {
        n = split(line, f, ",")
        if (!begun++) { for (i = 1; i <= n; ++i) at[f[i]] = i; continue }
        shard = f[at["shard"]]; split_of = f[at["split"]]
        if (open[split_of] != shard) {
          if (open[split_of] != "") close(new "/" open[split_of] ".inputs")
          open[split_of] = shard
          if (!(shard in known)) { known[shard] = 1; print common > (new "/" shard ".inputs"); names = names " " shard }
        }
        place = substr(f[at["folder"]], 9)
        print line, found[place, "press.yaml"], found[place, "press.failed.yaml"], found[place, "render.yaml"], found[place, "render.failed.yaml"] >> (new "/" shard ".inputs")
      }
      if (status < 0 || names == "") { print "pack: " plan " has no samples" > "/dev/stderr"; exit 1 }
      print "PACK_SHARDS :=" names > (new "/shards.mk")
    }'
for file in "$new"/*; do
  cmp -s "$file" "$shards/${file##*/}" || mv "$file" "$shards/${file##*/}"
done
