#!/usr/bin/env bash
# What each shard of a dataset is packed from: pack_inputs.sh DATASET PROFILE writes DATASET/shards/<shard>.inputs where it is not there with
# these bytes already, and shards.mk and shards.txt with their names; to be run by one at a time. Contents count, not times of plan and profile; of
# records their times do. Of dataset.yaml counts what all samples share: not how a run ends or when it stops, nor how shards are divided, which rows say.
set -euo pipefail
export LC_ALL=C
dataset=$1 profile=$2
plan=$dataset/plan/samples.csv
# A plan that is being made anew is waited for; one that was left half replaced has no record.
if [ -e "$dataset/plan/.lock-plan" ]; then
  flock -s -w 600 "$dataset/plan/.lock-plan" true || { echo "pack: the plan of $dataset is being made for ten minutes now" >&2; exit 1; }
  [ -e "$dataset/plan/plan.yaml" ] || { echo "pack: the plan of $dataset is half replaced; make it again: make -f Makefile.data plan CONFIG=..." >&2; exit 1; }
fi
for file in "$plan" "$dataset/plan/dataset.yaml" "$profile"; do
  [ -e "$file" ] || { echo "pack: there is no $file" >&2; exit 2; }
done
shards=$dataset/shards
mkdir -p "$shards"
new=$(mktemp -d "$shards/.new-XXXXXX")
trap 'rm -rf "$new"' EXIT
awk '/^[^ ]/ { skip = /^(outputs|stop_after_failures):/ } !skip' "$dataset/plan/dataset.yaml" > "$new/dataset.yaml"
common=$(sha256sum < "$new/dataset.yaml" | cut -c1-64)$(sha256sum < "$profile" | cut -c1-64)

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
          if (!(shard in known)) { known[shard] = 1; print common > (new "/" shard ".inputs"); names = names " " shard; print shard "/pack.yaml" > (new "/shards.txt") }
        }
        place = substr(f[at["folder"]], 9)
        print line, found[place, "press.yaml"], found[place, "press.failed.yaml"], found[place, "render.yaml"], found[place, "render.failed.yaml"] >> (new "/" shard ".inputs")
      }
      if (status < 0 || names == "") { print "pack: " plan " has no samples" > "/dev/stderr"; exit 1 }
      print "PACK_SHARDS :=" names > (new "/shards.mk")
    }'

# A shard of which the new packing was refused still is what it was packed from: where that has come back, it is not packed again.
changed=$({ diff -q "$new" "$shards" || [ $? = 1 ]; } | sed -n "s|^Files $new/\(.*\) and .* differ$|\1|p; s|^Only in $new: ||p")
for name in $changed; do printf '%s\0' "$new/$name"; done | xargs -0 -r mv -t "$shards"
for name in $changed; do
  record=$shards/${name%.inputs}/pack.yaml packed_from=$shards/${name%.inputs}/packed.inputs
  if [ -e "$record" ] && [ ! "$record" -nt "$packed_from" ] && cmp -s "$packed_from" "$shards/$name"; then touch -r "$record" "$shards/$name"; fi
done
