#!/usr/bin/env bash
# What a planned dataset will cost: dataset_estimate.sh DATASET COST-MODEL. Core-hours and disk, from samples that are made where there are any
# (mean of their gel and motion), else from the cost model of press and what a pixel costs; a gel or motion without a made sample gets the
# model, scaled as the made ones were. Exit 1 if the disk has no room for the rest.
set -euo pipefail
export LC_ALL=C
dataset=$1 model=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Vertices of each gel and of its front; pixels of its sensor.
for record in "$dataset"/gels/*/tetmesh.yaml; do
  awk -v gel="$(basename "$(dirname "$record")")" '
    /^summary:/ { summary = 1 }
    $1 == "width_px:" { width = $2 }
    $1 == "height_px:" { height = $2 }
    $1 == "poissons_ratio:" { nu = $2 }
    summary && /^  vertices:/ { vertices = $2 }
    summary && /^  front:/ { front = 1; next }
    summary && front && $1 == "vertices:" { on_front = $2; front = 0 }
    END { print gel, vertices, on_front, width * height, nu }' "$record"
done > "$work/gels"

# Frames of a press, of what follows it, and phases of each motion: from a sample of it.
awk -F, 'NR > 1 && !seen[$9]++ { print $9, $11 }' "$dataset/plan/samples.csv" | while read -r motion folder; do
  awk -v motion="$motion" '
    match($0, /steps: [0-9]+/) { n = substr($0, RSTART + 7, RLENGTH - 7); if (/kind: press/) press += n; else moved += n }
    /kind: path/ { moved += 10 }
    END { print motion, press + 0, moved + 0 }' "$dataset/$folder/sample.yaml"
done > "$work/motions"
all=$(awk '/^  render:/ { r = 1 } /^frames: *all/ { a = 1 } END { print a + 0 }' "$(sed -n 's/^DATASET_RENDER := *//p' "$dataset/plan/dataset.mk")")

# Processor seconds and bytes of made samples, two hundred of them for the bytes.
find "$dataset/samples" -mindepth 4 -maxdepth 4 -name render.yaml -printf '%h\n' | sed 's|/render$||' | sort > "$work/made"
awk '{ print $0 "/press/press.timings.yaml"; print $0 "/render/render.timings.yaml" }' "$work/made" | xargs -r grep -H '^processor_s:' /dev/null |
  awk -F: '{ n = split($1, p, "/"); s[p[n - 2]] += $3 } END { for (id in s) print "cost", id, s[id] }' > "$work/measured"
awk -v n="$(wc -l < "$work/made")" '{ if (int(NR * 200 / n) != int((NR - 1) * 200 / n) || n <= 200) print }' "$work/made" |
  xargs -r du -sk | awk '{ n = split($2, p, "/"); print "bytes", p[n], 1024 * $1 }' >> "$work/measured"

awk -v all="$all" '
  FILENAME ~ /gels$/ { vertices[$1] = $2; front[$1] = $3; pixels[$1] = $4; nu[$1] = $5; next }
  FILENAME ~ /motions$/ { pressed[$1] = $2; moved[$1] = $3; next }
  FILENAME ~ /measured$/ { if ($1 == "cost") cost[$2] = $3; else bytes[$2] = $3; next }
  FILENAME == ARGV[4] { if ($1 ~ /^[a-z]/) c[substr($1, 1, length($1) - 1)] = $2; next }
  FNR > 1 {
    split($0, f, ",")
    group = f[6] "-" f[7] " " f[9]
    ++planned[group]
    if (f[1] in cost) { ++n[group]; sum[group] += cost[f[1]]; ++made }
    if (f[1] in bytes) { ++nb[group]; sumb[group] += bytes[f[1]] }
  }
  # Half of a third of the front touches, on average over a press; a pixel of a rendered frame takes 5 us.
  function modelled(gel, motion,    v, t, per, frames) {
    v = (vertices[gel] / 1000) ^ c["vertices_exponent"]
    t = (1 + front[gel] / 600) ^ c["contacts_exponent"]
    per = v * t * (nu[gel] >= 0.4 ? c["averaged_volume_factor"] : 1)
    frames = all ? pressed[motion] + moved[motion] + 1 : 2
    return per * (c["press_frame_s"] * pressed[motion] + c["motion_frame_s"] * moved[motion]) + 0.1 + 5e-6 * pixels[gel] * frames
  }
  function modelled_bytes(gel, motion,    frames) {
    frames = pressed[motion] + moved[motion] + 1
    return frames * (24 * vertices[gel] + 49 * front[gel] + 63000) + 53 * pixels[gel] * (all ? frames : 2)
  }
  END {
    for (g in n) {
      split(g, k, " ")
      measured_sum += sum[g]; model_sum += n[g] * modelled(k[1], k[2])
      measured_bytes += sumb[g]; model_bytes += nb[g] * modelled_bytes(k[1], k[2])
    }
    ratio = model_sum > 0 ? measured_sum / model_sum : 1
    ratio_bytes = model_bytes > 0 ? measured_bytes / model_bytes : 1
    for (g in planned) {
      split(g, k, " ")
      each = n[g] ? sum[g] / n[g] : ratio * modelled(k[1], k[2])
      each_bytes = nb[g] ? sumb[g] / nb[g] : ratio_bytes * modelled_bytes(k[1], k[2])
      seconds += planned[g] * each
      disk += planned[g] * each_bytes
      disk_left += (planned[g] - n[g]) * each_bytes
      samples += planned[g]
      unmeasured += n[g] ? 0 : planned[g]
    }
    printf "%d %d %d %.6g %.6g %.6g %.6g\n", samples, made, unmeasured, seconds, measured_sum, disk, disk_left
  }' "$work/gels" "$work/motions" "$work/measured" "$model" "$dataset/plan/samples.csv" > "$work/result"

read -r samples made unmeasured seconds spent disk left < "$work/result"
awk -v name="$(basename "$dataset")" -v samples="$samples" -v made="$made" -v unmeasured="$unmeasured" -v s="$seconds" -v spent="$spent" -v disk="$disk" 'BEGIN {
  printf "%s: %d samples: %.3g core-hours (%.3g s a sample), %.3g GB on disk\n", name, samples, s / 3600, s / samples, disk / 1e9
  if (made == 0) print "  by the cost model alone, within a factor of three or so; PILOT=20 makes twenty samples first and measures"
  else printf "  measured on %d made samples, %.3g core-hours so far%s\n", made, spent / 3600, unmeasured ? sprintf("; %d samples of other motions or gels by the cost model", unmeasured) : ""
}'
free=$(df -P -B1 "$dataset" | awk 'NR == 2 { print $4 }')
awk -v left="$left" -v free="$free" 'BEGIN { if (left > free) { printf "  %.3g GB are still to come, but the disk has %.3g GB left\n", left / 1e9, free / 1e9 > "/dev/stderr"; exit 1 } }'
