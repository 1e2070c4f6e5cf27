#!/usr/bin/env bash
# library_test.sh CMAKE BUILD_DIR SOURCE_DIR COMPILER FLAGS: a program outside the tree finds the installed library, and
# renders the same bits as the installed program.
set -euo pipefail
cmake=$1 build=$2 source=$3 compiler=$4 flags=$5
work=$build/library_test
rm -rf "$work"
mkdir -p "$work"
fail() { echo "FAILED: $1" >&2 && exit 1; }

"$cmake" --install "$build" --prefix "$work/prefix" >"$work/install.log" || fail "cmake --install"
if grep -rqF "$source" "$work/prefix/lib/cmake" "$work/prefix/include"; then fail "the package names the source tree"; fi
for header in host/render/context.h host/film/codec.h host/base/memory.h host/vk/handles.h; do
  if [ -e "$work/prefix/include/duolux/$header" ]; then fail "$header, an internal header, is installed"; fi
done
"$cmake" -S "$source/tests/install" -B "$work/example" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="$flags" >"$work/configure.log" 2>&1 || { cat "$work/configure.log"; fail "find_package(duolux)"; }
"$cmake" --build "$work/example" >"$work/build.log" 2>&1 || { cat "$work/build.log"; fail "building the example"; }

scene=$source/assets/cornell/cornell.json
cd "$work/example"
./two_views "$scene" first.pfm second.pfm >two_views.log || fail "running the example"
# The back wall of the box faces the camera.
grep -qE '^first.pfm: radiance 0\.[0-9]+, normal -?0\.00 -?0\.00 -1\.00$' two_views.log || { cat two_views.log; fail "the normals"; }
"$work/prefix/bin/duolux" render "$scene" --device cpu --size 32x32 --spp 4 --quiet -o program_first.pfm
"$work/prefix/bin/duolux" render "$scene" --device cpu --size 32x32 --spp 4 --quiet --camera-position 178,273,-800 \
  -o program_second.pfm
cmp first.pfm program_first.pfm || fail "the first view"
cmp second.pfm program_second.pfm || fail "the second view"
if cmp -s first.pfm second.pfm; then fail "the views are the same"; fi
echo "the library renders as the program"
