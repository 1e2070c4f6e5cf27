#include <gtest/gtest.h>

#include <new>

#include "host/base/error.h"
#include "host/base/memory.h"

namespace duolux {
namespace {

TEST(InputError, SaysFilePlaceProblemAndRemedyInOneLine) {
    EXPECT_STREQ(InputError("a.json", "camera.vfov", "is 270", "expected a number from 0 to 180").what(),
                 "a.json: camera.vfov: is 270; expected a number from 0 to 180");
    EXPECT_STREQ(InputError("a.obj", "", "is empty", "").what(), "a.obj: is empty");
    EXPECT_STREQ(InputError("a\nb", "", "x\r\ny", "").what(), "a\\x0ab: x\\x0d\\x0ay");
}

TEST(MemoryError, NamesTheFileThatDoesNotFit) {
    try {
        withMemoryToRead("a.obj", []() -> int { throw std::bad_alloc(); });
        ADD_FAILURE() << "expected MemoryError";
    } catch (const MemoryError& e) {
        EXPECT_EQ(std::string(e.what()).find("a.obj: cannot read it: out of memory"), 0u) << e.what();
    }
}

}  // namespace
}  // namespace duolux
