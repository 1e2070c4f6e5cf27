#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace duolux {

// The files that a command writes. Foreseeable problems are reported before the work, and a file that cannot
// be written afterwards does not affect the others.

/// A file that a command will write, and the option that names it.
struct OutputFile {
    std::string option, file;
    bool image = true;  ///< whether it must have an image's extension
};

/// Checks outputs before the work: unknown formats, missing folders, folders in place of files, anything else
/// that prevents a file from being written, and files that would overwrite each other or one of `inputs`.
/// Throws UsageError.
void checkOutputs(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs);

/// Throws UsageError if an output would overwrite one of the files that have been read.
void checkNotRead(const std::vector<OutputFile>& outputs, const std::vector<std::filesystem::path>& inputs);

/// Writes all outputs of a command, even if some fail.
class WriteAll {
  public:
    /// Calls `write` with the path of the file. If this throws anything, `write` is called with new names in
    /// the same folder, in the current folder and in the folder for temporary files, until one works.
    void operator()(const std::string& file, const std::function<void(const std::filesystem::path&)>& write);

    bool failed() const { return !failures_.empty(); }

    /// Reports on standard error which files failed, and where they are instead.
    void sayFailures() const;

    /// Reports the same, and throws MachineError if any file failed.
    void finish() const;

  private:
    std::vector<std::string> failures_;
};

/// Writes the text of a report: to a file, or to standard output for "-". Throws MachineError.
void writeReport(const std::filesystem::path& file, const std::string& text);

}  // namespace duolux
