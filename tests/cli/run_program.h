#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace duolux::test {

struct ProgramResult {
    int status = 0;  ///< exit status; 128 + signal if a signal ended it
    std::string out, err;
};

struct ProgramSignal {
    int signal;
    std::chrono::milliseconds after;  ///< since the start
};

/// Runs duolux with arguments in `folder`, and waits for it; sends it a signal on the way if asked to.
ProgramResult runDuolux(const std::filesystem::path& folder, std::vector<std::string> arguments,
                        std::optional<ProgramSignal> signal = std::nullopt);

/// A new empty folder that is removed with everything in it.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

std::string contentsOf(const std::filesystem::path& file);

}  // namespace duolux::test
