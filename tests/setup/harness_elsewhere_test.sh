#!/usr/bin/env bash
# harness_elsewhere_test.sh CMAKE SOURCE_DIR: another project uses the harness as tests/README.md says.
set -euo pipefail
cmake=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1" >&2 && exit 1; }

cd "$work"
for part in tests/shader/harness tests/support host/vk host/base host/cli/temporary_folder.h shaders/shared/types.h; do
  mkdir -p "duolux/$(dirname $part)"
  cp -r "$source/$part" "duolux/$part"
done
# The CMakeLists.txt in that file.
sed -n '/^    cmake_minimum_required/,/^    duolux_discover_tests/s/^    //p' "$source/tests/README.md" >CMakeLists.txt
mkdir shaders shader_tests
cat >shaders/square.glsl <<EOF
float square(float x) { return x * x; }
EOF
cat >shader_tests/square_test.glsl <<EOF
#include "shaders/square.glsl"

TEST(IsNotNegative) {
    EXPECT_GE(square(randomFloat(-1.0, 1.0)), 0.0);
}

TEST(IsWrong) {
    EXPECT_EQ(square(3.0), 6.0);
}
EOF
"$cmake" -G Ninja -DCMAKE_UNITY_BUILD=ON -S . -B build >log 2>&1 || { cat log && fail "the project cannot be configured"; }
"$cmake" --build build >log 2>&1 || { cat log && fail "the project cannot be built"; }
ctest --test-dir build --output-on-failure >log 2>&1 && fail "a test that fails passes"
cat log
grep -q 'OK \] SquareGlsl.IsNotNegative' log || fail "a test that passes fails"
grep -q 'FAILED  \] SquareGlsl.IsWrong' log || fail "a test that fails passes"
# A new file needs no build, but CTest must list its suite.
sed 's/IsWrong/IsRenamed/' shader_tests/square_test.glsl >shader_tests/other_test.glsl
ctest --test-dir build --output-on-failure >log 2>&1 && fail "a test of a new file that fails passes"
grep -q 'FAILED  \] OtherGlsl.IsRenamed' log || fail "CTest does not know the new file"
rm shader_tests/other_test.glsl
build/shader_test --coverage coverage.txt >log && fail "a test that fails passes"
grep -q 'shader_tests/square_test.glsl:8: Failure' log || fail "the failure does not name its place"
grep -q 'shaders/square.glsl  *1 of  *1' coverage.txt || fail "there is no coverage of square"
