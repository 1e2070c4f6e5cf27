#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>

namespace duolux::test {

/// AddressSanitizer needs more address space than any limit allows.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kAddressSanitizer = true;
#else
inline constexpr bool kAddressSanitizer = false;
#endif

/// Limits the additional bytes that this process can map during its lifetime. Has no effect under
/// AddressSanitizer.
class AddressSpaceLimit {
  public:
    explicit AddressSpaceLimit(std::size_t more) {
        ::getrlimit(RLIMIT_AS, &old_);
        if (kAddressSanitizer) return;
        std::size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        rlimit limit = old_;
        limit.rlim_cur = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + more;
        ::setrlimit(RLIMIT_AS, &limit);
    }
    ~AddressSpaceLimit() { ::setrlimit(RLIMIT_AS, &old_); }
    AddressSpaceLimit(const AddressSpaceLimit&) = delete;
    AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

  private:
    rlimit old_{};
};

}  // namespace duolux::test
