#include <gtest/gtest.h>

#include "host/base/error.h"

namespace duolux {
namespace {

TEST(InputError, SaysFilePlaceProblemAndRemedyInOneLine) {
    EXPECT_STREQ(InputError("a.json", "camera.vfov", "is 270", "expected a number from 0 to 180").what(),
                 "a.json: camera.vfov: is 270; expected a number from 0 to 180");
    EXPECT_STREQ(InputError("a.obj", "", "is empty", "").what(), "a.obj: is empty");
    EXPECT_STREQ(InputError("a\nb", "", "x\r\ny", "").what(), "a\\x0ab: x\\x0d\\x0ay");
}

}  // namespace
}  // namespace duolux
