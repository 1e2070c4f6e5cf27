#pragma once

#include <cstddef>
#include <filesystem>

namespace duolux {

// Pipes and devices, which are written to as they are. A pipe waits for its reader, until a signal or
// stopAwaitingReaders().

/// Whether this is a named pipe.
bool isPipe(const std::filesystem::path& path);

/// From now on, writing to a pipe fails if it has no reader, or if its reader reads nothing for a second. For
/// the whole process. Signal handlers may call it.
void stopAwaitingReaders() noexcept;

/// Opens a pipe or device for writing. Returns its descriptor, or -1 and sets errno.
int openStream(const std::filesystem::path& path);

/// Writes all bytes to a file or stream. Throws std::system_error.
void writeAll(int file, const char* bytes, std::size_t count);

}  // namespace duolux
