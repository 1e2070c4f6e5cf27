#include <gtest/gtest.h>

#include "host/base/utf8.h"

namespace duolux {
namespace {

TEST(Utf8, DecodesEveryLength) {
    EXPECT_EQ(decodeUtf8(""), U"");
    EXPECT_EQ(decodeUtf8("plain"), U"plain");
    EXPECT_EQ(decodeUtf8("\xC3\xA9\xE2\x80\xA6\xF0\x9F\x98\x80z"), U"\u00E9\u2026\U0001F600z");
}

TEST(Utf8, ReplacesWhatIsNotWellFormed) {
    EXPECT_EQ(decodeUtf8("a\xFFz"), U"a\uFFFDz");                  // no lead byte
    EXPECT_EQ(decodeUtf8("\x80"), U"\uFFFD");                      // a continuation alone
    EXPECT_EQ(decodeUtf8("\xE2\x80"), U"\uFFFD\uFFFD");            // cut off
    EXPECT_EQ(decodeUtf8("\xC0\xAF"), U"\uFFFD\uFFFD");            // overlong
    EXPECT_EQ(decodeUtf8("\xED\xA0\x80"), U"\uFFFD\uFFFD\uFFFD");  // surrogate
    EXPECT_EQ(decodeUtf8("\xF4\x90\x80\x80").size(), 4u);          // above U+10FFFF
    EXPECT_EQ(decodeUtf8("\xC3z"), U"\uFFFDz");                    // lead without continuation
}

}  // namespace
}  // namespace duolux
