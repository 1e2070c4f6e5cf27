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

/// For the end of a message about a lack of memory: what limits the address space, if anything does.
std::string addressSpaceHint();

/// What to throw where memory does not suffice for `what`; `remedy`: what would help, as in "expected a
/// smaller size".
MachineError outOfMemory(std::string_view what, std::string_view remedy);

/// What to throw where a file does not fit into memory.
MachineError outOfMemoryReading(const std::filesystem::path& file);

/// Carries out what reads a file; a lack of memory names it.
template <typename Step>
auto withMemoryToRead(const std::filesystem::path& file, const Step& step) {
    try {
        return step();
    } catch (const std::bad_alloc&) {
        throw outOfMemoryReading(file);
    }
}

}  // namespace duolux
