#!/usr/bin/env bash
# install_test.sh CMAKE BUILD_DIR SOURCE_DIR: the installed program works by itself, away from the source tree.
set -euo pipefail
cmake=$1 build=$2 source=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1" >&2 && exit 1; }

"$cmake" --install "$build" --prefix "$work/prefix" --strip >"$work/install.log" || fail "cmake --install"
duolux=$work/prefix/bin/duolux
[[ -x $duolux ]] || fail "there is no bin/duolux in the prefix"
# A sanitizer stores the names of source files in the program for its reports.
if grep -qa __asan_init "$duolux"; then source=/no/such/tree build=/no/such/tree; fi
if grep -qaF "$source" "$duolux"; then fail "the installed program names the source tree"; fi
if grep -qaF "$build" "$duolux"; then fail "the installed program names the build tree"; fi

mkdir "$work/elsewhere"
cd "$work/elsewhere"
"$duolux" --version | grep -qE '^duolux [0-9]+\.[0-9]+\.[0-9]+ \(.+\)$' || fail "--version"

cat >room.mtl <<EOF
newmtl wall
Kd 0.5 0.5 0.5
newmtl lamp
Kd 0 0 0
Ke 5 5 5
EOF
cat >room.obj <<EOF
mtllib room.mtl
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v -1 2 -1
v 1 2 -1
v 1 2 1
v -1 2 1
usemtl wall
f 4 3 2 1
usemtl lamp
f 5 6 7 8
EOF
"$duolux" render room.obj --device cpu --size 16x8 --spp 2 --quiet -o room.png -o room.exr || fail "render"
[[ $(head -c 4 room.png | tail -c 3) == PNG ]] || fail "room.png is no PNG"
[[ -s room.exr ]] || fail "room.exr is missing"
"$duolux" sheet -o sheet.png --label one --label two room.png room.png || fail "sheet"
[[ -s sheet.png ]] || fail "sheet.png is missing"
echo "the installed program works"
