#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/base/error.h"
#include "host/base/memory.h"
#include "tests/support/address_space.h"

namespace duolux {
namespace {

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;

TEST(AddressSpace, IsRequiredOnlyUnderALimit) {
    EXPECT_NO_THROW(requireAddressSpace(~std::uint64_t{0} / 2, "anything"));
}

TEST(AddressSpace, ThatIsLeftIsEnoughAndNoMore) {
    if (test::kAddressSanitizer) return;  // no limit is set
    const test::AddressSpaceLimit limit(100 * kMebibyte);
    for (int i = 0; i < 3; ++i)
        EXPECT_NO_THROW(requireAddressSpace(80 * kMebibyte, "compiling"));
    try {
        requireAddressSpace(120 * kMebibyte, "compiling");
        FAIL();
    } catch (const MemoryError& e) {
        EXPECT_THAT(e.what(), testing::StartsWith("compiling: out of memory; this process may use only "));
        EXPECT_THAT(e.what(), testing::EndsWith("see 'ulimit -v'; expected 120 MiB more"));
    }
}

}  // namespace
}  // namespace duolux
