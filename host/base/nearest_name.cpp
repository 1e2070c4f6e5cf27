#include "host/base/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "host/base/printable.h"
#include "host/base/text.h"

namespace duolux {

std::size_t editDistance(std::string_view first, std::string_view second) {
    const std::string a = lowerCase(first), b = lowerCase(second);
    // Rows of the dynamic programming table: the one before the previous, the previous, the current.
    std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        previous[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = a[i - 1] == b[j - 1];
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (same ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) current[j] = std::min(current[j], before[j - 2] + 1);
        }
        std::swap(before, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

std::optional<std::string> nearestName(std::string_view unknown, std::span<const std::string> known) {
    // A much longer name is not a misspelling; skipping it saves time.
    constexpr std::size_t kLongest = 80;
    const std::string_view compared = unknown.substr(0, kLongest);
    const std::string* nearest = nullptr;
    std::size_t smallest = 2 * kLongest;
    for (const std::string& name : known) {
        const std::size_t difference =
            std::max(name.size(), compared.size()) - std::min(name.size(), compared.size());
        if (difference >= smallest) continue;
        const std::size_t distance = editDistance(compared, name);
        if (distance >= smallest) continue;
        smallest = distance;
        nearest = &name;
    }
    if (nearest == nullptr || smallest > std::max<std::size_t>(2, nearest->size() / 3)) return std::nullopt;
    return *nearest;
}

std::string suggestName(std::string_view unknown, std::span<const std::string> known) {
    if (known.empty()) return "there are none";
    if (const auto nearest = nearestName(unknown, known)) {
        return fmt::format("did you mean {}?", inQuotes(*nearest));
    }
    constexpr std::size_t kMost = 12;
    std::string list = "expected one of ";
    for (std::size_t i = 0; i < std::min(known.size(), kMost); ++i) {
        list += (i == 0 ? "" : ", ") + inQuotes(known[i]);
    }
    return list + (known.size() > kMost ? " ..." : "");
}

}  // namespace duolux
