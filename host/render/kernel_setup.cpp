#include "host/render/kernel_setup.h"

#include <algorithm>
#include <cmath>

#include "host/scene/image_plane.h"

namespace duolux {

namespace {

shared::DeviceLightMatrix deviceMatrix(const LightMatrix& m) {
    return {m.m00, m.m01, m.m10, m.m11};
}

/// The reflectance of the first used material: all have it if traits.oneReflectance.
const Reflectance& commonReflectance(const Scene& scene) {
    return scene.reflectanceOf(scene.materials[scene.geometry.materials.front()]);
}

// Part of the work that serves the component of the pixel that is not displayed.
constexpr float kUndisplayedWeight = 1.0f / 16.0f;

shared::PathParams makeParams(const Scene& scene, const DeviceScene& deviceScene) {
    const Camera& camera = scene.camera;
    const ImagePlane plane = imagePlane(camera, scene.render.width, scene.render.height);

    shared::PathParams params{};
    params.cameraPosition = camera.position;
    params.width = scene.render.width;
    params.cameraForward = plane.forward;
    params.height = scene.render.height;
    params.cameraRight = plane.right;
    params.seed = scene.render.seed;
    params.cameraUp = plane.up;
    params.bounces = scene.render.bounces;
    const Reflectance& reflectance = commonReflectance(scene);
    params.opaque = deviceMatrix(reflectance.opaque);
    params.transparent = deviceMatrix(reflectance.transparent);
    const glm::vec2 rows =
        glm::abs(scene.display) / std::max(std::abs(scene.display.x) + std::abs(scene.display.y), 1e-30f) +
        kUndisplayedWeight;
    params.rowWeight = rows / (rows.x + rows.y);
    params.display = scene.display;
    params.inverseQuantum = 1.0f / deviceScene.quantum;
    params.lightCount = deviceScene.lightCount;
    params.emitterRoot = deviceScene.emitterRoot;
    params.emitterLower = deviceScene.emitterBounds.lower;
    params.emitterUpper = deviceScene.emitterBounds.upper;
    params.imageArea = plane.area;
    return params;
}

}  // namespace

Buffer uploadParams(const Device& device, const DeviceScene& deviceScene, const Scene& scene) {
    const shared::PathParams params = makeParams(scene, deviceScene);
    return Buffer::upload(device, BufferUse::kUniform, std::as_bytes(std::span(&params, 1)), "parameters");
}

std::vector<Binding> sceneBindings(const DeviceScene& deviceScene, const Buffer& params) {
    return {
        {shared::kBindingNodes, &deviceScene.nodes},     {shared::kBindingTriangles, &deviceScene.triangles},
        {shared::kBindingNormals, &deviceScene.normals}, {shared::kBindingMaterials, &deviceScene.materials},
        {shared::kBindingLights, &deviceScene.lights},   {shared::kBindingParams, &params}};
}

std::vector<Specialization> sceneSpecialization(const DeviceScene& deviceScene, const Scene& scene,
                                                const Teams& teams) {
    const TransportTraits& traits = deviceScene.traits;
    // Fractions of a subgroup; measured on an 8-wide one, where 4 to 5 and 2 to 4 lanes are within noise of
    // each other.
    return {{shared::kSpecWorkgroupSize, teams.workgroupSize()},
            {shared::kSpecLeaveTraversal, teams.lanes() / 2},
            {shared::kSpecLeaveNodes, teams.lanes() * 3 / 8},
            {shared::kSpecTransmittance, traits.transmittance},
            {shared::kSpecSecondColumn, traits.secondColumn},
            {shared::kSpecInvisibleScatters, traits.invisibleScatters},
            {shared::kSpecVisibleScatters, traits.visibleScatters},
            {shared::kSpecInvisibleCrosses, traits.invisibleCrosses},
            {shared::kSpecVisibleCrosses, traits.visibleCrosses},
            {shared::kSpecOneReflectance, traits.oneReflectance},
            {shared::kSpecSmoothNormals, deviceScene.hasSmoothNormals},
            {shared::kSpecSampler, scene.render.sampler == Sampler::kIndependent ? shared::kSamplerIndependent
                                                                                 : shared::kSamplerSobol},
            {shared::kSpecTeamSize, teams.lanes()}};
}

// On lavapipe 64 samples or more are within noise of each other, but 16 are 12 % slower; it ends the loops of
// a subgroup after 65535 iterations, which rays with many crossings reach early. A GPU needs many teams more
// than it needs this.
std::uint32_t chooseLanePaths(const Device& device, const TransportTraits& traits) {
    if (device.info().kind != DeviceKind::kCpu) return 16u;
    return traits.transmittance == shared::kTransmittanceGeneral ? 32u : 128u;
}

}  // namespace duolux
