#!/bin/bash
# paper_page.sh TEMPLATE FOLDER NAME=FRAGMENT...: fills the template (pipelines/base/fill_page.sh), and writes
# FOLDER/paper-results.md and paper-results.html.
set -euo pipefail
template=$1 folder=$2
shift 2
page=$folder/paper-results.md
bash pipelines/base/fill_page.sh "$template" "$page" "$@"
{
  cat <<'HEAD'
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>TacIPC: the paper's benchmark</title>
<style>
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 0 auto; padding: 1rem; }
table { border-collapse: collapse; display: block; overflow-x: auto; margin: 1rem 0; }
th, td { border: 1px solid #8886; padding: .25rem .6rem; text-align: right; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; }
img { max-width: 100%; height: auto; background: #fff; }
pre { overflow-x: auto; padding: .6rem; background: #8882; }
code { font-size: .92em; }
</style></head><body>
HEAD
  cmark-gfm -e table "$page"
  echo '</body></html>'
} > "$folder/paper-results.html.new"
mv "$folder/paper-results.html.new" "$folder/paper-results.html"
