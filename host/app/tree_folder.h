#pragma once

#include <filesystem>

namespace duolux {

/// Where the user's trees of large scenes are kept: $XDG_CACHE_HOME/duolux, or ~/.cache/duolux. Empty if
/// DUOLUX_NO_CACHE is set or the user has no home folder.
std::filesystem::path userTreeFolder();

}  // namespace duolux
