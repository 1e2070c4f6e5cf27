#include <gtest/gtest.h>

#include <string>

#include "host/base/error.h"
#include "host/base/printable.h"

namespace duolux {
namespace {

TEST(Printable, KeepsTextOfAnyLanguage) {
    EXPECT_EQ(printable(""), "");
    EXPECT_EQ(printable("C:\\models\\a b"), "C:\\models\\a b");
    EXPECT_EQ(printable("B\xC3\xB6"
                        "den \xE7\x9B\x92 \xF0\x9F\x98\x80"),
              "B\xC3\xB6"
              "den \xE7\x9B\x92 \xF0\x9F\x98\x80");
}

TEST(Printable, ShowsControlCharactersAndBadBytes) {
    EXPECT_EQ(printable("\x1b[31mX\x07\x7f\n\t"), "\\x1b[31mX\\x07\\x7f\\x0a\\x09");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\xC2\x9B"
                        "31m"),
              "\\xc2\\x9b31m")
        << "the C1 form of an escape sequence";
    EXPECT_EQ(printable("a\xE2\x80\xAEz"), "a\\xe2\\x80\\xaez") << "right-to-left override";
    EXPECT_EQ(printable("\xFF\xC3"), "\\xff\\xc3");
    EXPECT_EQ(printable(printable("\x1b\xFF")), printable("\x1b\xFF"));
}

TEST(Printable, QuotesAndShortensByCharacters) {
    EXPECT_EQ(inQuotes("a b"), "\"a b\"");
    EXPECT_EQ(inQuotes("a\x1b[0m\n"), "\"a\\x1b[0m\\x0a\"");
    EXPECT_EQ(inQuotes(std::string(40, 'x')), "\"" + std::string(40, 'x') + "\"");
    EXPECT_EQ(inQuotes(std::string(41, 'x')), "\"" + std::string(40, 'x') + "...\"");
    EXPECT_EQ(shortened("\xC3\xA9\xC3\xA9\xC3\xA9", 2), "\xC3\xA9\xC3\xA9...");
}

TEST(Printable, InputErrorsStayShortAndPrintable) {
    const std::string line =
        InputError("a\x1b.obj", std::string(1'000'000, 'k'), std::string(1'000'000, 'p'), "r\n").what();
    EXPECT_LT(line.size(), 1000u);
    EXPECT_TRUE(line.starts_with("a\\x1b.obj: kkk")) << line;
    EXPECT_TRUE(line.ends_with("; r\\x0a")) << line;
}

TEST(Printable, LongTextKeepsItsBeginningAndItsEnd) {
    const std::string text =
        "file.json: key " + std::string(1'000'000, 'k') + " is unknown; expected \"camera\"";
    const std::string line = withoutMiddle(text, 300);
    EXPECT_EQ(line.size(), 300u);
    EXPECT_EQ(line.substr(0, 16), text.substr(0, 16));
    EXPECT_EQ(line.substr(270), text.substr(text.size() - 30));
    std::string accents;
    while (accents.size() < 400)
        accents += "\xC3\xA9";
    for (std::size_t most = 100; most < 110; ++most) {
        const std::string shorter = withoutMiddle(accents, most);
        EXPECT_EQ(printable(shorter), shorter) << most;  // no character was cut
        EXPECT_LE(shorter.size(), most);
        EXPECT_EQ(withoutMiddle(std::string(most, 'x'), most), std::string(most, 'x'));
    }
}

}  // namespace
}  // namespace duolux
