#!/usr/bin/env bash
# help lists every goal that has a `##` comment, once, below a title; a goal installs only the packages of its groups.
. "$(dirname "$0")/common.sh"

make -s -f Makefile.data help > help.txt || fail "help"
goals=$(cat Makefile.data pipelines/*/*.mk | grep -oE '^[a-z0-9-]+:.*## ' | cut -d: -f1)
for goal in $goals; do
  [ "$(grep -cE "^  $goal( |$)" help.txt)" = 1 ] || fail "$goal is not listed once"
done
[ "$(grep -c '^  ' help.txt)" = "$(wc -w <<< "$goals")" ] || fail "help lists what is no goal"
[ "$(sed -n 1p help.txt)" = "Start here" ] || fail "help begins with $(sed -n 1p help.txt)"
called=$(grep -hoE '(Makefile\.data|tacipc|tacipc\.sif) [a-z][a-z-]+( |$)|^CMD \["[a-z-]+' "$source_dir"/containers/* | sed 's/.*[ "]\([a-z]\)/\1/' | sort -u)
[ "$(wc -w <<< "$called")" -ge 3 ] || fail "the container files call no more than $called"
for goal in $called; do
  grep -qE "^  $goal( |$)" help.txt || fail "the container files call $goal, which is no goal"
done

# On a system without any package, where nothing is built either.
mkdir fake
printf '#!/bin/sh\nexit 1\n' > fake/dpkg-query
printf '#!/bin/sh\nexit 0\n' > fake/cmake
cp fake/cmake fake/ctest
chmod +x fake/*
missing() { # missing GOAL [VARIABLE=value …]: the packages that it asks for, before it fails for want of programs
  PATH=$PWD/fake:$PATH make -s -f Makefile.data "$@" PACKAGES=no BUILD=nothing OUT=none > said.txt 2>&1 || true
  sed -n 's/^packages: missing: //p' said.txt | tr ' ' '\n'
}
all_of() { for group in "$@"; do cat "packages/$group.txt"; done | LC_ALL=C sort -u; }
asks() { # asks "GROUPS" GOAL …
  local groups; read -ra groups <<< "$1"
  shift
  diff <(missing "$@" | LC_ALL=C sort) <(all_of "${groups[@]}") || fail "$* asks for other packages than those of ${groups[*]}"
}
asks "chain" demo
asks "chain tests" packages GROUPS=tests
asks "chain tests loaders wrap identify robot video depthnet predict" check
asks "chain tests loaders cluster pages wrap identify robot video depthnet predict" check-slow
asks "chain" sample OBJECT=pyramid.stl
asks "chain wrap" sample OBJECT=pyramid.stl WRAP=yes
asks "chain" export SAMPLE=none/sample/pyramid
asks "chain video" export SAMPLE=none/sample/pyramid FORMAT=video
mkdir -p none/datasets/a/{pack,shards}
touch none/datasets/a/pack/card.yaml
echo test-00000-of-00001/pack.yaml > none/datasets/a/shards/shards.txt
asks "chain depthnet predict" depthnet CONFIG=a.yaml
for net in default outcome; do  # of depth a second run judges; outcomes are judged where they are trained
  make -n -f Makefile.data depthnet CONFIG=a.yaml NET=$net OUT=none BUILD=nothing PACKAGES=no REBUILD=no > $net.txt || fail "NET=$net: $(cat $net.txt)"
  grep -q "depthnet --out none/datasets/a/depthnet/$net .*--config configs/depthnet/$net.yaml" $net.txt || fail "NET=$net trains nothing: $(cat $net.txt)"
done
grep -q -- --model default.txt && grep -q test/sheet.png default.txt || fail "nothing is judged: $(cat default.txt)"
! grep -q -- --model outcome.txt && grep -q depthnet/outcome/outcome.md outcome.txt || fail "outcomes: $(cat outcome.txt)"
for name in chromium-headless-shell python3-torch slurmd libgtest-dev libcgal-dev libmujoco-dev libtorch-dev libonnx-dev libavformat-dev; do
  ! grep -qx "$name" packages/chain.txt || fail "$name for everybody"
done
make -s -f Makefile.data packages GROUPS=gone 2> said.txt && fail "a group that is not there"
grep -q 'GROUPS: there is no packages/gone.txt (there are: ' said.txt || fail "said: $(cat said.txt)"
