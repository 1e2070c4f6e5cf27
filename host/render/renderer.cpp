#include "host/render/renderer.h"

#include <fmt/format.h>

#include <cassert>
#include <new>
#include <utility>

#include "host/base/memory.h"
#include "host/render/context.h"
#include "host/scene/hash.h"

namespace duolux {

namespace {

DeviceScene upload(const Device& device, const Scene& scene, const TuningChoice& tuning) {
    try {
        return uploadScene(device, scene, tuning);
    } catch (const std::bad_alloc&) {
        throw outOfMemory(fmt::format("{}: cannot build trees over {} triangles", scene.source.string(),
                                      scene.geometry.triangles.size()),
                          "expected fewer triangles, or more memory");
    }
}

}  // namespace

Renderer::Renderer(Device& device, Scene scene, const TuningChoice& tuning)
    : device_(device), scene_(std::move(scene)), deviceScene_(upload(device, scene_, tuning)) {}

void Renderer::setSettings(const RenderSettings& settings) {
    upToDate_ = upToDate_ && settings.integrator == scene_.render.integrator &&
                settings.bounces == scene_.render.bounces;
    scene_.render = settings;
}

void Renderer::setReflectance(const Reflectance& reflectance) {
    upToDate_ = upToDate_ && reflectance == scene_.reflectance;
    scene_.reflectance = reflectance;
}

void Renderer::setMaterials(std::vector<Material> materials) {
    assert(materials.size() == scene_.materials.size());
    upToDate_ = upToDate_ && materials == scene_.materials;
    scene_.materials = std::move(materials);
}

RenderOutput Renderer::render(const RenderControl& control) {
    if (!upToDate_) replaceMaterials(deviceScene_, device_, scene_);
    upToDate_ = true;
    return renderOnDevice(device_, scene_, deviceScene_, control);
}

RenderOutput render(Device& device, const Scene& scene, const RenderControl& control) {
    DeviceScene deviceScene = upload(device, scene, control.tuning);
    deviceScene.tree = {};  // rendered once, it is not changed
    return renderOnDevice(device, scene, deviceScene, control);
}

}  // namespace duolux
