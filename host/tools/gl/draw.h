#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "host/base/named.h"
#include "host/scene/scene.h"
#include "host/tools/gl/spot_lights.h"
#include "host/tools/gl/vertices.h"

namespace duolux {

/// How surfaces are lit. Both evaluate the same equation.
enum class Lighting : std::uint8_t {
    kFixedFunction,  ///< OpenGL's own, at vertices, interpolated between them
    kPerFragment,    ///< by a shader, at fragments
    kWireframe  ///< none: the edges of the triangles, in the colours of their materials, hidden lines removed
};

const char* nameOf(Lighting lighting);  ///< "fixed-function", "per-fragment", "wireframe"
template <>
inline constexpr std::array kValuesOf<Lighting>{Lighting::kFixedFunction, Lighting::kPerFragment,
                                                Lighting::kWireframe};

struct DrawOptions {
    Lighting lighting = Lighting::kFixedFunction;
    std::uint32_t passes = 64;  ///< jittered images that are averaged: samples per pixel
    /// The part of the image to draw, magnified to the full size: left, top, width, height as fractions.
    std::array<float, 4> window{0.0f, 0.0f, 1.0f, 1.0f};
};

struct DrawStatistics {
    std::uint32_t lightsAtOnce = 0;   ///< in one drawing of the scene
    std::uint64_t sceneDrawings = 0;  ///< passes, times batches of lights
    std::uint64_t vertices = 0;       ///< after sharing
};

/// A scene in OpenGL's memory, with floating-point render targets of its size. Requires a current GlContext,
/// which must outlive it.
class GlScene {
  public:
    /// Throws MachineError if the driver cannot draw to images of floats.
    GlScene(const Scene& scene, const RenderSettings& settings);
    ~GlScene();
    GlScene(const GlScene&) = delete;
    GlScene& operator=(const GlScene&) = delete;

    /// Displayed radiance per pixel, rows from the top, neither clamped nor rounded.
    std::vector<glm::vec3> draw(std::span<const SpotLight> lights, const DrawOptions& options);

    const DrawStatistics& statistics() const { return statistics_; }

  private:
    struct Objects;

    void drawOnce(std::span<const SpotLight> lights, Lighting lighting);
    void drawFixedFunction(std::span<const SpotLight> lights, bool withEmission);
    void drawPerFragment(std::span<const SpotLight> lights, bool withEmission);
    void drawWireframe();
    void drawRanges(const std::function<void(const Material&)>& setMaterial);

    const Scene& scene_;
    const RenderSettings& settings_;
    std::unique_ptr<Objects> objects_;
    GlMesh mesh_;
    DrawStatistics statistics_;
};

}  // namespace duolux
