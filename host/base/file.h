#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace duolux {

/// The folder of the file that a path names; "." for a name alone.
std::filesystem::path folderOf(const std::filesystem::path& path);

/// Reads a whole file. Throws InputError if it cannot be read.
std::string readFile(const std::filesystem::path& path);

/// Writes to an empty file. Every failure throws std::system_error.
class FileWriter {
  public:
    /// Takes ownership of an open file.
    explicit FileWriter(int descriptor);
    ~FileWriter();
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    void write(std::string_view bytes);
    std::uint64_t position() const;
    void seek(std::uint64_t position);

    /// Waits until all data is on the disk.
    void synchronise();
    int descriptor() const;

  private:
    std::FILE* file_;
};

/// Writes a file atomically: a reader sees either the old file or the complete new one. `write` fills a
/// temporary file in the same folder, which is renamed to `path` once it is on the disk, and removed if
/// anything throws. The old file's permissions are kept, and its owner if permitted. A write-protected file
/// is not replaced. A symbolic link is followed and kept. Devices, pipes, and files that cannot be replaced
/// (in a folder without permission, or a mount point) are written to directly, once `write` has filled a file
/// in memory or the temporary file; pipes wait for a reader (see stream.h). Throws MachineError with `path`;
/// duolux::Error exceptions of `write` pass through.
void writeFileAtomically(const std::filesystem::path& path, const std::function<void(FileWriter&)>& write);

/// Writes a whole file with writeFileAtomically.
void writeFile(const std::filesystem::path& path, std::string_view bytes);

/// Whether two paths name the same file, also through links or different spellings. It need not exist.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// Throws MachineError if writeFileAtomically could not write the file now. Leaves no files behind.
void checkWritable(const std::filesystem::path& path);

}  // namespace duolux
