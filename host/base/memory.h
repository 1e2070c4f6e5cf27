#pragma once

#include <cstdint>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

#include "host/base/error.h"

namespace duolux {

/// Bytes of address space that this process may use (`ulimit -v`); the largest number if there is no limit.
std::uint64_t addressSpaceLimit();

/// Throws MemoryError if the limit on the address space does not leave `bytes` for `what`, for example a
/// library that does not survive a failed allocation.
void requireAddressSpace(std::uint64_t bytes, std::string_view what);

/// The end of an out-of-memory message: the limit on the address space, or nothing if there is none.
std::string addressSpaceHint();

/// The exception for a lack of memory for `what`. `remedy`: what would help, for example "expected a smaller
/// size".
MemoryError outOfMemory(std::string_view what, std::string_view remedy);

/// The exception for a file that does not fit into memory.
MemoryError outOfMemoryReading(const std::filesystem::path& file);

/// Runs `step`, which reads a file. If memory runs out, the exception names the file.
template <typename Step>
auto withMemoryToRead(const std::filesystem::path& file, const Step& step) {
    try {
        return step();
    } catch (const std::bad_alloc&) {
        throw outOfMemoryReading(file);
    }
}

}  // namespace duolux
