#include "host/render/path_kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "shaders/embedded.h"

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
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);
    const float halfHeight = std::tan(glm::radians(camera.vfov) / 2.0f);
    const float aspect = static_cast<float>(scene.render.width) / static_cast<float>(scene.render.height);

    shared::PathParams params{};
    params.cameraPosition = camera.position;
    params.width = scene.render.width;
    params.cameraForward = forward;
    params.height = scene.render.height;
    params.cameraRight = right * (halfHeight * aspect);
    params.seed = scene.render.seed;
    params.cameraUp = up * halfHeight;
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
    return params;
}

std::uint32_t chooseWorkgroupSize(const Device& device) {
    const auto limits = device.physical().getProperties().limits;
    const std::uint32_t wanted = device.info().kind == DeviceKind::kCpu ? 256u : 64u;
    return std::min({wanted, limits.maxComputeWorkGroupSize[0], limits.maxComputeWorkGroupInvocations});
}

std::vector<Specialization> specialize(const Device& device, const DeviceScene& deviceScene,
                                       const Scene& scene, std::uint32_t workgroupSize) {
    const TransportTraits& traits = deviceScene.traits;
    // Fractions of a subgroup; measured on an 8-wide one, where 5 to 6 and 2 to 4 lanes are within noise of
    // each other.
    const std::uint32_t width = std::max(device.info().subgroupSize, 1u);
    return {{shared::kSpecWorkgroupSize, workgroupSize},
            {shared::kSpecLeaveTraversal, width * 5 / 8},
            {shared::kSpecLeaveNodes, width * 3 / 8},
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
            {shared::kSpecHasLights, deviceScene.lightCount > 0},
            {shared::kSpecEmitterTree, deviceScene.hasEmitters}};
}

Buffer uploadParams(const Device& device, const DeviceScene& deviceScene, const Scene& scene) {
    const shared::PathParams params = makeParams(scene, deviceScene);
    return Buffer::upload(device, BufferUse::kUniform, std::as_bytes(std::span(&params, 1)), "parameters");
}

}  // namespace

PathKernel::PathKernel(const Device& device, const DeviceScene& deviceScene, const Scene& scene,
                       std::span<const std::uint32_t> pixels, std::uint32_t maxSlots)
    : workgroupSize_(chooseWorkgroupSize(device)),
      maxSlots_(maxSlots),
      params_(uploadParams(device, deviceScene, scene)),
      pixels_(Buffer::upload(device, BufferUse::kTexels, pixels, "pixel order")),
      results_(Buffer::readback(device, 2 * sizeof(shared::SlotResult) * std::uint64_t{maxSlots}, "results")),
      kernel_(device, "path", spirv::kPathKernel,
              std::array<Binding, 8>{{{shared::kBindingNodes, &deviceScene.nodes},
                                      {shared::kBindingTriangles, &deviceScene.triangles},
                                      {shared::kBindingNormals, &deviceScene.normals},
                                      {shared::kBindingMaterials, &deviceScene.materials},
                                      {shared::kBindingLights, &deviceScene.lights},
                                      {shared::kBindingParams, &params_},
                                      {shared::kBindingPixels, &pixels_},
                                      {shared::kBindingResults, &results_}}},
              specialize(device, deviceScene, scene, workgroupSize_), sizeof(shared::DispatchParams)),
      commands_{CommandSlot(device), CommandSlot(device)} {}

std::uint64_t PathKernel::deviceBytes() const {
    return params_.allocated() + pixels_.allocated() + results_.allocated();
}

void PathKernel::submit(unsigned lane, const WorkRange& range) {
    assert(range.slots <= maxSlots_ && range.samples <= kMaxSamples);
    ranges_[lane] = range;
    const shared::DispatchParams push{range.firstSlot, range.slots, range.firstSample, range.samples,
                                      lane * maxSlots_};
    commands_[lane].submit("tracing paths", [&](const vk::raii::CommandBuffer& commands) {
        // The other lane's dispatch writes the same buffer, elsewhere.
        const vk::MemoryBarrier barrier(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eShaderWrite);
        commands.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader,
                                 vk::PipelineStageFlagBits::eComputeShader, {}, barrier, {}, {});
        kernel_.dispatch(commands, push, (range.slots + workgroupSize_ - 1) / workgroupSize_);
    });
}

PathKernel::Results PathKernel::wait(unsigned lane) {
    const double seconds = commands_[lane].wait("tracing paths");
    results_.invalidate();
    const auto* slots =
        reinterpret_cast<const shared::SlotResult*>(results_.mapped()) + std::size_t{lane} * maxSlots_;
    return {ranges_[lane], {slots, ranges_[lane].slots}, seconds};
}

}  // namespace duolux
