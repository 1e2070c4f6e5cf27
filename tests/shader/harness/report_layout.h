// The results that a GLSL test writes, shared by C++ and GLSL (scalar block layout).
#ifndef DUOLUX_TESTS_SHADER_HARNESS_REPORT_LAYOUT_H
#define DUOLUX_TESTS_SHADER_HARNESS_REPORT_LAYOUT_H

#include "shaders/shared/types.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kTestWorkgroup = 64u;
DUOLUX_CONST uint kBindingExpectations = 97u;  // storage: Expectation, one a line of the test file
DUOLUX_CONST uint kBindingInvocations = 98u;   // storage: a bit for each invocation that failed
DUOLUX_CONST uint kBindingCoverage = 99u;      // storage: see coverage.glsl
DUOLUX_CONST uint kSpecTest = 1000u;           // index of the test within its file

// Histogram of the failures' differences, relative to the allowed difference (or to 1 if that is 0): 1 to 2
// times, 2 to 4 times, and so on; the last bin but one is open, and the last counts NaN.
DUOLUX_CONST uint kCensusBins = 20u;
DUOLUX_CONST uint kCensusOpen = 18u;
DUOLUX_CONST uint kCensusNaN = 19u;

DUOLUX_CONST uint kValueBool = 0u;
DUOLUX_CONST uint kValueInt = 1u;
DUOLUX_CONST uint kValueUint = 2u;
DUOLUX_CONST uint kValueFloat = 3u;

// Runs of the same test: the first counts failures, the others record the values of the invocations it has
// found.
DUOLUX_CONST uint kPassCount = 0u;
DUOLUX_CONST uint kPassFirst = 1u;
DUOLUX_CONST uint kPassWorst = 2u;
DUOLUX_CONST uint kPassNotes = 3u;

// The values that one invocation saw.
struct Evidence {
    uint actual[4];
    uint expected[4];
    uint type;        // kValue...
    uint components;  // of actual; 0: nothing was noted
    uint expectedComponents;
    float difference;
    float allowed;
};

struct Expectation {
    uint evaluated;
    uint failed;
    uint first;    // complement of the first invocation that failed; 0: none did
    uint worst;    // bits of the largest difference, which is not negative
    uint worstAt;  // complement of the first invocation with that difference
    uint census[20];
    Evidence firstSeen;
    Evidence worstSeen;
};

struct TestDispatch {
    uint firstInvocation;
    uint count;  // all invocations of the test
    uint seed;   // of the random inputs
    uint pass;
    uint noted;  // invocation whose values NOTE shows
};

#ifdef __cplusplus
static_assert(sizeof(Evidence) == 52 && sizeof(Expectation) == 25 * 4 + 2 * 52);
static_assert(sizeof(Expectation::census) == kCensusBins * sizeof(uint));
#endif

DUOLUX_END
#endif
