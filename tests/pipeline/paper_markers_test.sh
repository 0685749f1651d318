#!/usr/bin/env bash
# The goal paper-quick-markers on a ball and coarse gels: fragments with pictures, nothing to do a second time, and a value changed in a
# configuration.
. "$(dirname "$0")/common.sh"
set_keys() { bash pipelines/set_keys.sh "$@"; }
set_keys configs/mpm/legacy_mctac.yaml > same.yaml
cmp same.yaml configs/mpm/legacy_mctac.yaml || fail "nothing changed is something changed"
printf '# kept\na:\n  x: 1 # one\n  y: 2\nb: 3\ng:\n  x: 5\n  y: 6\nc:\n  x: 4\n' > in.yaml
printf '# kept\na:\n  x: 9\n  z: 5\nb: 7\nc:\n  x: 4\nd: 1\ne:\n  f: [1, 2]\n' > expected.yaml
set_keys in.yaml a.x=9 a.y= a.z=5 b=7 g= d=1 'e.f=[1, 2]' > changed.yaml
diff expected.yaml changed.yaml || fail "values are not changed as said"
if set_keys in.yaml a.x 2> said.txt; then fail "a key without a value was accepted"; fi
grep -q 'a.x: say key=value' said.txt || fail "the refusal does not say why"

quick() { make -s -f Makefile.data paper-quick-markers SHARED="$1" OUT=out BUILD="$build_dir" PACKAGES=no REBUILD=no > log.txt 2>&1 || { tail -20 log.txt; fail "the goal failed"; }; }
# Sensors without their fine markers and photographs without their vectors: only the ball.
quick no_such_folder
page=out/paper/markers/board3.md
for row in 'TacIPC' 'Tacchi, as published' 'Tacchi, true density'; do grep -q "^| $row | [0-9]" $page || { cat $page log.txt; fail "no row $row"; }; done
grep -q '^| Tacchi, as published | `object.samples` 1000 (20000) |' $page || { cat $page; fail "no row of the changed value"; }
grep -o '(paper_results/[^)]*)' $page | tr -d '()' > links.txt
[ "$(wc -l < links.txt)" = 4 ] || { cat $page; fail "not four pictures"; }
while read -r link; do [ -s "out/paper/markers/$link" ] || fail "$link is not there"; done < links.txt
grep -q 'Not run' out/paper/markers/fots.md || fail "without SHARED there are vectors"
before=$(find out -name '*.yaml' -printf '%p %T@\n' | sort)
quick no_such_folder
[ "$before" = "$(find out -name '*.yaml' -printf '%p %T@\n' | sort)" ] || fail "a second run did something"
echo "1 passed, 0 failed"
