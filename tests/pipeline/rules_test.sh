#!/usr/bin/env bash
# The rules of the pipelines: the same in whatever order their files are read, with no variable used before it is defined; and pages of docs/
# with parts that are made.
. "$(dirname "$0")/common.sh"
count=0
listed() { make -s -f Makefile.data --eval='print-pipelines: ; @echo $(PIPELINES)' print-pipelines; }
plan() { # plan ORDER GOAL… [VARIABLE=value …]: what make would run
  local order=$1
  shift
  make -f Makefile.data -n "$@" PIPELINES="$order" OUT=out BUILD=none REBUILD=no PACKAGES=no SHARED=no_such_folder --warn-undefined-variables 2> said.txt |
    { grep -v PIPELINES= || true; }
  # Parameters that a call leaves away and variables of the command line are nothing that a file should define.
  ! grep 'undefined variable' said.txt | grep -vE "'([0-9]+|OBJECT|SAMPLE|CASE|DATASET|GROUPS)'" || fail "'make $*' reads a variable that nobody has defined"
}
order=$(listed)
reversed=$(tr ' ' '\n' <<< "$order" | tac | paste -sd ' ')
[ "$order" != "$reversed" ] || fail "there are no files to reverse: $order"
for goal in demo verification paper-coins 'paper-coins PAPER_KIND=quick' 'sample OBJECT=pyramid.stl MOTION=shear' 'sample OBJECT=pyramid.stl WRAP=0.1' 'mpm-sample OBJECT=pyramid.stl' \
  'export SAMPLE=out/demo/star' 'export SAMPLE=out/demo/star FORMAT=video' bench-page refinement 'stress N=2' 'campaign N=2' 'campaign-part N=2 PART=1 PARTS=2' docs-update; do
  read -ra words <<< "$goal"
  plan "$order" "${words[@]}" > one.txt
  plan "$reversed" "${words[@]}" > other.txt
  [ -s one.txt ] || fail "'make $goal' has nothing to do: $(cat said.txt)"
  cmp one.txt other.txt || { diff one.txt other.txt | head -20; fail "'make $goal' depends on the order of the files"; }
  count=$((count + 1))
done

# Parts of a page: filled, missing, and those of others kept.
fill() { bash pipelines/base/fill_page.sh page.md made/page.md "$@"; }
printf 'prose\n<!-- a -->\nold\n<!-- end of a -->\nmore\n<!-- b -->\n<!-- end of b -->\n' > page.md
touch -d '1 hour ago' page.md
printf 'new' > a.md
fill a=a.md
printf 'prose\n<!-- a -->\nnew\n<!-- end of a -->\nmore\n<!-- b -->\n<!-- end of b -->\n' | cmp - made/page.md || fail "a part is not filled"
fill b=no_such_file
printf 'prose\n<!-- a -->\nnew\n<!-- end of a -->\nmore\n<!-- b -->\nNot made in this run.\n<!-- end of b -->\n' | cmp - made/page.md || fail "a part that another goal filled is lost, or a missing one not said"
touch -d '1 hour' page.md
fill b=a.md
printf 'prose\n<!-- a -->\nold\n<!-- end of a -->\nmore\n<!-- b -->\nnew\n<!-- end of b -->\n' | cmp - made/page.md || fail "a newer template is not taken"
! fill c=a.md 2> said.txt || fail "a part without a place is taken"
grep -qx 'page.md: has no line <!-- c -->' said.txt || fail "a part without a place is not named: $(cat said.txt)"
# estimate reads the shipped cost model unless one was measured in OUT.
cost_model() { make -s -f Makefile.data --eval='print-model: ; @echo $(COST_MODEL)' print-model OUT=out; }
[ "$(cost_model)" = configs/studies/speed/cost_model.yaml ] || fail "the cost model is $(cost_model)"
mkdir -p out/bench/page
cp configs/studies/speed/cost_model.yaml out/bench/page
[ "$(cost_model)" = out/bench/page/cost_model.yaml ] || fail "the measured cost model is not taken: $(cost_model)"

# The page of the paper shows and counts what its own run made, not what other goals and earlier runs left beside it.
mkdir docs
cp "$source_dir/docs/paper-results.md" docs/
paper=out/paper-quick
mkdir -p $paper/parts/paper_results $paper/objects-table $paper/mine out/emboss/other $paper/real/gelsight_sim2real
echo 'of this run' > $paper/parts/objects.md
echo picture > $paper/parts/paper_results/objects.png
echo 'of an earlier run' | tee $paper/objects-table/table.md > $paper/real/gelsight_sim2real/table.md
echo 'processor_s: 720.04' > $paper/mine/press.timings.yaml
echo 'processor_s: 36000' > out/emboss/other/emboss.timings.yaml
printf '%s\n' $paper/mine $paper/not_made > $paper/parts/coins.folders
make -s -f Makefile.data paper-page PAPER_KIND=quick OUT=out BUILD="$build_dir" REBUILD=no PACKAGES=no SHARED=no_such_folder > log.txt 2>&1 || { cat log.txt; fail "no page of the paper"; }
part() { sed -n "/^<!-- $1 -->/,/^<!-- end of $1 -->/p" $paper/paper-results.md; }
grep -qx 'of this run' <<< "$(part objects)" || fail "the page lacks what this run made"
grep -qx 'Not made in this run.' <<< "$(part real)" || fail "the page shows what an earlier run made: $(part real)"
grep -q ' together: 0.2 processor hours' <<< "$(part cost)" || fail "the page counts other runs: $(part cost)"
[ "$(ls $paper/paper_results)" = objects.png ] || fail "the page has other pictures"
cmp docs/paper-results.md "$source_dir/docs/paper-results.md" || fail "docs/ was written"
# A finished stage is one line with its seconds and results; commands are shown with V=1; with -s there is neither.
embossed() { make -f Makefile.data out/emboss/dots/emboss.yaml OUT=out BUILD="$build_dir" REBUILD=no PACKAGES=no "$@" -B > said.txt 2>&1 || { cat said.txt; fail "emboss failed"; }; }
embossed
grep -qxE 'emboss +[0-9.]+ s  out/emboss/dots: vertices [0-9]+, relief_height_mm 0\.3' said.txt || fail "no line of the stage: $(cat said.txt)"
[ "$(wc -l < said.txt)" = 1 ] || fail "more than a line: $(cat said.txt)"
embossed V=1
grep -q '/emboss --out out/emboss/dots' said.txt || fail "V=1 shows no command: $(cat said.txt)"
embossed -s
[ ! -s said.txt ] || fail "said with -s: $(cat said.txt)"

# The log of a build: a line per tenth, and all that a compiler says.
{
  for i in $(seq 40); do printf '[%d/40] Building %d\n' "$i" "$i"; done
  printf 'a.cpp:3: error: wrong\nninja: no work to do.\n'
} | bash pipelines/base/build_lines.sh > said.txt
[ "$(grep -c '^build: [0-9]* of 40, [0-9]* s$' said.txt)" = 10 ] && [ "$(tail -1 said.txt)" = 'a.cpp:3: error: wrong' ] && [ "$(wc -l < said.txt)" = 11 ] ||
  fail "the log of a build: $(cat said.txt)"
echo "$((count + 15)) passed, 0 failed"
