#!/usr/bin/env bash
# The goal paper-quick-markers on a ball and coarse gels: fragments with pictures, and nothing to do a second time.
. "$(dirname "$0")/common.sh"
quick() { make -s -f Makefile.data paper-quick-markers SHARED="$1" OUT=out BUILD="$build_dir" PACKAGES=no REBUILD=no > log.txt 2>&1 || { tail -20 log.txt; fail "the goal failed"; }; }
# Sensors without their fine markers and photographs without their vectors: only the ball.
quick no_such_folder
page=out/paper/markers/board3.md
for row in 'TacIPC' 'Tacchi, as published' 'Tacchi, true density'; do grep -q "^| $row | [0-9]" $page || { cat $page log.txt; fail "no row $row"; }; done
grep -q '^| Tacchi, as published | `object.samples_per_mm2` 6 (60) |' $page || { cat $page; fail "no row of the changed value"; }
grep -o '(paper_results/[^)]*)' $page | tr -d '()' > links.txt
[ "$(wc -l < links.txt)" = 4 ] || { cat $page; fail "not four pictures"; }
while read -r link; do [ -s "out/paper/markers/$link" ] || fail "$link is not there"; done < links.txt
grep -q 'Not run' out/paper/markers/fots.md || fail "without SHARED there are vectors"
before=$(find out -name '*.yaml' -printf '%p %T@\n' | sort)
quick no_such_folder
[ "$before" = "$(find out -name '*.yaml' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"
echo "1 passed, 0 failed"
