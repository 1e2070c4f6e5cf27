#include <gtest/gtest.h>

#include <vector>

#include "host/scene/nearest_name.h"
#include "host/scene/source_text.h"

namespace duolux {
namespace {

TEST(NearestName, EditDistance) {
    EXPECT_EQ(editDistance("", ""), 0u);
    EXPECT_EQ(editDistance("", "abc"), 3u);
    EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
    EXPECT_EQ(editDistance("vfow", "vfov"), 1u);
    EXPECT_EQ(editDistance("wihte", "white"), 1u) << "a swap of neighbours is one step";
    EXPECT_EQ(editDistance("Camera", "camera"), 0u);
    EXPECT_EQ(editDistance("abcd", "acbd"), editDistance("acbd", "abcd"));
}

TEST(NearestName, SuggestsOnlyWhatIsNear) {
    const std::vector<std::string> known{"position", "target", "up", "vfov"};
    EXPECT_EQ(suggestName("fov", known), "did you mean \"vfov\"?");
    EXPECT_EQ(suggestName("positoin", known), "did you mean \"position\"?");
    EXPECT_EQ(suggestName("aperture", known), "expected one of \"position\", \"target\", \"up\", \"vfov\"");
    EXPECT_EQ(suggestName("x", {}), "there are none");
    EXPECT_EQ(suggestName(std::string(100'000, 'x'), known).substr(0, 15), "expected one of");
}

TEST(SourceText, SkipsDecimalNumbersOnly) {
    const auto skipped = [](std::string_view text) -> std::ptrdiff_t {
        const char* past = skipDecimalNumber(text.data(), text.data() + text.size());
        return past == nullptr ? -1 : past - text.data();
    };
    EXPECT_EQ(skipped("1"), 1);
    EXPECT_EQ(skipped("-12.5e-3 "), 8);
    EXPECT_EQ(skipped(".5"), 2);
    EXPECT_EQ(skipped("5."), 2);
    EXPECT_EQ(skipped("+1x"), 2);
    EXPECT_EQ(skipped(""), -1);
    EXPECT_EQ(skipped("."), -1);
    EXPECT_EQ(skipped("-"), -1);
    EXPECT_EQ(skipped("e5"), -1);
    EXPECT_EQ(skipped("1e"), -1);
    EXPECT_EQ(skipped("nan"), -1);
}

}  // namespace
}  // namespace duolux
