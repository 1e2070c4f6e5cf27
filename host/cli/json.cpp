#include "host/cli/json.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "host/base/printable.h"
#include "host/base/utf8.h"

namespace duolux {

std::string jsonText(const nlohmann::ordered_json& json) {
    const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    std::string result;
    result.reserve(text.size() + 1);
    for (std::string_view rest = text; !rest.empty();) {
        const auto first = firstUtf8(rest);
        const std::size_t bytes = first ? first->bytes : 1;
        // Controls below 0x20 are escaped by now, except the ends of lines.
        if (first && first->value >= 0x7f && isControl(first->value)) {
            fmt::format_to(std::back_inserter(result), "\\u{:04x}", static_cast<std::uint32_t>(first->value));
        } else {
            result += rest.substr(0, bytes);
        }
        rest.remove_prefix(bytes);
    }
    return result + "\n";
}

}  // namespace duolux
