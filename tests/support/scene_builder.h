#pragma once

#include <cstdint>
#include <string>

#include "host/scene/scene.h"
#include "tests/reference/matrix2.h"

namespace duolux::test {

/// A 2x2 matrix with the same entries in all channels.
ReflectanceMatrix matrix(float m00, float m01, float m10, float m11);

Reflectance preset(const char* name);

/// Emitted radiance per channel.
reference::ChannelLight lightOf(const Emission& emission);

/// Absorbs, does not emit, and transmits by `transparent`.
Material filter(const std::string& name, const ReflectanceMatrix& transparent);

enum class Facing : std::uint8_t { kOutward, kInward };

/// Builds a scene triangle by triangle.
class SceneBuilder {
  public:
    /// Index of the new material.
    std::uint32_t add(const Material& material);
    /// Corners counter-clockwise as seen from the front.
    void triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c, std::uint32_t material);
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, std::uint32_t material);
    /// An icosahedron subdivided `level` times, corners on the sphere: convex and closed.
    void sphere(glm::vec3 centre, float radius, int level, Facing facing, std::uint32_t material);
    void box(glm::vec3 lower, glm::vec3 upper, Facing facing, std::uint32_t material);

    LoadedScene scene;  ///< geometry and materials are filled by the calls above; the rest is the caller's
};

/// The same scene scaled by `scale` about the origin, then moved.
LoadedScene transformed(LoadedScene scene, float scale, glm::vec3 offset = glm::vec3(0.0f));

}  // namespace duolux::test
