// What every GLSL test file can use: TEST, the expectations, and random inputs. The harness puts it before the file, and
// a main() that runs the chosen test after it.
#ifndef DUOLUX_TESTS_SHADER_HARNESS_PRELUDE_GLSL
#define DUOLUX_TESTS_SHADER_HARNESS_PRELUDE_GLSL

#include "tests/shader/harness/random.glsl"
#include "tests/shader/harness/report_layout.h"

layout(local_size_x = kTestWorkgroup) in;
layout(constant_id = kSpecTest) const uint kTest = 0u;
layout(binding = kBindingExpectations, scalar) buffer ExpectationsBlock { Expectation expectations[]; };
layout(binding = kBindingInvocations, scalar) buffer InvocationsBlock { uint failedInvocations[]; };
layout(push_constant, scalar) uniform DispatchBlock { TestDispatch testDispatch; };

// A test runs once in each of 4096 invocations; TEST_N says how many. Each draws random inputs of its own.
#define TEST(name) void test_##name()
#define TEST_N(name, count) void test_##name()

// Arguments: float, vec2 to vec4; EXPECT_EQ and EXPECT_NE also bool, int, uint and their vectors. Every component counts.
#define EXPECT_TRUE(condition) expectEqual(__LINE__, value(condition), value(true))
#define EXPECT_FALSE(condition) expectEqual(__LINE__, value(condition), value(false))
#define EXPECT_EQ(actual, expected) expectEqual(__LINE__, value(actual), value(expected))
#define EXPECT_NE(actual, other) expectDifferent(__LINE__, value(actual), value(other))
#define EXPECT_NEAR(actual, expected, tolerance) expectNear(__LINE__, value(actual), value(expected), tolerance)
#define EXPECT_ULP(actual, expected, ulps) expectUlp(__LINE__, value(actual), value(expected), float(ulps))
#define EXPECT_LT(actual, bound) expectBelow(__LINE__, value(actual), value(bound), true)
#define EXPECT_LE(actual, bound) expectBelow(__LINE__, value(actual), value(bound), false)
#define EXPECT_GT(actual, bound) expectAbove(__LINE__, value(actual), value(bound), true)
#define EXPECT_GE(actual, bound) expectAbove(__LINE__, value(actual), value(bound), false)

uint testIndex() { return testDispatch.firstInvocation + gl_GlobalInvocationID.x; }
uint testCount() { return testDispatch.count; }

// A value of any type that expectations take.
struct BoolValue { uvec4 v; uint components; };
struct IntValue { ivec4 v; uint components; };
struct UintValue { uvec4 v; uint components; };
struct FloatValue { vec4 v; uint components; };
BoolValue value(bool a) { return BoolValue(uvec4(a ? 1u : 0u, 0u, 0u, 0u), 1u); }
BoolValue value(bvec2 a) { return BoolValue(uvec4(uvec2(a), 0u, 0u), 2u); }
BoolValue value(bvec3 a) { return BoolValue(uvec4(uvec3(a), 0u), 3u); }
BoolValue value(bvec4 a) { return BoolValue(uvec4(a), 4u); }
IntValue value(int a) { return IntValue(ivec4(a, 0, 0, 0), 1u); }
IntValue value(ivec2 a) { return IntValue(ivec4(a, 0, 0), 2u); }
IntValue value(ivec3 a) { return IntValue(ivec4(a, 0), 3u); }
IntValue value(ivec4 a) { return IntValue(a, 4u); }
UintValue value(uint a) { return UintValue(uvec4(a, 0u, 0u, 0u), 1u); }
UintValue value(uvec2 a) { return UintValue(uvec4(a, 0u, 0u), 2u); }
UintValue value(uvec3 a) { return UintValue(uvec4(a, 0u), 3u); }
UintValue value(uvec4 a) { return UintValue(a, 4u); }
FloatValue value(float a) { return FloatValue(vec4(a, 0.0, 0.0, 0.0), 1u); }
FloatValue value(vec2 a) { return FloatValue(vec4(a, 0.0, 0.0), 2u); }
FloatValue value(vec3 a) { return FloatValue(vec4(a, 0.0), 3u); }
FloatValue value(vec4 a) { return FloatValue(a, 4u); }

Evidence evidence(uvec4 actual, uvec4 expected, uint type, uint components, float difference, float allowed) {
    return Evidence(uint[4](actual.x, actual.y, actual.z, actual.w),
                    uint[4](expected.x, expected.y, expected.z, expected.w), type, components, difference, allowed);
}

// On the bits: what a driver makes of NaN in comparisons is its own affair.
bool isNotANumber(float a) { return (floatBitsToUint(a) & 0x7fffffffu) > 0x7f800000u; }

// The difference is not negative, or not a number. Line 0 stands for those of an included file that is longer.
void expectation(int line, bool ok, Evidence seen) {
    line = line < expectations.length() ? line : 0;
    uint invocation = testIndex();
    bool nan = isNotANumber(seen.difference);
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
        if (~invocation == expectations[line].first) expectations[line].firstSeen = seen;
        if (bits == expectations[line].worst) atomicMax(expectations[line].worstAt, ~invocation);
    } else if (!ok && ~invocation == expectations[line].worstAt && bits == expectations[line].worst) {
        expectations[line].worstSeen = seen;
    }
}

float largest(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Differences: of equal values 0, also of infinities; not a number if a component of either is not.
float difference(float a, float b) {
    if (isNotANumber(a) || isNotANumber(b)) return uintBitsToFloat(0x7fc00000u);
    return a == b ? 0.0 : abs(a - b);
}

// In units of the last place: how many floats further.
float ulps(float a, float b) {
    if (isNotANumber(a) || isNotANumber(b)) return uintBitsToFloat(0x7fc00000u);
    uint x = floatBitsToUint(a);
    uint y = floatBitsToUint(b);
    uint magnitudeX = x & 0x7fffffffu;
    uint magnitudeY = y & 0x7fffffffu;
    bool sameSign = ((x ^ y) >> 31u) == 0u;
    return float(sameSign ? max(magnitudeX, magnitudeY) - min(magnitudeX, magnitudeY) : magnitudeX + magnitudeY);
}

// Of the components the largest; one that is not a number outweighs all.
float largestOf(vec4 d) {
    bool nan = isNotANumber(d.x) || isNotANumber(d.y) || isNotANumber(d.z) || isNotANumber(d.w);
    return nan ? uintBitsToFloat(0x7fc00000u) : largest(d);
}

vec4 ulps(vec4 a, vec4 b) { return vec4(ulps(a.x, b.x), ulps(a.y, b.y), ulps(a.z, b.z), ulps(a.w, b.w)); }

float wordDifference(uvec4 a, uvec4 b) {
    uvec4 d = max(a, b) - min(a, b);
    return float(max(max(d.x, d.y), max(d.z, d.w)));
}

void expectEqual(int line, BoolValue a, BoolValue b) {
    expectation(line, a.v == b.v, evidence(a.v, b.v, kValueBool, a.components, wordDifference(a.v, b.v), 0.0));
}
void expectEqual(int line, IntValue a, IntValue b) {
    float off = wordDifference(uvec4(a.v) ^ 0x80000000u, uvec4(b.v) ^ 0x80000000u);
    expectation(line, a.v == b.v, evidence(uvec4(a.v), uvec4(b.v), kValueInt, a.components, off, 0.0));
}
void expectEqual(int line, UintValue a, UintValue b) {
    expectation(line, a.v == b.v, evidence(a.v, b.v, kValueUint, a.components, wordDifference(a.v, b.v), 0.0));
}

Evidence floatEvidence(FloatValue a, FloatValue b, float off, float allowed) {
    return evidence(floatBitsToUint(a.v), floatBitsToUint(b.v), kValueFloat, a.components, off, allowed);
}
void expectUlp(int line, FloatValue a, FloatValue b, float allowed) {
    float off = largestOf(ulps(a.v, b.v));
    expectation(line, !isNotANumber(off) && off <= allowed, floatEvidence(a, b, off, allowed));
}
void expectEqual(int line, FloatValue a, FloatValue b) { expectUlp(line, a, b, 0.0); }
void expectNear(int line, FloatValue a, FloatValue b, float allowed) {
    float off = largestOf(vec4(difference(a.v.x, b.v.x), difference(a.v.y, b.v.y), difference(a.v.z, b.v.z),
                               difference(a.v.w, b.v.w)));
    expectation(line, !isNotANumber(off) && off <= allowed, floatEvidence(a, b, off, allowed));
}

void expectDifferent(int line, BoolValue a, BoolValue b) {
    expectation(line, a.v != b.v, evidence(a.v, b.v, kValueBool, a.components, 0.0, 0.0));
}
void expectDifferent(int line, IntValue a, IntValue b) {
    expectation(line, a.v != b.v, evidence(uvec4(a.v), uvec4(b.v), kValueInt, a.components, 0.0, 0.0));
}
void expectDifferent(int line, UintValue a, UintValue b) {
    expectation(line, a.v != b.v, evidence(a.v, b.v, kValueUint, a.components, 0.0, 0.0));
}
void expectDifferent(int line, FloatValue a, FloatValue b) {
    float off = largestOf(ulps(a.v, b.v));
    expectation(line, isNotANumber(off) || off != 0.0, floatEvidence(a, b, off, 0.0));
}

// Every component of `a` is below that of `b` (or equal, unless strict); the difference is how far it is beyond.
void expectOrder(int line, FloatValue lower, FloatValue upper, bool strict, Evidence seen) {
    bool ok = true;
    vec4 off = vec4(0.0);
    for (uint i = 0u; i < lower.components; i++) {
        off[i] = difference(lower.v[i], upper.v[i]);
        bool ordered = strict ? lower.v[i] < upper.v[i] : lower.v[i] <= upper.v[i];
        ok = ok && ordered && !isNotANumber(off[i]);
        off[i] = ordered ? 0.0 : off[i];
    }
    seen.difference = largestOf(off);
    expectation(line, ok, seen);
}
void expectBelow(int line, FloatValue a, FloatValue b, bool strict) {
    expectOrder(line, a, b, strict, floatEvidence(a, b, 0.0, 0.0));
}
void expectAbove(int line, FloatValue a, FloatValue b, bool strict) {
    expectOrder(line, b, a, strict, floatEvidence(a, b, 0.0, 0.0));
}
void expectWordBelow(int line, uint lower, uint upper, bool strict, Evidence seen) {
    seen.difference = lower > upper ? float(lower - upper) : 0.0;
    expectation(line, strict ? lower < upper : lower <= upper, seen);
}
void expectBelow(int line, UintValue a, UintValue b, bool strict) {
    expectWordBelow(line, a.v.x, b.v.x, strict, evidence(a.v, b.v, kValueUint, 1u, 0.0, 0.0));
}
void expectAbove(int line, UintValue a, UintValue b, bool strict) {
    expectWordBelow(line, b.v.x, a.v.x, strict, evidence(a.v, b.v, kValueUint, 1u, 0.0, 0.0));
}

#endif
