#include <gtest/gtest.h>

#include <cstdlib>

#include "host/cli/process.h"

namespace duolux {
namespace {

TEST(Process, ReturnsHowTheProgramEnded) {
    EXPECT_EQ(runProcess("true", {}), 0);
    EXPECT_EQ(runProcess("sh", {"-c", "exit 3"}), 3);
    EXPECT_EQ(runProcess("sh", {"-c", "kill -9 $$"}), 128 + 9);
    EXPECT_EQ(runProcess("/no/such/program", {}), 127);
}

TEST(Process, ArgumentsAndEnvironmentArriveAsTheyAre) {
    EXPECT_EQ(
        runProcess("sh", {"-c", "test \"$1\" = 'two  words' && test \"$2\" = ''", "sh", "two  words", ""}),
        0);
    ::setenv("DUOLUX_TEST_VARIABLE", "old", 1);
    EXPECT_EQ(runProcess("sh", {"-c", "test $DUOLUX_TEST_VARIABLE = old"}), 0);
    EXPECT_EQ(runProcess("sh", {"-c", "test $DUOLUX_TEST_VARIABLE = new"}, {"DUOLUX_TEST_VARIABLE=new"}), 0);
    EXPECT_STREQ(::getenv("DUOLUX_TEST_VARIABLE"), "old");
}

}  // namespace
}  // namespace duolux
