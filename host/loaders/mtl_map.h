#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "host/scene/texture.h"

namespace duolux {

/// The arguments of a statement in an MTL file that names an image: options, then the file.
struct MtlMap {
    std::string_view file;  ///< empty if there is none
    Wrap wrap = Wrap::kRepeat;
    Filter filter = Filter::kLinear;
    UvTransform transform;                 ///< in this project's convention, v down the image
    double scale = 1.0;                    ///< -bm, of bumps and normals
    double base = 0.0, gain = 1.0;         ///< -mm, of values
    std::uint32_t channel = 0;             ///< as MaterialTexture
    bool hasChannel = false;               ///< whether the statement chooses it
    std::vector<std::string_view> unused;  ///< options without effect here
};
MtlMap readMtlMap(std::string_view arguments);

}  // namespace duolux
