#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/base/file.h"
#include "host/cli/temporary_folder.h"
#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/coverage.h"
#include "tests/shader/harness/glsl_test.h"
#include "tests/shader/harness/shader_function.h"
#include "tests/support/statistics.h"

// The harness itself: which values its expectations accept, and what it reports for failures.

namespace duolux::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// GLSL files that override the project's.
class Harness : public testing::Test {
  protected:
    Harness() { sourceRoots().insert(sourceRoots().begin(), folder_.path()); }
    ~Harness() override { sourceRoots().erase(sourceRoots().begin()); }

    /// Runs a test of a file with this text.
    std::vector<GlslFailure> run(const std::string& text, std::size_t test = 0) {
        // Kernels are cached by file name.
        const std::string name = "harness" + std::to_string(std::hash<std::string>()(text)) + "_test.glsl";
        writeFile(folder_ / name, text);
        return runGlslTest(parseGlslFile(name, text), test);
    }

    TemporaryFolder folder_;
};

TEST_F(Harness, WhatIsTruePasses) {
    EXPECT_THAT(run(R"(
TEST(Passes) {
    EXPECT_TRUE(testIndex() < testCount());
    EXPECT_FALSE(testCount() != 4096u);
    EXPECT_EQ(vec2(0.0, -0.0), vec2(-0.0, 0.0));
    EXPECT_EQ(ivec3(1, -2, 3), ivec3(1, -2, 3));
    EXPECT_EQ(bvec2(true, false), bvec2(true, false));
    EXPECT_NE(uvec4(1u, 2u, 3u, 4u), uvec4(1u, 2u, 3u, 5u));
    EXPECT_NE(1.0, uintBitsToFloat(0x3f800001u));
    EXPECT_NEAR(vec4(1.0), vec4(1.0625), 0.0625);
    EXPECT_NEAR(uintBitsToFloat(0x7f800000u), uintBitsToFloat(0x7f800000u), 0.0);
    EXPECT_ULP(1.0, uintBitsToFloat(0x3f800003u), 3);
    EXPECT_ULP(uintBitsToFloat(0x00000001u), uintBitsToFloat(0x80000001u), 2);
    EXPECT_LT(vec3(1.0, 2.0, 3.0), vec3(2.0, 3.0, 4.0));
    EXPECT_LE(vec2(1.0, 2.0), vec2(1.0, 3.0));
    EXPECT_GT(2u, 1u);
    EXPECT_GE(2u, 2u);
}
)"),
                IsEmpty());
}

TEST_F(Harness, WhatIsFalseFails) {
    const std::vector<std::string> bodies{
        "EXPECT_TRUE(testIndex() != 77u);",
        "EXPECT_FALSE(testIndex() == 77u);",
        "EXPECT_EQ(1.0, uintBitsToFloat(0x3f800001u));",
        "EXPECT_EQ(uintBitsToFloat(0x7fc00000u), uintBitsToFloat(0x7fc00000u));",
        "EXPECT_EQ(vec4(1.0), vec4(1.0, 1.0, 1.0, 2.0));",
        "EXPECT_EQ(ivec2(1, -1), ivec2(1, 1));",
        "EXPECT_EQ(bvec3(true), bvec3(true, true, false));",
        "EXPECT_NE(vec3(1.0), vec3(1.0));",
        "EXPECT_NE(uvec2(7u), uvec2(7u));",
        "EXPECT_NEAR(1.0, 1.0625, 0.0624);",
        "EXPECT_NEAR(vec3(0.0), vec3(0.0, 0.0, 1.0), 0.5);",
        "EXPECT_NEAR(uintBitsToFloat(0x7fc00000u), 1.0, 1e30);",
        "EXPECT_NEAR(uintBitsToFloat(0x7f800000u), 1.0, 1e30);",
        "EXPECT_ULP(1.0, uintBitsToFloat(0x3f800004u), 3);",
        "EXPECT_ULP(vec2(1.0), vec2(1.0, -1.0), 1000000);",
        "EXPECT_LT(vec2(1.0, 2.0), vec2(2.0, 2.0));",
        "EXPECT_LE(vec2(1.0, 2.5), vec2(2.0, 2.0));",
        "EXPECT_LE(uintBitsToFloat(0x7fc00000u), 2.0);",
        "EXPECT_GT(1.0, 1.0);",
        "EXPECT_GE(1u, 2u);",
        "EXPECT_EQ(vec3(0.0, 1.0, 0.0), vec2(0.0, 1.0));",
        "EXPECT_GE(vec3(0.6, 0.1, 0.1), 0.5);",
        "EXPECT_LT(uvec2(1u, 5u), uvec2(2u, 3u));",
        "EXPECT_NE(vec2(1.0, 2.0), 1.0);",
        "EXPECT_NEAR(1.0, 1.0, -1.0);",
    };
    std::string text;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        text += "TEST(Fails" + std::to_string(i) + ") { " + bodies[i] + " }\n";
    for (std::size_t i = 0; i < bodies.size(); ++i)
        EXPECT_THAT(run(text, i), testing::SizeIs(1)) << bodies[i];
}

TEST_F(Harness, AFailureNamesPlaceExpressionValuesAndHowMany) {
    const std::vector<GlslFailure> failures = run(R"(// A comment with TEST(NotATest) { EXPECT_TRUE(false); }
TEST_N(Fails, 100000) {
    float x = float(testIndex());
    EXPECT_NEAR(x,
                x < 70000.0 ? x : 70000.0,  // until here
                16.0);
    EXPECT_EQ(uvec2(5u, testIndex() == 99999u ? 1u : 0u), uvec2(5u, 0u));
}
)");
    ASSERT_THAT(failures, testing::SizeIs(2));
    EXPECT_EQ(failures[0].line, 4u);
    EXPECT_EQ(failures[0].message, R"(EXPECT_NEAR(x, x < 70000.0 ? x : 70000.0, 16.0)
  failed 29983 of 100000 times; 29983 of the test's 100000 invocations failed something
  first: invocation 70017
    actual:   70017
    expected: 70000
    off by 17 (allowed: 16)
  worst: invocation 99999
    actual:   99999
    expected: 70000
    off by 3e+04 (allowed: 16)
  all 29983, off by
    1 to 2 times what is allowed: 15
    2 to 4 times what is allowed: 32
    4 to 8 times what is allowed: 64
    8 to 16 times what is allowed: 128
    16 to 32 times what is allowed: 256
    32 to 64 times what is allowed: 512
    64 to 128 times what is allowed: 1024
    128 to 256 times what is allowed: 2048
    256 to 512 times what is allowed: 4096
    512 to 1024 times what is allowed: 8192
    1024 to 2048 times what is allowed: 13616
)");
    EXPECT_EQ(failures[1].line, 7u);
    EXPECT_THAT(failures[1].message,
                AllOf(HasSubstr("failed 1 of 100000 times; 29983 of"), HasSubstr("first: invocation 99999"),
                      HasSubstr("actual:   (5 (0x5), 1 (0x1))"), HasSubstr("expected: (5 (0x5), 0 (0x0))")));
}

TEST_F(Harness, ATestThatChecksNothingFails) {
    EXPECT_THAT(run("TEST(Empty) {}"), testing::SizeIs(1));
    const std::vector<GlslFailure> failures =
        run("TEST(Skips) {\n    EXPECT_TRUE(true);\n"
            "    if (testIndex() > 5000u) EXPECT_TRUE(false);\n}\n");
    ASSERT_THAT(failures, testing::SizeIs(1));
    EXPECT_EQ(failures[0].line, 3u);
    EXPECT_THAT(failures[0].message, HasSubstr("no invocation has reached this"));
}

TEST_F(Harness, ExpectationsOfOtherFilesAreRefused) {
    writeFile(folder_ / "helper.glsl", "void check(float x) {\n    EXPECT_GE(x, 0.5);\n}\n");
    writeFile(folder_ / "between.glsl", "#include \"helper.glsl\"\n");
    try {
        parseGlslFile("x_test.glsl", "#include \"between.glsl\"\nTEST(A) { check(1.0); }\n");
        FAIL() << "understood";
    } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(),
                     "helper.glsl:2: an expectation in an included file; it belongs in the test file itself");
    }
}

TEST_F(Harness, NotesShowWhatTheFirstFailureWasMadeOf) {
    const std::vector<GlslFailure> failures = run(R"(
TEST(Noted) {
    uint i = testIndex();
    NOTE(i);
    vec2 half_ = vec2(i, 0.5);
    NOTE(half_ + vec2(1.0, 0.0));
    if (i > 10000u) {
        NOTE(i);
    }
    EXPECT_LT(i, 200u);
}
)");
    ASSERT_THAT(failures, testing::SizeIs(1));
    EXPECT_THAT(failures[0].message, HasSubstr("  noted in invocation 200\n    i = 200 (0xc8)\n"
                                               "    half_ + vec2(1.0, 0.0) = (201, 0.5)\n"));
    EXPECT_THAT(failures[0].message, HasSubstr("bound:    200 (0xc8)"));
}

TEST_F(Harness, AMacrosExpectationIsShownByTheLineThatUsesIt) {
    const std::vector<GlslFailure> failures =
        run("#define CHECK(x) EXPECT_GT(x, 1.0)\nTEST(Macro) {\n    CHECK(0.5);\n}\n");
    ASSERT_THAT(failures, testing::SizeIs(1));
    EXPECT_EQ(failures[0].line, 3u);
    EXPECT_THAT(failures[0].message, testing::StartsWith("CHECK(0.5);\n"));
}

TEST_F(Harness, ACompileErrorNamesTheLineOfTheTestFile) {
    try {
        run("TEST(Fine) { EXPECT_TRUE(true); }\nTEST(Broken) {\n    EXPECT_TRUE(nowhere);\n}\n");
        FAIL() << "compiled";
    } catch (const CompileError& e) {
        EXPECT_THAT(e.what(), testing::ContainsRegex("harness[0-9]+_test.glsl:3: 'nowhere'"));
        EXPECT_THAT(e.place().file, testing::ContainsRegex("^harness[0-9]+_test.glsl$"));
        EXPECT_EQ(e.place().line, 3u);
        EXPECT_THAT(e.what(), testing::Not(HasSubstr("Linking")));
    }
}

TEST_F(Harness, AFileThatCannotBeUnderstoodIsAnError) {
    const auto message = [](const std::string& text) -> std::string {
        try {
            parseGlslFile("x_test.glsl", text);
        } catch (const std::runtime_error& e) {
            return e.what();
        }
        return "understood";
    };
    EXPECT_EQ(message("// TEST(InAComment) {}\n"), "x_test.glsl:1: there is no TEST(name) in this file");
    EXPECT_EQ(message("\nTEST(Open) {\n"), "x_test.glsl:2: the test's body has no end");
    for (const char* text :
         {"TEST(Count, 5) {}", "TEST_N(None) {}", "TEST_N(Shift, 1 << 4) {}", "TEST(Semicolon);"}) {
        EXPECT_EQ(message(text),
                  "x_test.glsl:1: expected TEST(name) { or TEST_N(name, invocations) {, invocations being up "
                  "to nine digits");
    }
    EXPECT_EQ(message("TEST_N(None, 0) {}"), "x_test.glsl:1: a test needs at least one invocation");
    EXPECT_EQ(message("TEST(Two) {\n EXPECT_TRUE(a); EXPECT_TRUE(b);\n}"),
              "x_test.glsl:2: two expectations, or notes, on one line cannot be told apart");
}

TEST_F(Harness, RandomInputsAreInTheirRanges) {
    EXPECT_THAT(run(R"(
TEST(Ranges) {
    float f = randomFloat(-2.0, 3.0);
    EXPECT_GE(f, -2.0);
    EXPECT_LT(f, 3.0);
    EXPECT_NEAR(length(randomDirection()), 1.0, 3e-7);
    float s = randomScale(-3.0, 5.0);
    EXPECT_GE(s, 0.124);
    EXPECT_LE(s, 32.1);
}
)"),
                IsEmpty());
}

/// Chi-square of the high and the low byte over 2^18 invocations, at 1e-4 / 4 each; invocations, seeds and
/// calls are uncorrelated to 5 standard deviations.
TEST_F(Harness, RandomWordsAreUniformAndIndependent) {
    std::vector<std::uint32_t> invocation(1u << 18);
    for (std::uint32_t i = 0; i < invocation.size(); ++i)
        invocation[i] = i;
    const ShaderLibrary random("tests/shader/harness/random.glsl");
    const auto words = random.evaluate<glm::uvec4>(
        "seedRandom(7u, x0); result.x = randomUint(); result.y = randomUint();"
        "seedRandom(7u, x0 + 1u); result.z = randomUint(); seedRandom(8u, x0); result.w = randomUint();",
        invocation);
    const auto n = static_cast<double>(words.size());
    for (const int shift : {0, 24}) {
        for (const int word : {0, 1}) {
            std::vector<double> counts(256);
            for (const glm::uvec4& w : words)
                counts[w[word] >> shift & 255u] += 1.0;
            EXPECT_GT(chiSquare(counts, std::vector<double>(256, n / 256.0)).p, 1e-4 / 4.0);
        }
    }
    const auto centred = [](std::uint32_t w) { return std::ldexp(static_cast<double>(w), -32) - 0.5; };
    for (const int other : {1, 2, 3}) {
        double sum = 0.0;
        for (const glm::uvec4& w : words)
            sum += 12.0 * centred(w.x) * centred(w[other]);
        EXPECT_LT(std::abs(sum / n), 5.0 / std::sqrt(n)) << other;
    }
}

TEST_F(Harness, CallsTakeArraysAndSingleValues) {
    const ShaderLibrary library =
        ShaderLibrary("").define("float scaled(vec2 v, float s) { return v.x * s + v.y; }");
    const std::vector<glm::vec2> v{{1, 2}, {3, 4}, {5, 6}};
    EXPECT_THAT(library.call<float>("scaled", v, 10.0f), ElementsAre(12, 34, 56));
    EXPECT_THAT(library.call<float>("scaled", v, std::vector<float>{1, 2, 3}), ElementsAre(3, 10, 21));
    EXPECT_THROW(library.call<float>("scaled", v, std::vector<float>{1, 2}), std::logic_error);
    EXPECT_THROW(library.call<float>("nowhere", v), CompileError);
}

/// More invocations than fit into one dispatch.
TEST_F(Harness, CallsAreSplitWhereTheyAreLarge) {
    std::vector<std::uint32_t> inputs((1u << 20) + 77u);
    for (std::uint32_t i = 0; i < inputs.size(); ++i)
        inputs[i] = i;
    const auto outputs = ShaderLibrary("").evaluate<std::uint32_t>("result = x0 * 3u;", inputs);
    for (std::uint32_t i = 0; i < inputs.size(); ++i)
        ASSERT_EQ(outputs[i], 3u * i);
}

TEST_F(Harness, TexelsAndConstantsReachTheLibrary) {
    ShaderLibrary library("");
    library.texels<glm::uvec4>("fetchThing", std::vector<glm::uvec4>{{1, 2, 3, 4}, {5, 6, 7, 8}});
    library.define("layout(constant_id = 7) const uint kFactor = 1u;");
    library.constant(7, 100);
    EXPECT_THAT(library.evaluate<std::uint32_t>("result = fetchThing(x0).z * kFactor;",
                                                std::vector<std::uint32_t>{0, 1}),
                ElementsAre(300, 700));
}

TEST(Coverage, LeavesAloneWhatItCannotMark) {
    std::vector<CoveragePoint> points;
    const std::string text = R"(
const float kC = true ? 1.0 : 2.0;
highp float f() {
    for (;;) break;
    for(int i=0;i<4;i++) {}
    return kC;
}
)";
    EXPECT_EQ(instrument("a.glsl", text, points), R"(
const float kC = true ? 1.0 : 2.0;
highp float f() { coverFunction_(0u);
    for (;;) break;
    for(int i=0;coverCondition_(1u, i<4);i++) {}
    return kC;
}
)");
}

TEST(Coverage, MarksFunctionsAndConditions) {
    std::vector<CoveragePoint> points;
    const std::string marked = instrument("a.glsl", R"(
// A comment: is this a ? b : c
float f(float x,
        vec2 y) {
    return x == 0.0 || y.x <= 1.0 ? g(x, y.y > 0.0 ? 1.0 : 2.0) : x < 1.0 ? 3.0 : 4.0;
}
struct S { float x; };
uint[2] h(S s) {
    bool b = (s.x != 0.0 ? 1u : 2u) == 1u;
    if (b && s.x > 2.0) return uint[2](0u, 1u);
    for (int i = 0; i < 3; i++) b = !b;
    while (b) b = false;
}
)",
                                          points);
    EXPECT_EQ(marked, R"(
// A comment: is this a ? b : c
float f(float x,
        vec2 y) { coverFunction_(0u);
    return coverCondition_(5u, x == 0.0 || y.x <= 1.0) ? g(x, coverCondition_(6u, y.y > 0.0) ? 1.0 : 2.0) : coverCondition_(7u, x < 1.0) ? 3.0 : 4.0;
}
struct S { float x; };
uint[2] h(S s) { coverFunction_(1u);
    bool b = (coverCondition_(8u, s.x != 0.0) ? 1u : 2u) == 1u;
    if (coverCondition_(2u, b && s.x > 2.0)) return uint[2](0u, 1u);
    for (int i = 0; coverCondition_(3u, i < 3); i++) b = !b;
    while (coverCondition_(4u, b)) b = false;
}
)");
    ASSERT_EQ(points.size(), 9u);
    std::vector<std::uint32_t> reached(18, 1);
    reached[2] = 0;   // h
    reached[11] = 0;  // x == 0.0 || ... true
    EXPECT_EQ(coverageReport(points, reached),
              R"(file                                   functions      outcomes
a.glsl                                 1 of    2    13 of   14
all                                    1 of    2    13 of   14

a.glsl:5: x == 0.0 || y.x <= 1.0 is never true
a.glsl:8: h is never called
)");
}

}  // namespace
}  // namespace duolux::test
