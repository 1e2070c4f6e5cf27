#pragma once

#include <cstdint>
#include <set>
#include <span>

#include "host/vk/kernel.h"

namespace duolux::test {

/// The ids of the specialisation constants of a kernel (SPIR-V 1.5, 2.3 and 3.20).
inline std::set<std::uint32_t> specIds(std::span<const std::uint32_t> spirv) {
    constexpr std::size_t kHeaderWords = 5;
    constexpr std::uint32_t kOpDecorate = 71, kSpecId = 1;
    std::set<std::uint32_t> ids;
    for (std::size_t at = kHeaderWords; at < spirv.size(); at += spirv[at] >> 16) {
        if ((spirv[at] & 0xffffu) == kOpDecorate && spirv[at + 2] == kSpecId) ids.insert(spirv[at + 3]);
    }
    return ids;
}

/// The ids to which the host gives no value, so that the default in the kernel's source applies.
inline std::set<std::uint32_t> idsLeftOut(std::span<const std::uint32_t> spirv,
                                          std::span<const Specialization> given) {
    std::set<std::uint32_t> ids = specIds(spirv);
    for (const Specialization& constant : given)
        ids.erase(constant.id);
    return ids;
}

}  // namespace duolux::test
