#!/usr/bin/env bash
# The whole page of the paper's benchmark at reduced size, from one command: every part is there, with its pictures, and nothing is done a
# second time.
. "$(dirname "$0")/common.sh"
cp "$source_dir/configs/sensors/mctac.yaml" configs/sensors/ # tables are about images of its size
# The light of the photographs from fewer of their pixels and in fewer rounds: what is fitted and shown stays the same.
sed -i 's/^fit_stride_px: .*/fit_stride_px: 4/; s/^folds: .*/folds: 2/' configs/studies/sim2real/gelsight_sim2real/calibrate.yaml
mkdir docs
cp "$source_dir/docs/paper-results.md" docs/
shared=${TACIPC_SHARED:-$source_dir/../shared}
quick() { make -s -f Makefile.data paper-quick SHARED="$shared" OUT=out BUILD="$build_dir" PACKAGES=no REBUILD=no > log.txt 2>&1 || { tail -20 log.txt; fail "the goal failed"; }; }
quick
folder=out/paper-quick
page=$folder/paper-results.md
if [ -d "$shared" ]; then
  if grep -n 'Not made in this run\|Not run' $page; then fail "parts are missing"; fi
  grep -q '^| Tacchi, as published' $page || fail "no markers by Tacchi"
fi
for row in '| TacIPC | 0' '| Tacchi | 0' '| depth-based | 0' '| uniform_0500um |' '| press: TacIPC' 'All runs in the folders of this page together: ' 'times with other settings): ' '| **TacIPC, a sample'; do
  grep -qF "$row" $page || { cat $page; fail "no row '$row'"; }
done
for record in "$folder"/objects/*/{depth-based,older_kernel}/legacy/baseline.yaml; do # 0.5 mm, and its width of float
  awk '/max_indentation_mm:/ { deep = $2 } END { exit !(deep > 0.3 && deep < 0.51) }' "$record" || fail "$record: the object is not as deep as it was pressed"
done
grep -o '(paper_results/[^)]*)' $page | tr -d '()' | sort -u > links.txt
[ "$(wc -l < links.txt)" -ge 4 ] || fail "too few pictures"
while read -r link; do [ -s "$folder/$link" ] || fail "$link is not there"; done < links.txt
grep -q '<table>' $folder/paper-results.html || fail "the page has no tables"
cmp docs/paper-results.md "$source_dir/docs/paper-results.md" || fail "the page of the documentation was changed"
before=$(find out -name '*.yaml' -printf '%p %T@\n' | sort)
quick
[ "$before" = "$(find out -name '*.yaml' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"
echo "1 passed, 0 failed"
