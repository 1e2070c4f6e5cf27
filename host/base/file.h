#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace duolux {

/// The whole file as bytes. Throws InputError if it cannot be read.
std::string readFile(const std::filesystem::path& path);

/// An empty file that is being written. Every failure throws std::system_error.
class FileWriter {
  public:
    /// Takes over an open file.
    explicit FileWriter(int descriptor);
    ~FileWriter();
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    void write(std::string_view bytes);
    std::uint64_t position() const;
    void seek(std::uint64_t position);

    /// Waits until all is on the disk.
    void synchronise();
    int descriptor() const;

  private:
    std::FILE* file_;
};

/// Writes a file so that a reader sees the old one or the complete new one, never a part: `write` fills a
/// temporary in the same folder, which is renamed over `path` once it is on the disk, and removed if anything
/// throws. The old file's permissions stay, and its owner where that is permitted; a write-protected file is
/// not replaced.
/// A symbolic link stays one: the file that it names is written. What is no regular file, as a device or a
/// pipe, is written into, as is a file that cannot be replaced (in a folder without permission, or a mount).
/// Throws MachineError naming `path`; errors of this program that `write` throws pass through.
void writeFileAtomically(const std::filesystem::path& path, const std::function<void(FileWriter&)>& write);

/// Writes a whole file like that.
void writeFile(const std::filesystem::path& path, std::string_view bytes);

/// Whether two paths name the same file, which need not be there, however they are spelled and linked.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// Throws MachineError if writeFileAtomically could not write the file now. Leaves nothing behind.
void checkWritable(const std::filesystem::path& path);

}  // namespace duolux
