#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "shaders/shared/bvh_layout.h"

// Children of nodes that no builder would make.

namespace duolux::test {

/// `meta`: see bvh_layout.h.
inline void setChild(shared::WideNode& node, int slot, std::uint32_t meta, glm::uvec3 lower,
                     glm::uvec3 upper) {
    node.meta[slot] = static_cast<std::uint8_t>(meta);
    if ((meta >> 5) == 1 && (meta & 31) >= 24)
        node.innerMask = static_cast<std::uint8_t>(node.innerMask | 1 << slot);
    for (int axis = 0; axis < 3; ++axis) {
        node.lower[axis][slot] = static_cast<std::uint8_t>(lower[axis]);
        node.upper[axis][slot] = static_cast<std::uint8_t>(upper[axis]);
    }
}

inline std::uint32_t innerMeta(int slot) {
    return shared::kMetaInner | (24u + static_cast<std::uint32_t>(slot));
}

inline std::uint32_t leafMeta(std::uint32_t count, std::uint32_t offset) {
    return ((1u << count) - 1) << 5 | offset;
}

}  // namespace duolux::test
