#!/usr/bin/env bash
# shader_dependencies_test.sh CMAKE CMAKE_MODULES: a change of a header rebuilds exactly the kernels that include it.
# Runs CompileShaders.cmake in a project of its own, so that the real build tree stays as it is.
set -euo pipefail
cmake=$1 modules=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1" >&2 && exit 1; }

mkdir -p "$work/shared"
cat >"$work/CMakeLists.txt" <<EOF
cmake_minimum_required(VERSION 3.25)
project(dependencies LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
list(APPEND CMAKE_MODULE_PATH "$modules")
include(CompileShaders)
add_executable(program main.cpp)
duolux_shader(program kernel kernel.comp)
duolux_shader(program variant kernel.comp DEFINES EXTRA=1)
duolux_shader(program other other.comp)
EOF
cat >"$work/main.cpp" <<'EOF'
#include <cstdint>
#include <cstdio>
#include <span>
namespace duolux::spirv {
extern const std::span<const std::uint32_t> kernel, variant, other;
}
int main() {
    using namespace duolux::spirv;
    for (auto words : {kernel, variant, other}) {
        std::uint32_t sum = 0;
        for (std::uint32_t word : words) sum = 31 * sum + word;
        std::printf("%08x %08x ", words[0], sum);
    }
}
EOF
cat >"$work/kernel.comp" <<'EOF'
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/outer.h"
layout(local_size_x = SIZE) in;
layout(set = 0, binding = 0) buffer Data { uint data[]; };
void main() {
    data[0] = 1;
#ifdef EXTRA
    data[1] = EXTRA;
#endif
}
EOF
cat >"$work/other.comp" <<'EOF'
#version 460
layout(local_size_x = 8) in;
void main() {}
EOF
echo '#include "shared/inner.h"' >"$work/shared/outer.h"
echo '#define SIZE 8' >"$work/shared/inner.h"

build() { "$cmake" --build "$work/build" >"$work/log" 2>&1 || { cat "$work/log" && fail "build: $1"; }; }
"$cmake" -S "$work" -B "$work/build" -G Ninja >"$work/log" 2>&1 || { cat "$work/log" && fail "configure"; }
build "the first time"
read -r magic kernel _ variant _ other <<<"$("$work/build/program")"
[[ $magic == 07230203 ]] || fail "the embedded words are not SPIR-V: $magic"
[[ $kernel != "$variant" ]] || fail "DEFINES change nothing"

build "with no change"
grep -q 'no work to do' "$work/log" || { cat "$work/log" && fail "a build with no change did something"; }

echo '#define SIZE 16' >"$work/shared/inner.h"
build "after a change of an included header"
if grep -q 'other\.spv' "$work/log"; then fail "a kernel that does not include the header was rebuilt"; fi
read -r _ kernel2 _ variant2 _ other2 <<<"$("$work/build/program")"
[[ $kernel2 != "$kernel" ]] || fail "the kernel was not rebuilt"
[[ $variant2 != "$variant" ]] || fail "the variant was not rebuilt"
[[ $other2 == "$other" ]] || fail "the other kernel changed"

echo '#error mistake' >"$work/shared/inner.h"
if "$cmake" --build "$work/build" >"$work/log" 2>&1; then fail "a mistake in a header went unnoticed"; fi
grep -q 'mistake' "$work/log" || fail "the message about a mistake does not show it"
echo "headers rebuild the kernels that include them"
