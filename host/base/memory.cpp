#include "host/base/memory.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <limits>
#include <system_error>

namespace duolux {

std::uint64_t addressSpaceLimit() {
    rlimit limit{};
    const bool limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return limited ? limit.rlim_cur : std::numeric_limits<std::uint64_t>::max();
}

void requireAddressSpace(std::uint64_t bytes, std::string_view what) {
    if (addressSpaceLimit() == std::numeric_limits<std::uint64_t>::max()) return;
    void* const all = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (all == MAP_FAILED) throw outOfMemory(what, fmt::format("expected {} MiB more", bytes >> 20));
    ::munmap(all, bytes);
}

std::string addressSpaceHint() {
    const std::uint64_t limit = addressSpaceLimit();
    if (limit == std::numeric_limits<std::uint64_t>::max()) return "";
    return fmt::format("; this process may use only {} MiB of address space, see 'ulimit -v'", limit >> 20);
}

MemoryError outOfMemory(std::string_view what, std::string_view remedy) {
    return MemoryError(fmt::format("{}: out of memory{}; {}", what, addressSpaceHint(), remedy));
}

MemoryError outOfMemoryReading(const std::filesystem::path& file) {
    std::error_code unknown;
    const auto bytes = std::filesystem::file_size(file, unknown);
    const std::string size =
        unknown ? "" : fmt::format(" ({:.1f} MiB)", static_cast<double>(bytes) / (1 << 20));
    return outOfMemory(fmt::format("{}: cannot read it{}", file.string(), size),
                       "expected a smaller file, or more memory");
}

}  // namespace duolux
