#!/bin/bash
# pose.sh TACIPC ASKED DECIMATE SIDE TURN: prints the sample file ASKED with the object's SIDE (+x -x +y -y +z -z)
# pressed. The contact is at the side's position of most relief by the record DECIMATE, turned about z by TURN degrees
# (a quarter turn keeps the middle of the bounding box).
set -euo pipefail
tacipc=$1 asked=$2 decimate=$3 side=$4 turn=$5
sides=(+x -x +y -y +z -z)
for view in "${!sides[@]}"; do [ "${sides[view]}" != "$side" ] || break; done
place() { "$tacipc" get "$decimate" "summary.sides.views[$view].center_mm[$1]"; }
center=$(awk -v x="$(place 0)" -v y="$(place 1)" -v turn="$turn" \
  'BEGIN { for (; turn > 0; turn -= 90) { t = x; x = -y; y = t }; printf "[%.17g, %.17g]", x, y }')
"$tacipc" set "$asked" "+placement.face=$side" "placement.rotate_deg=$turn" "placement.center_mm=$center"
