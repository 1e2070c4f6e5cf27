#include "host/app/tree_folder.h"

#include <cstdlib>

namespace duolux {

std::filesystem::path userTreeFolder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::filesystem::path(value != nullptr ? value : "");
    };
    if (!variable("DUOLUX_NO_CACHE").empty()) return {};
    // The XDG Base Directory Specification requires that relative paths are ignored.
    if (const auto caches = variable("XDG_CACHE_HOME"); caches.is_absolute()) return caches / "duolux";
    if (const auto home = variable("HOME"); home.is_absolute()) return home / ".cache" / "duolux";
    return {};
}

}  // namespace duolux
