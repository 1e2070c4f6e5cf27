#include "host/render/kernel_setup.h"

#include <algorithm>
#include <cmath>

#include "host/device_scene/device_camera.h"
#include "shaders/shared/bvh_layout.h"

namespace duolux {

namespace {

/// Whether rays visit the surfaces along them one by one.
bool visitsSurfaces(const TransportTraits& traits) {
    return traits.transparency == shared::kTransparencyGeneral ||
           traits.transparency == shared::kTransparencyCoverage;
}

shared::DeviceReflectanceMatrix deviceMatrix(const ReflectanceMatrix& m) {
    return {m.m00, m.m01, m.m10, m.m11};
}

/// The reflectance of the first used material; shared by all materials if traits.oneReflectance is true.
const Reflectance& commonReflectance(const Scene& scene) {
    return scene.reflectanceOf(scene.materials[scene.geometry.materials.front()]);
}

std::uint32_t deviceKind(Sampler sampler) {
    switch (sampler) {
        case Sampler::kSobol:
            return shared::kSamplerSobol;
        case Sampler::kIndependent:
            return shared::kSamplerIndependent;
    }
    return shared::kSamplerSobol;
}

// Fraction of the work that is spent on the component of the pixel that is not displayed.
constexpr float kUndisplayedWeight = 1.0f / 16.0f;

shared::PathParams makeParams(const RenderInputs& inputs) {
    const auto& [device, deviceScene, scene, settings] = inputs;
    shared::PathParams params{};
    params.camera = deviceCamera(scene.camera, settings.width, settings.height, boundsOf(scene.geometry));
    params.seed = settings.seed;
    params.bounces = settings.bounces;
    const Reflectance& reflectance = commonReflectance(scene);
    params.opaque = deviceMatrix(reflectance.opaque);
    params.transparent = deviceMatrix(reflectance.transparent);
    const glm::vec2 rows =
        glm::abs(scene.display) / std::max(std::abs(scene.display.x) + std::abs(scene.display.y), 1e-30f) +
        kUndisplayedWeight;
    params.rowWeight = rows / (rows.x + rows.y);
    params.display = scene.display;
    params.emitterCount = deviceScene.transport.emitterChoices;
    params.emittingTriangles = static_cast<std::uint32_t>(deviceScene.emittingTriangles.size());
    params.emitterRoot = deviceScene.emitterRoot;
    params.emitterLower = deviceScene.emitterBounds.lower;
    params.emitterUpper = deviceScene.emitterBounds.upper;
    return params;
}

}  // namespace

Buffer uploadParams(const RenderInputs& inputs) {
    const shared::PathParams params = makeParams(inputs);
    return Buffer::upload(inputs.device, BufferUse::kUniform, std::as_bytes(std::span(&params, 1)),
                          "parameters");
}

std::vector<Binding> sceneBindings(const DeviceScene& deviceScene, const Buffer& params) {
    std::vector<Binding> bindings = deviceScene.bindings();
    bindings.push_back({shared::kBindingParams, &params});
    return bindings;
}

std::vector<Specialization> sceneSpecialization(const RenderInputs& inputs) {
    const auto& [device, deviceScene, scene, settings] = inputs;
    const TransportTraits& traits = deviceScene.transport.traits;
    const Tuning& tuning = deviceScene.tuning;
    const bool costly = traits.lobes != shared::kLobeDiffuse || visitsSurfaces(traits);
    return {{shared::kSpecWorkgroupSize, tuning.workgroupSize},
            {shared::kSpecLeaveTraversal, costly ? tuning.leaveTraversalCostly : tuning.leaveTraversal},
            {shared::kSpecLeaveNodes, tuning.leaveNodes},
            {shared::kSpecVoteByShuffle, tuning.voteByShuffle},
            {shared::kSpecTransparency, traits.transparency},
            {shared::kSpecSecondColumn, traits.secondColumn},
            {shared::kSpecInvisibleScatters, traits.invisibleScatters},
            {shared::kSpecVisibleScatters, traits.visibleScatters},
            {shared::kSpecInvisibleCrosses, traits.invisibleCrosses},
            {shared::kSpecVisibleCrosses, traits.visibleCrosses},
            {shared::kSpecOneReflectance, traits.oneReflectance},
            {shared::kSpecLobes, traits.lobes},
            {shared::kSpecEmitterKinds, deviceScene.transport.emitterKinds},
            {shared::kSpecCamera, deviceKind(scene.camera.type)},
            {shared::kSpecSmoothNormals, deviceScene.hasSmoothNormals},
            {shared::kSpecCoverage, deviceScene.transport.traits.coverage},
            {shared::kSpecVertexColours, deviceScene.hasVertexColours},
            {shared::kSpecTextureGroups, deviceScene.transport.textureGroups},
            {shared::kSpecVertexRecords, deviceScene.vertexNeeds.records},
            {shared::kSpecSecondUvs, deviceScene.vertexNeeds.secondUvs},
            {shared::kSpecPlanes, deviceScene.hasPlanes},
            {shared::kSpecSampler, deviceKind(settings.sampler)},
            {shared::kSpecTeamSize, tuning.lanes}};
}

std::uint32_t lanePaths(const DeviceScene& deviceScene) {
    const Tuning& tuning = deviceScene.tuning;
    return visitsSurfaces(deviceScene.transport.traits) ? tuning.laneCrossingPaths : tuning.lanePaths;
}

}  // namespace duolux
