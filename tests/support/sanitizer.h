#pragma once

namespace duolux::test {

/// The address sanitizer takes more address space than any limit leaves.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool kAddressSanitizer = true;
#else
inline constexpr bool kAddressSanitizer = false;
#endif

}  // namespace duolux::test
