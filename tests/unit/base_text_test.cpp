#include <gtest/gtest.h>

#include <array>

#include "host/base/text.h"

namespace duolux {
namespace {

TEST(Text, LowerCaseIsOfAsciiLettersOnly) {
    EXPECT_EQ(lowerCase("A.OBJ z[@`{"), "a.obj z[@`{");
    EXPECT_EQ(lowerCase("\xC3\x84"), "\xC3\x84");
}

TEST(Text, AlternativesEndInOr) {
    const std::array<std::string_view, 3> texts{"a", "b", "c"};
    const std::span<const std::string_view> all(texts);
    EXPECT_EQ(alternatives(all), "a, b or c");
    EXPECT_EQ(alternatives(all.first(2)), "a or b");
    EXPECT_EQ(alternatives(all.first(1)), "a");
    EXPECT_EQ(alternatives({}), "");
}

}  // namespace
}  // namespace duolux
