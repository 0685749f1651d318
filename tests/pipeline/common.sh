# shellcheck shell=bash
# Shared by the pipeline tests: a scratch copy of the pipelines beside the built executables.
# Arguments of every test: SOURCE_DIR BUILD_DIR
set -euo pipefail
source_dir=$1
build_dir=$2
# The copy lies in folders that are called like methods and outputs of the pipelines: nothing may be told by what a folder above is called.
scratch_root=$(mktemp -d)
trap 'rm -rf "$scratch_root"' EXIT
scratch=$scratch_root/tacipc/fine/out
mkdir -p "$scratch"
cp -r "$source_dir"/{Makefile.data,pipelines,configs,packages} "$scratch"
cd "$scratch"
unset MAKEFLAGS MFLAGS MAKELEVEL  # ctest itself may run under make

# A pyramid of 6 mm base and 2 mm height with its tip down, in millimetres, as ASCII STL.
write_pyramid() { # write_pyramid FILE
  awk 'BEGIN {
    split("0 0 0", t); n = split("3 3 2,-3 3 2,-3 -3 2,3 -3 2", c, ",");
    print "solid pyramid";
    for (i = 1; i <= 4; ++i) facet("0 0 0", c[i % 4 + 1], c[i]);
    facet(c[1], c[2], c[3]); facet(c[1], c[3], c[4]);
    print "endsolid";
  }
  function facet(a, b, d) { printf "facet normal 0 0 0\nouter loop\nvertex %s\nvertex %s\nvertex %s\nendloop\nendfacet\n", a, b, d }' > "$1"
}

# An L of bars with edges of so many millimetres, as ASCII STL.
write_l() { # write_l FILE EDGE_MM
  awk -v s="$2" 'BEGIN {
    split("0 0 0,3 0 0,3 1 0,1 1 0,1 2 0,0 2 0,0 0 1,3 0 1,3 1 1,1 1 1,1 2 1,0 2 1", v, ",")
    m = split("1 3 2,7 8 9,1 4 3,7 9 10,1 6 4,7 10 12,4 6 5,10 11 12,1 2 8,1 8 7,2 3 9,2 9 8,3 4 10,3 10 9,4 5 11,4 11 10,5 6 12,5 12 11,6 1 7,6 7 12", f, ",")
    print "solid l"
    for (i = 1; i <= m; ++i) {
      split(f[i], c, " ")
      print "facet normal 0 0 0\nouter loop"
      for (k = 1; k <= 3; ++k) { split(v[c[k]], x, " "); print "vertex " s * x[1], s * x[2], s * x[3] }
      print "endloop\nendfacet"
    }
    print "endsolid"
  }' > "$1"
}

# A small sample with the tiny gel and a small image; further make variables may follow.
tiny_sample() { # tiny_sample OUT [VARIABLE=value …]
  local out=$1
  shift
  make -s -f Makefile.data sample OBJECT=pyramid.stl MESH=tiny STEPS=2 DEPTH_MM=0.4 OUT="$out" BUILD="$build_dir" PACKAGES=no "$@"
}

fail() { echo "FAILED: $*" >&2; exit 1; }

refused() { # refused CODE MESSAGE COMMAND …: it ends with this code and says this; what it said stays in said.txt
  local code=$1 message=$2 got=0
  shift 2
  "$@" > said.txt 2>&1 || got=$?
  [ $got = "$code" ] || { tail -5 said.txt >&2; fail "$*: ended with $got instead of $code"; }
  grep -qF -- "$message" said.txt || { tail -5 said.txt >&2; fail "$*: not said: $message"; }
}

same_files() { # same_files A B: equal trees but for logs
  diff -r --exclude='*.log' --exclude='*.timings.yaml' "$1" "$2" || fail "$1 and $2 differ"
}

# A sensor with a small picture keeps the tests quick.
sed -i 's/width_px: 640/width_px: 64/; s/height_px: 480/height_px: 48/' configs/sensors/mctac.yaml
write_pyramid pyramid.stl
