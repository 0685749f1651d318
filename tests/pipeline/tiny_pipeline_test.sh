#!/usr/bin/env bash
# The whole chain on a tiny gel: equal bytes with one and two threads, nothing to do a second time, and a changed
# configuration redoes what depends on it and nothing else.
. "$(dirname "$0")/common.sh"

tiny_sample one THREADS=1
tiny_sample two THREADS=2
same_files one two
for file in press/press.yaml render/render.yaml report/index.html report/contact_sheet.png; do
  [ -s "one/sample/pyramid/$file" ] || fail "$file is missing"
done
grep -q 'converged: true' one/sample/pyramid/press/press.yaml || fail "the press did not converge"

stamp() { find one -name '*.yaml' -printf '%p %T@\n' | sort; }
before=$(stamp)
tiny_sample one
[ "$before" = "$(stamp)" ] || fail "a second run did something"

sleep 1.1
touch configs/render/default.yaml
tiny_sample one
changed=$(comm -13 <(echo "$before") <(stamp) | cut -d' ' -f1 | xargs -n1 basename | sort | tr '\n' ' ')
[ "$changed" = "render.yaml report.yaml " ] || fail "touching the render configuration redid: $changed"
same_files one two
echo "1 passed, 0 failed"
