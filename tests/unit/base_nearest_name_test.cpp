#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host/base/nearest_name.h"

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

}  // namespace
}  // namespace duolux
