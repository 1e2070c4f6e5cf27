#include "host/render/renderer.h"

#include <fmt/format.h>

#include <new>
#include <utility>

#include "host/base/error.h"
#include "host/base/memory.h"
#include "host/render/context.h"
#include "host/scene/validate.h"

namespace duolux {

namespace {

/// Calls `prepare`, which builds trees and uploads; reports that memory has run out as MemoryError.
template <typename Prepare>
auto withinMemory(const Scene& scene, Prepare&& prepare) {
    try {
        return prepare();
    } catch (const std::bad_alloc&) {
        throw outOfMemory(fmt::format("{}: cannot build trees over {} triangles", scene.source.string(),
                                      scene.geometry.triangles.size()),
                          "expected fewer triangles, or more memory");
    }
}

DeviceScene upload(const Device& device, const Scene& scene, Integrator integrator,
                   const TuningChoice& tuning) {
    validate(scene);
    return withinMemory(scene, [&] { return uploadScene(device, scene, integrator, tuning); });
}

}  // namespace

Renderer::Renderer(Device& device, Scene scene, const TuningChoice& tuning)
    : device_(device), scene_(std::move(scene)), deviceScene_(upload(device, scene_, integrator_, tuning)) {}

void Renderer::setReflectance(const Reflectance& reflectance) {
    upToDate_ = upToDate_ && reflectance == scene_.reflectance;
    scene_.reflectance = reflectance;
}

void Renderer::setMaterials(std::vector<Material> materials) {
    if (materials.size() != scene_.materials.size()) {
        throw UsageError(fmt::format("{} materials cannot replace the {} of the scene; expected as many",
                                     materials.size(), scene_.materials.size()));
    }
    upToDate_ = upToDate_ && materials == scene_.materials;
    scene_.materials = std::move(materials);
}

void Renderer::setPointEmitters(std::vector<PointEmitter> emitters) {
    upToDate_ = false;
    scene_.pointEmitters = std::move(emitters);
}

RenderOutput Renderer::render(const RenderSettings& settings, const RenderControl& control) {
    validateExceptGeometry(scene_);
    if (!upToDate_ || settings.integrator != integrator_) {
        upToDate_ = false;
        withinMemory(scene_, [&] { updateScene(deviceScene_, device_, scene_, settings.integrator); });
    }
    integrator_ = settings.integrator;
    upToDate_ = true;
    return renderOnDevice(device_, scene_, deviceScene_, settings, control);
}

RenderOutput render(Device& device, const Scene& scene, const RenderSettings& settings,
                    const RenderControl& control) {
    if (control.onStage) control.onStage("building trees");
    DeviceScene deviceScene = upload(device, scene, settings.integrator, control.tuning);
    deviceScene.tree = {};  // rendered once, it is not changed
    return renderOnDevice(device, scene, deviceScene, settings, control);
}

}  // namespace duolux
