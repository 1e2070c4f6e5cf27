#include <gtest/gtest.h>

#include "host/cli/json.h"

namespace duolux {
namespace {

TEST(JsonText, EscapesWhatTerminalsActOn) {
    const std::string name =
        "\x1b[31m \x7f \xC2\x9B"
        "31m \xE2\x80\xAEz \xE2\x81\xA6 \xE2\x80\xA8 \xEF\xBB\xBF B\xC3\xB6"
        "den \xE7\x9B\x92 \xF0\x9F\x98\x80";
    const nlohmann::ordered_json json = {{"name", name}, {name, 1}};
    const std::string text = jsonText(json);
    EXPECT_EQ(text,
              "{\n  \"name\": \"\\u001b[31m \\u007f \\u009b31m \\u202ez \\u2066 \\u2028 \\ufeff B\xC3\xB6"
              "den \xE7\x9B\x92 \xF0\x9F\x98\x80\",\n  \"\\u001b[31m \\u007f \\u009b31m \\u202ez \\u2066 "
              "\\u2028 \\ufeff B\xC3\xB6"
              "den \xE7\x9B\x92 \xF0\x9F\x98\x80\": 1\n}\n");
    EXPECT_EQ(nlohmann::ordered_json::parse(text), json);
    EXPECT_EQ(jsonText("\xFF"), "\"\xEF\xBF\xBD\"\n") << "no UTF-8";
}

}  // namespace
}  // namespace duolux
