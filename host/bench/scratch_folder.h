#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "host/base/error.h"

namespace duolux {

/// A new folder for scenes and pictures of a benchmark; gone with all that is in it at the end of its scope.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "duolux-bench-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw MachineError(fmt::format("{}: cannot be made", name));
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace duolux
