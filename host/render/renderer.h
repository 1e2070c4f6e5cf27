#pragma once

#include <vector>

#include "host/device_scene/device_scene.h"
#include "host/render/render.h"
#include "host/scene/scene.h"

namespace duolux {

/// A scene on a device, to be rendered many times: with other cameras, settings, reflectances and emitters.
/// Triangles are uploaded, and their tree is built, once.
class Renderer {
  public:
    /// `device` must outlive this. Throws as uploadScene.
    Renderer(Device& device, Scene scene, const TuningChoice& tuning = {});

    const Scene& scene() const { return scene_; }

    void setCamera(const Camera& camera) { scene_.camera = camera; }
    void setDisplay(glm::vec2 display) { scene_.display = display; }
    /// Replaces the scene-wide reflectance.
    void setReflectance(const Reflectance& reflectance);
    /// Replaces all materials by the same number of others, which may emit where those did not.
    void setMaterials(std::vector<Material> materials);

    /// The same bits as duolux::render of the same scene, whatever was rendered before. Ignores
    /// `control.tuning`. Throws as that function.
    RenderOutput render(const RenderSettings& settings, const RenderControl& control = {});

  private:
    Device& device_;
    Scene scene_;
    Integrator integrator_ = Integrator::kPathTracer;  ///< that the device scene is made for
    DeviceScene deviceScene_;
    bool upToDate_ = true;  ///< the device knows of the materials
};

}  // namespace duolux
