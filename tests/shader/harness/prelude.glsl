// The functions and macros for GLSL test files: TEST, the expectations, and random inputs. The harness inserts this
// file before a test file, and appends a main() that runs the selected test.
#ifndef DUOLUX_TESTS_SHADER_HARNESS_PRELUDE_GLSL
#define DUOLUX_TESTS_SHADER_HARNESS_PRELUDE_GLSL

#include "tests/shader/harness/random.glsl"
#include "tests/shader/harness/report_layout.h"

layout(local_size_x = kTestWorkgroup) in;
layout(constant_id = kSpecTest) const uint kTest = 0u;
layout(binding = kBindingExpectations, scalar) buffer ExpectationsBlock { Expectation expectations[]; };
layout(binding = kBindingInvocations, scalar) buffer InvocationsBlock { uint failedInvocations[]; };
layout(push_constant, scalar) uniform DispatchBlock { TestDispatch testDispatch; };

// A test runs in 4096 invocations, or in as many as TEST_N specifies. Each invocation draws its own random inputs.
#define TEST(name) void test_##name()
#define TEST_N(name, count) void test_##name()

// Arguments are float and vec2 to vec4; comparisons of order also take uint to uvec4; EXPECT_EQ and EXPECT_NE
// also take bool, int and their vectors. Both must have the same number of components, and every component
// counts.
#define EXPECT_TRUE(condition) expectEqual_(__LINE__, value_(condition), value_(true))
#define EXPECT_FALSE(condition) expectEqual_(__LINE__, value_(condition), value_(false))
#define EXPECT_EQ(actual, expected) expectEqual_(__LINE__, value_(actual), value_(expected))
#define EXPECT_NE(actual, other) expectDifferent_(__LINE__, value_(actual), value_(other))
#define EXPECT_NEAR(actual, expected, tolerance) expectNear_(__LINE__, value_(actual), value_(expected), tolerance)
#define EXPECT_ULP(actual, expected, ulps) expectUlp_(__LINE__, value_(actual), value_(expected), float(ulps))
#define EXPECT_LT(actual, bound) expectBelow_(__LINE__, value_(actual), value_(bound), true)
#define EXPECT_LE(actual, bound) expectBelow_(__LINE__, value_(actual), value_(bound), false)
#define EXPECT_GT(actual, bound) expectAbove_(__LINE__, value_(actual), value_(bound), true)
#define EXPECT_GE(actual, bound) expectAbove_(__LINE__, value_(actual), value_(bound), false)

// If anything fails, shows a value of the first failing invocation, for example an input of an expectation.
#define NOTE(shown) note_(__LINE__, value_(shown))

uint testIndex() { return testDispatch.firstInvocation + gl_GlobalInvocationID.x; }
uint testCount() { return testDispatch.count; }

// Values of the types that expectations take.
struct BoolValue_ { uvec4 v; uint components; };
struct IntValue_ { ivec4 v; uint components; };
struct UintValue_ { uvec4 v; uint components; };
struct FloatValue_ { vec4 v; uint components; };
BoolValue_ value_(bool a) { return BoolValue_(uvec4(a ? 1u : 0u, 0u, 0u, 0u), 1u); }
BoolValue_ value_(bvec2 a) { return BoolValue_(uvec4(uvec2(a), 0u, 0u), 2u); }
BoolValue_ value_(bvec3 a) { return BoolValue_(uvec4(uvec3(a), 0u), 3u); }
BoolValue_ value_(bvec4 a) { return BoolValue_(uvec4(a), 4u); }
IntValue_ value_(int a) { return IntValue_(ivec4(a, 0, 0, 0), 1u); }
IntValue_ value_(ivec2 a) { return IntValue_(ivec4(a, 0, 0), 2u); }
IntValue_ value_(ivec3 a) { return IntValue_(ivec4(a, 0), 3u); }
IntValue_ value_(ivec4 a) { return IntValue_(a, 4u); }
UintValue_ value_(uint a) { return UintValue_(uvec4(a, 0u, 0u, 0u), 1u); }
UintValue_ value_(uvec2 a) { return UintValue_(uvec4(a, 0u, 0u), 2u); }
UintValue_ value_(uvec3 a) { return UintValue_(uvec4(a, 0u), 3u); }
UintValue_ value_(uvec4 a) { return UintValue_(a, 4u); }
FloatValue_ value_(float a) { return FloatValue_(vec4(a, 0.0, 0.0, 0.0), 1u); }
FloatValue_ value_(vec2 a) { return FloatValue_(vec4(a, 0.0, 0.0), 2u); }
FloatValue_ value_(vec3 a) { return FloatValue_(vec4(a, 0.0), 3u); }
FloatValue_ value_(vec4 a) { return FloatValue_(a, 4u); }

Evidence evidence_(uvec4 actual, uvec4 expected, uint type, uvec2 components, float difference, float allowed) {
    return Evidence(uint[4](actual.x, actual.y, actual.z, actual.w),
                    uint[4](expected.x, expected.y, expected.z, expected.w), type, components.x, components.y,
                    difference, allowed);
}

void note_(int line, uvec4 bits, uint type, uint components) {
    if (testDispatch.pass != kPassNotes || testIndex() != testDispatch.noted || line >= expectations.length()) return;
    expectations[line].firstSeen = evidence_(bits, bits, type, uvec2(components), 0.0, 0.0);
}
void note_(int line, BoolValue_ a) { note_(line, a.v, kValueBool, a.components); }
void note_(int line, IntValue_ a) { note_(line, uvec4(a.v), kValueInt, a.components); }
void note_(int line, UintValue_ a) { note_(line, a.v, kValueUint, a.components); }
void note_(int line, FloatValue_ a) { note_(line, floatBitsToUint(a.v), kValueFloat, a.components); }

// Tests the bits, because the result of comparisons with NaN depends on the driver.
bool isNotANumber_(float a) { return (floatBitsToUint(a) & 0x7fffffffu) > 0x7f800000u; }

// The difference must be non-negative or NaN.
void expectation_(int line, bool ok, Evidence seen) {
    line = line < expectations.length() ? line : 0;
    ok = ok && seen.components == seen.expectedComponents;
    uint invocation = testIndex();
    bool nan = isNotANumber_(seen.difference);
    uint bits = nan ? 0x7fffffffu : floatBitsToUint(seen.difference);
    if (testDispatch.pass == kPassCount) {
        atomicAdd(expectations[line].evaluated, 1u);
        if (!ok) {
            float ratio = seen.difference / (seen.allowed > 0.0 ? seen.allowed : 1.0);
            int octave = int(floatBitsToUint(ratio) >> 23u) - 127;
            uint bin = nan ? kCensusNaN : uint(clamp(octave, 0, int(kCensusOpen)));
            atomicAdd(expectations[line].failed, 1u);
            atomicAdd(expectations[line].census[bin], 1u);
            atomicMax(expectations[line].first, ~invocation);
            atomicMax(expectations[line].worst, bits);
            atomicOr(failedInvocations[invocation >> 5u], 1u << (invocation & 31u));
        }
    } else if (!ok && testDispatch.pass == kPassFirst) {
        // In a loop, only the first failure.
        bool first = ~invocation == expectations[line].first && expectations[line].firstSeen.components == 0u;
        if (first) expectations[line].firstSeen = seen;
        if (bits == expectations[line].worst) atomicMax(expectations[line].worstAt, ~invocation);
    } else if (testDispatch.pass == kPassWorst && !ok && ~invocation == expectations[line].worstAt &&
               bits == expectations[line].worst) {
        expectations[line].worstSeen = seen;
    }
}

float largest_(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Differences are 0 for equal values, including infinities, and NaN if either value is NaN.
float difference_(float a, float b) {
    if (isNotANumber_(a) || isNotANumber_(b)) return uintBitsToFloat(0x7fc00000u);
    return a == b ? 0.0 : abs(a - b);
}

// In units in the last place: the number of floats between the values.
float ulps_(float a, float b) {
    if (isNotANumber_(a) || isNotANumber_(b)) return uintBitsToFloat(0x7fc00000u);
    uint x = floatBitsToUint(a);
    uint y = floatBitsToUint(b);
    uint magnitudeX = x & 0x7fffffffu;
    uint magnitudeY = y & 0x7fffffffu;
    bool sameSign = ((x ^ y) >> 31u) == 0u;
    return float(sameSign ? max(magnitudeX, magnitudeY) - min(magnitudeX, magnitudeY) : magnitudeX + magnitudeY);
}

// The largest component; NaN if any component is NaN.
float largestOf_(vec4 d) {
    bool nan = isNotANumber_(d.x) || isNotANumber_(d.y) || isNotANumber_(d.z) || isNotANumber_(d.w);
    return nan ? uintBitsToFloat(0x7fc00000u) : largest_(d);
}

vec4 ulps_(vec4 a, vec4 b) { return vec4(ulps_(a.x, b.x), ulps_(a.y, b.y), ulps_(a.z, b.z), ulps_(a.w, b.w)); }

float wordDifference_(uvec4 a, uvec4 b) {
    uvec4 d = max(a, b) - min(a, b);
    return float(max(max(d.x, d.y), max(d.z, d.w)));
}

void expectEqual_(int line, BoolValue_ a, BoolValue_ b) {
    uvec2 components = uvec2(a.components, b.components);
    expectation_(line, a.v == b.v, evidence_(a.v, b.v, kValueBool, components, wordDifference_(a.v, b.v), 0.0));
}
void expectEqual_(int line, IntValue_ a, IntValue_ b) {
    float off = wordDifference_(uvec4(a.v) ^ 0x80000000u, uvec4(b.v) ^ 0x80000000u);
    expectation_(line, a.v == b.v,
                 evidence_(uvec4(a.v), uvec4(b.v), kValueInt, uvec2(a.components, b.components), off, 0.0));
}
void expectEqual_(int line, UintValue_ a, UintValue_ b) {
    uvec2 components = uvec2(a.components, b.components);
    expectation_(line, a.v == b.v, evidence_(a.v, b.v, kValueUint, components, wordDifference_(a.v, b.v), 0.0));
}

Evidence floatEvidence_(FloatValue_ a, FloatValue_ b, float off, float allowed) {
    return evidence_(floatBitsToUint(a.v), floatBitsToUint(b.v), kValueFloat, uvec2(a.components, b.components), off,
                     allowed);
}
void expectUlp_(int line, FloatValue_ a, FloatValue_ b, float allowed) {
    float off = largestOf_(ulps_(a.v, b.v));
    expectation_(line, !isNotANumber_(off) && off <= allowed, floatEvidence_(a, b, off, allowed));
}
void expectEqual_(int line, FloatValue_ a, FloatValue_ b) { expectUlp_(line, a, b, 0.0); }
void expectNear_(int line, FloatValue_ a, FloatValue_ b, float allowed) {
    float off = largestOf_(vec4(difference_(a.v.x, b.v.x), difference_(a.v.y, b.v.y), difference_(a.v.z, b.v.z),
                               difference_(a.v.w, b.v.w)));
    expectation_(line, !isNotANumber_(off) && off <= allowed, floatEvidence_(a, b, off, allowed));
}

void expectDifferent_(int line, BoolValue_ a, BoolValue_ b) {
    expectation_(line, a.v != b.v, evidence_(a.v, b.v, kValueBool, uvec2(a.components, b.components), 0.0, 0.0));
}
void expectDifferent_(int line, IntValue_ a, IntValue_ b) {
    expectation_(line, a.v != b.v,
                 evidence_(uvec4(a.v), uvec4(b.v), kValueInt, uvec2(a.components, b.components), 0.0, 0.0));
}
void expectDifferent_(int line, UintValue_ a, UintValue_ b) {
    expectation_(line, a.v != b.v, evidence_(a.v, b.v, kValueUint, uvec2(a.components, b.components), 0.0, 0.0));
}
void expectDifferent_(int line, FloatValue_ a, FloatValue_ b) {
    float off = largestOf_(ulps_(a.v, b.v));
    expectation_(line, isNotANumber_(off) || off != 0.0, floatEvidence_(a, b, off, 0.0));
}

// Expects every component of `lower` below that of `upper` (or equal, unless strict). The difference is the
// excess.
void expectOrder_(int line, FloatValue_ lower, FloatValue_ upper, bool strict, Evidence seen) {
    bool ok = true;
    vec4 off = vec4(0.0);
    for (uint i = 0u; i < lower.components; i++) {
        off[i] = difference_(lower.v[i], upper.v[i]);
        bool ordered = strict ? lower.v[i] < upper.v[i] : lower.v[i] <= upper.v[i];
        ok = ok && ordered && !isNotANumber_(off[i]);
        off[i] = ordered ? 0.0 : off[i];
    }
    seen.difference = largestOf_(off);
    expectation_(line, ok, seen);
}
void expectBelow_(int line, FloatValue_ a, FloatValue_ b, bool strict) {
    expectOrder_(line, a, b, strict, floatEvidence_(a, b, 0.0, 0.0));
}
void expectAbove_(int line, FloatValue_ a, FloatValue_ b, bool strict) {
    expectOrder_(line, b, a, strict, floatEvidence_(a, b, 0.0, 0.0));
}
void expectWordsInOrder_(int line, uvec4 lower, uvec4 upper, uint components, bool strict, Evidence seen) {
    bool ok = true;
    for (uint i = 0u; i < components; i++) {
        ok = ok && (strict ? lower[i] < upper[i] : lower[i] <= upper[i]);
        seen.difference = max(seen.difference, lower[i] > upper[i] ? float(lower[i] - upper[i]) : 0.0);
    }
    expectation_(line, ok, seen);
}
void expectBelow_(int line, UintValue_ a, UintValue_ b, bool strict) {
    Evidence seen = evidence_(a.v, b.v, kValueUint, uvec2(a.components, b.components), 0.0, 0.0);
    expectWordsInOrder_(line, a.v, b.v, a.components, strict, seen);
}
void expectAbove_(int line, UintValue_ a, UintValue_ b, bool strict) {
    Evidence seen = evidence_(a.v, b.v, kValueUint, uvec2(a.components, b.components), 0.0, 0.0);
    expectWordsInOrder_(line, b.v, a.v, a.components, strict, seen);
}

#endif
