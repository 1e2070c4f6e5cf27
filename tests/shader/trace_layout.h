// Records of the traversal test, shared by C++ and GLSL (scalar block layout).
#ifndef DUOLUX_TESTS_SHADER_TRACE_LAYOUT_H
#define DUOLUX_TESTS_SHADER_TRACE_LAYOUT_H

#include "shaders/shared/types.h"

DUOLUX_BEGIN

DUOLUX_CONST uint kTestNearest = 0u;
DUOLUX_CONST uint kTestAnyHit = 1u;
DUOLUX_CONST uint kTestAllCrossings = 2u;

struct TestRay {
    vec3 origin;
    float tMin;
    vec3 direction;
    float tMax;
};

struct TestHit {
    float t;  // -1: none
    uint primitive;
    uint crossings;  // with kTestAllCrossings: how many surfaces the ray crosses; else 0 or 1
    vec2 barycentric;
};

struct TestPush {
    uint count;
    uint mode;
    uint root;
};

DUOLUX_END
#endif
