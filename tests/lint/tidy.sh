#!/usr/bin/env bash
# clang-tidy on C++ sources: tidy.sh SOURCES BUILD JOBS all|COMMIT
# Those that differ from COMMIT, and for a header one source that includes it. BUILD has the compiler's flags (compile_commands.json).
set -euo pipefail
sources=$1 build=$2 jobs=$3 since=$4
cd "$sources"
mapfile -t known < <(git ls-files '*.cpp')
if [ "$since" = all ]; then
  files=("${known[@]}")
else
  mapfile -t changed < <(git diff --name-only --diff-filter=d "$since" -- '*.cpp' '*.h')
  files=()
  for file in "${changed[@]}"; do
    case $file in
      *.cpp) files+=("$file") ;;
      *.h) # one source that shows the header to the compiler: its own, else any that includes it itself, if there is one
        own=${file%.h}.cpp
        if [ -e "$own" ]; then files+=("$own"); else files+=("$( (git grep -lF "#include \"$file\"" -- '*.cpp' || true) | sed -n 1p)"); fi ;;
    esac
  done
  mapfile -t files < <(printf '%s\n' "${files[@]}" | grep . | LC_ALL=C sort -u)
fi
# clang does not take libtorch's headers in C++20.
mapfile -t files < <(printf '%s\n' "${files[@]}" | grep -v '/image/depthnet/' | grep . || true)
echo "clang-tidy: ${#files[@]} of ${#known[@]} sources"
# Some of the compiler's options are GCC's alone.
[ "${#files[@]}" = 0 ] || printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$jobs" clang-tidy -p "$build" --quiet \
  --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-unused-command-line-argument 2>&1 |
  { grep -vE '^[0-9]+ warnings? generated|^Suppressed|^Use -header-filter' || true; }
