#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace duolux {

// The files that a command writes: what can be known before the work is told before it, and what goes wrong
// after it costs no other file.

/// A file that a command will write, and the option that names it.
struct OutputFile {
    std::string option, file;
    bool image = true;  ///< its extension must be an image's
};

/// Says before the work what would go wrong after it: formats that are not known, folders that are missing or
/// in the place of files, whatever else would keep a file from being written, and files that would overwrite
/// one another or one of `inputs`. Throws UsageError.
void checkOutputs(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs);

/// Says which of the outputs would overwrite one of the files that have been read. Throws UsageError.
void checkNotRead(const std::vector<OutputFile>& outputs, const std::vector<std::filesystem::path>& inputs);

/// Writes all the outputs of a command though some fail.
class WriteAll {
  public:
    /// Calls `write` with the path of the file. If that fails, whatever is thrown, `write` is called with new
    /// names beside it, in the current folder and in that for temporary files, until one works.
    void operator()(const std::string& file, const std::function<void(const std::filesystem::path&)>& write);

    bool failed() const { return !failures_.empty(); }

    /// Says on standard error what failed, and where the files are instead.
    void sayFailures() const;

    /// Says the same, and throws MachineError if anything failed.
    void finish() const;

  private:
    std::vector<std::string> failures_;
};

/// Writes the text of a report: to a file, or to standard output for "-". Throws MachineError.
void writeReport(const std::filesystem::path& file, const std::string& text);

}  // namespace duolux
