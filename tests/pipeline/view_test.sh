#!/usr/bin/env bash
# The 3-D view beside a sample's report: its data are those of the press, two runs give the same bytes, and a browser shows it.
# Screenshots stay in the build folder. Arguments: SOURCE_DIR BUILD_DIR
. "$(dirname "$0")/common.sh"

tiny_sample one MOTION=shear MOVE_STEPS=2 SHEAR_MM=0.8 FRICTION=0.4
sample=one/sample/pyramid
# Debian's Python, which has numpy.
/usr/bin/python3 "$source_dir/tests/pipeline/check_view.py" "$sample/report/view/sample-1.js" "$sample/press"
grep -q '<a href="view.html#sample-1">' "$sample/report/index.html" || fail "the page does not link the view"
grep -q '<script' "$sample/report/index.html" && fail "the page has a script"

again=$sample/again # from where links to the images are the same
"$build_dir/bin/report" --sample "$sample" --title pyramid --out "$again" --threads 1
same_files "$sample/report/view" "$again/view"
cmp "$sample/report/view.html" "$again/view.html" || fail "two runs give other pages"

# Without the gel there is no view, and nothing of an old one is left.
mv one/gels gels_elsewhere
"$build_dir/bin/report" --sample "$sample" --title pyramid --out "$again"
[ ! -e "$again/view" ] && [ ! -e "$again/view.html" ] || fail "a view of a gel that is not there"
grep -q 'view.html' "$again/index.html" && fail "the page links a view that is not there"

/usr/bin/python3 "$source_dir/tests/pipeline/browse_view.py" "$sample/report" "$build_dir/tests/pipeline/view_screenshots"
echo "1 passed, 0 failed"
