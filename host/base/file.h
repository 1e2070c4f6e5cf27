#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace duolux {

/// The whole file as bytes. Throws InputError if it cannot be read.
std::string readFile(const std::filesystem::path& path);

/// Writes a file so that a reader sees the old one or the complete new one, never a part: `write` is given
/// the path of a temporary in the same folder, which is then renamed over `path`. The temporary is removed if
/// `write` throws. A symbolic link stays one: the file that it names is replaced. What is neither a file nor
/// a link, as a device or a pipe, stays what it is, too, and is written into. What was written is on the disk
/// before it takes the old one's place. Throws MachineError naming `path` if the folder cannot be written to.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& temporary)>& write);

/// Writes a whole file like that.
void writeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace duolux
