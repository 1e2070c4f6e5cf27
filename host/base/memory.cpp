#include "host/base/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <limits>

namespace duolux {

std::uint64_t addressSpaceLimit() {
    rlimit limit{};
    const bool limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return limited ? limit.rlim_cur : std::numeric_limits<std::uint64_t>::max();
}

std::string addressSpaceHint() {
    const std::uint64_t limit = addressSpaceLimit();
    if (limit == std::numeric_limits<std::uint64_t>::max()) return "";
    return fmt::format("; this process may use only {} MiB of address space, see 'ulimit -v'", limit >> 20);
}

}  // namespace duolux
