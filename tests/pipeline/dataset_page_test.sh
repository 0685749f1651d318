#!/usr/bin/env bash
# The pages that dataset_test.sh left behind, opened in a headless Chromium: desktop and phone, light and dark, with the keyboard.
# Screenshots stay beside them. Arguments: SOURCE_DIR BUILD_DIR
set -euo pipefail
pages=$2/tests/pipeline/dataset_pages
for set in failing dropped; do
  report=$pages/$set/report
  mapfile -t samples < <(cd "$report" && find samples -maxdepth 1 \( -name "*__star__down__*.html" -o -name "*__along__*.html" \) | LC_ALL=C sort | sed -n "1p;\$p")
  python3 "$1/tests/pipeline/browse_pages.py" "$report" "$pages/screenshots/$set" index.html list-001.html sheet-001.html "${samples[@]}"
done
echo "1 passed, 0 failed"
