#pragma once

#include <vector>

#include "host/device_scene/device_scene.h"
#include "host/render/render.h"
#include "host/scene/scene.h"

namespace duolux {

/// A scene on a device, to be rendered many times: with other cameras, settings, reflectances, materials and
/// point emitters. The next render uploads what was set:
///   - for another camera, display or settings, only parameters, and the integrator's table of emitters;
///   - for other reflectances, materials or point emitters, their records.
/// It uploads the triangles again if the set of emitting triangles changes, if materials use other images or
/// begin or cease to use tangents, if emission varies over a triangle, if light begins or ceases to pass
/// unchanged through all surfaces, or, where surfaces coincide, at any change of materials, reflectances,
/// point emitters or the integrator. The tree over all triangles is built once, except that of
/// the driver (Layout::kRayQuery), which is built again with the triangles. See updateScene.
class Renderer {
  public:
    /// `device` must outlive this. Throws InputError as validate, and as uploadScene.
    Renderer(Device& device, Scene scene, const TuningChoice& tuning = {});

    const Scene& scene() const { return scene_; }

    void setCamera(const Camera& camera) { scene_.camera = camera; }
    void setDisplay(glm::vec2 display) { scene_.display = display; }
    /// Replaces the scene-wide reflectance.
    void setReflectance(const Reflectance& reflectance);
    /// Replaces all materials by the same number of others, which may emit where those did not. Throws
    /// UsageError if their number differs.
    void setMaterials(std::vector<Material> materials);
    /// Replaces all point emitters by any number of others.
    void setPointEmitters(std::vector<PointEmitter> emitters);

    /// The same bits as duolux::render of the same scene, whatever was rendered before. Ignores
    /// `control.tuning`. Throws as that function: InputError if what was set is not valid. If
    /// memory does not suffice for what was set, the next render tries again.
    RenderOutput render(const RenderSettings& settings, const RenderControl& control = {});

  private:
    Device& device_;
    Scene scene_;
    Integrator integrator_ = Integrator::kPathTracer;  ///< that the device scene is made for
    DeviceScene deviceScene_;
    bool upToDate_ = true;  ///< the device knows of the materials and emitters
};

}  // namespace duolux
