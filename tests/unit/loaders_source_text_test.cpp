#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "host/loaders/source_text.h"

namespace duolux {
namespace {

TEST(SourceText, ReadsNumbersAsWritten) {
    const auto read = [](std::string_view text) {
        return readNumber(text.data(), text.data() + text.size());
    };
    const auto length = [&](std::string_view text) {
        const char* const past = read(text).past;
        return past == nullptr ? -1 : static_cast<int>(past - text.data());
    };
    EXPECT_EQ(read("-12.5e-3 ").value, -12.5e-3);
    EXPECT_EQ(length("-12.5e-3 "), 8);
    EXPECT_EQ(read("4612345.678901").value, 4612345.678901);
    EXPECT_EQ(read(".5").value, 0.5);
    EXPECT_EQ(read("+5.").value, 5.0);
    EXPECT_EQ(length("+1x"), 2);
    EXPECT_EQ(length("1e"), 1);
    EXPECT_EQ(read("1e-9999").value, 0.0);
    EXPECT_EQ(read("-1e9999").value, -std::numeric_limits<double>::infinity());
    for (const char* text : {"", ".", "-", "e5", "+-1", "--1", "x"})
        EXPECT_EQ(read(text).past, nullptr) << text;
    for (const char* text :
         {"nan", "-nan(ind)", "NaN", "inf", "-Infinity", "1.#IND", "-1.#QNAN", "1.#INF000"}) {
        EXPECT_FALSE(std::isfinite(read(text).value)) << text;
        EXPECT_EQ(length(text), static_cast<int>(std::string_view(text).size())) << text;
    }
}

}  // namespace
}  // namespace duolux
