#!/usr/bin/env bash
# The goal `faults` on one chain: every stage of it is struck and bears it; and a stage that does not bear it is a find.
. "$(dirname "$0")/common.sh"
cp -r "$source_dir"/{tests,stages} .
faults() { make -s -f Makefile.data faults BUILD="$1" OUT="$2" PACKAGES=no REBUILD=no FAULTS=track_test; }
faults "$build_dir" held > table.txt 2>&1 || fail "a fault is not borne: $(cat table.txt held/faults/1/*/finds.txt)"
for stage in tetmesh press render track; do
  grep -q "^| \`$stage\` | " table.txt || fail "$stage is not struck: $(cat table.txt)"
done
grep -q ',press,damaged,held$' held/faults/1/track_test/injected.csv || grep -q ',render,damaged,held$' held/faults/1/track_test/injected.csv || fail "no damage was seen: $(cat table.txt)"

# A render that leaves a record where it fails.
mkdir -p hasty/bin
ln -s "$build_dir"/bin/* hasty/bin
rm hasty/bin/render
cat > hasty/bin/render <<END_OF_RENDER
#!/usr/bin/env bash
for ((i = 1; i < \$#; ++i)); do [ "\${!i}" != --out ] || { next=\$((i + 1)); out=\${!next}; }; done
$build_dir/bin/render "\$@" || { status=\$?; [ \$status = 3 ] || [ -z "\$out" ] || echo 'stage: render' > "\$out/render.yaml"; exit \$status; }
END_OF_RENDER
chmod +x hasty/bin/render
faults hasty not_held > table.txt 2>&1 && fail "a record over what failed is not found: $(cat table.txt)"
grep -q '^| `render` | .* | [1-9][0-9]* |$' table.txt || fail "the find is not in the table: $(cat table.txt)"
echo "1 passed, 0 failed"
