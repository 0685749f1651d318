#!/usr/bin/env bash
# showcase.sh DATASET TACIPC DOCS: writes docs/showcase.md, a row per object and a column per sensor, with its pictures.
# shellcheck disable=SC2016  # backquotes of the page
set -euo pipefail
dataset=$1 tacipc=$2 docs=$3
rm -rf "$docs/showcase"
mkdir -p "$docs/showcase"
declare -A folders
sensors=() objects=()
while IFS=$'\t' read -r folder sensor object; do
  folders[$sensor,$object]=$folder
  [[ " ${sensors[*]} " == *" $sensor "* ]] || sensors+=("$sensor")
  [[ " ${objects[*]} " == *" $object "* ]] || objects+=("$object")
done < <("$tacipc" table "$dataset/plan/samples.csv" --columns folder,sensor,object)
# picture FOLDER NAME: path of a picture of a sample, drawn by dataset-report
picture() { echo "$dataset/report/pictures/${1##*/}/$2.jpg"; }
{
  cat << PAGE
# Twenty objects in four sensors

This page shows twenty objects pressed into the gels of four sensors, with tactile images and forces.

\`\`\`
make -f Makefile.data showcase
\`\`\`

Each object of \`configs/datasets/showcase.yaml\` is pressed 0.5 mm into the middle of each gel, with the shipped settings and the gel \`adaptive_0250um\`.
The number below each picture is the press force; the last column is the indentation in \`${sensors[0]}\`.
Nineteen objects are embossed coins; the nut is a mesh, \`configs/objects/meshes/hex_nut.obj\`.
[Sensors](sensors.md) lists the known and the guessed values of each sensor.

PAGE
  header='| Object |' rule='|---|'
  for sensor in "${sensors[@]}"; do header+=" \`$sensor\` |" rule+='---|'; done
  echo "$header Indentation |"
  echo "$rule---|"
  for object in "${objects[@]}"; do
    row="| $object |"
    for sensor in "${sensors[@]}"; do
      folder=${folders[$sensor,$object]} file=showcase/$sensor-$object.jpg
      cp "$(picture "$folder" tactile)" "$docs/$file"
      row+=" ![$object in $sensor]($file)<br>$(printf %.1f "$("$tacipc" get "$dataset/$folder/press/press.yaml" summary.press_force_n)") N |"
    done
    file=showcase/indentation-$object.jpg
    cp "$(picture "${folders[${sensors[0]},$object]}" indentation)" "$docs/$file"
    echo "$row ![indentation of $object]($file) |"
  done
} > "$docs/showcase.md.new"
mv "$docs/showcase.md.new" "$docs/showcase.md"
