#pragma once

#include <cstdint>
#include <string>

namespace duolux {

/// Bytes of address space that this process may use (`ulimit -v`); the largest number if there is no limit.
std::uint64_t addressSpaceLimit();

/// For the end of a message about a lack of memory: what limits the address space, if anything does.
std::string addressSpaceHint();

}  // namespace duolux
