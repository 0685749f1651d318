# The line of a finished stage, from its timings and its record: seconds, folder, the numbers of the summary named here (of another stage the first three).
# awk -f finished.awk FOLDER/STAGE.timings.yaml FOLDER/STAGE.yaml
BEGIN {
  wanted["emboss"] = "vertices relief_height_mm"
  wanted["decimate"] = "vertices faces"
  wanted["tetmesh"] = "vertices tets"
  wanted["press"] = "frames newton_iterations press_force_n"
  wanted["render"] = "max_indentation_mm clipped_fraction"
}
/^stage:/ { stage = $2 }
/^wall_s:/ { seconds = $2 }
/^[^ ]/ { in_summary = ($1 == "summary:") }
in_summary && /^  [a-z_0-9]+: [^ ]/ {
  key = substr($1, 1, length($1) - 1)
  sub(/^ *[^ ]* /, "")
  value[key] = /^-?[0-9]+[.][0-9e.+-]*$/ ? sprintf("%.4g", $0) : $0
  if (count < 3) first = first " " key
  ++count
}
END {
  n = split(stage in wanted ? wanted[stage] : first, keys, " ")
  for (i = 1; i <= n; ++i)
    if (keys[i] in value) text = text (text == "" ? ": " : ", ") keys[i] " " value[keys[i]]
  folder = FILENAME
  sub(/\/[^\/]*$/, "", folder)
  printf "%-9s %7.1f s  %s%s\n", stage, seconds, folder, text
}
