#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/scene/scene.h"

namespace duolux {

struct GlVertex {
    glm::vec3 position, normal;
};

/// The scene's triangles in the order of their materials, as OpenGL draws them: corners of equal position and
/// normal are shared.
struct GlMesh {
    std::vector<GlVertex> vertices;
    std::vector<std::uint32_t> indices;
    struct Range {
        std::uint32_t material, first, count;  ///< of indices
    };
    std::vector<Range> ranges;
};

GlMesh makeGlMesh(const Scene& scene);

}  // namespace duolux
