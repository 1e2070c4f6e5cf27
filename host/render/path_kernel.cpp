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

// A team is a subgroup. On a CPU it is the work group, too: what runs at once are the few threads.
std::uint32_t chooseTeamSize(const Device& device) {
    return std::max(device.info().subgroupSize, 1u);
}

std::uint32_t chooseWorkgroupSize(const Device& device, std::uint32_t teamSize) {
    const auto limits = device.physical().getProperties().limits;
    const std::uint32_t wanted = device.info().kind == DeviceKind::kCpu ? teamSize : 64u;
    const std::uint32_t largest =
        std::min({wanted, limits.maxComputeWorkGroupSize[0], limits.maxComputeWorkGroupInvocations});
    return std::max(largest / teamSize, 1u) * teamSize;
}

// The more samples a team shares out, the less its lanes wait for the last one (on lavapipe from 64 on the
// difference is within noise). But a GPU needs many teams, and lavapipe ends a subgroup's loops after 65535
// iterations.
std::uint32_t chooseTeamSamples(const Device& device, std::uint32_t teamSize) {
    return (device.info().kind == DeviceKind::kCpu ? 128u : 16u) * teamSize;
}

std::vector<Specialization> specialize(const DeviceScene& deviceScene, const Scene& scene,
                                       std::uint32_t workgroupSize, std::uint32_t teamSize) {
    const TransportTraits& traits = deviceScene.traits;
    // Fractions of a subgroup; measured on an 8-wide one, where 4 to 5 and 2 to 4 lanes are within noise of
    // each other.
    return {{shared::kSpecWorkgroupSize, workgroupSize},
            {shared::kSpecLeaveTraversal, teamSize / 2},
            {shared::kSpecLeaveNodes, teamSize * 3 / 8},
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
            {shared::kSpecEmitterTree, deviceScene.hasEmitters},
            {shared::kSpecTeamSize, teamSize}};
}

Buffer uploadParams(const Device& device, const DeviceScene& deviceScene, const Scene& scene) {
    const shared::PathParams params = makeParams(scene, deviceScene);
    return Buffer::upload(device, BufferUse::kUniform, std::as_bytes(std::span(&params, 1)), "parameters");
}

}  // namespace

PathKernel::PathKernel(const Device& device, const DeviceScene& deviceScene, const Scene& scene,
                       std::span<const std::uint32_t> pixels, std::uint32_t maxSlots)
    : teamSize_(chooseTeamSize(device)),
      workgroupSize_(chooseWorkgroupSize(device, teamSize_)),
      teamSamples_(chooseTeamSamples(device, teamSize_)),
      maxSlots_(maxSlots),
      params_(uploadParams(device, deviceScene, scene)),
      pixels_(Buffer::upload(device, BufferUse::kTexels, pixels, "pixel order")),
      results_(Buffer::readback(device, 2 * sizeof(shared::SlotResult) * std::uint64_t{maxSlots}, "results")),
      teams_(Buffer::readback(device, 2 * sizeof(shared::TeamProgress) * std::uint64_t{maxSlots}, "progress",
                              vk::BufferUsageFlagBits::eTransferDst)),
      kernel_(device, "path", spirv::kPathKernel,
              std::array<Binding, 9>{{{shared::kBindingNodes, &deviceScene.nodes},
                                      {shared::kBindingTriangles, &deviceScene.triangles},
                                      {shared::kBindingNormals, &deviceScene.normals},
                                      {shared::kBindingMaterials, &deviceScene.materials},
                                      {shared::kBindingLights, &deviceScene.lights},
                                      {shared::kBindingParams, &params_},
                                      {shared::kBindingPixels, &pixels_},
                                      {shared::kBindingResults, &results_},
                                      {shared::kBindingTeams, &teams_}}},
              specialize(deviceScene, scene, workgroupSize_, teamSize_), sizeof(shared::DispatchParams)),
      commands_{CommandSlot(device), CommandSlot(device)} {}

std::uint64_t PathKernel::deviceBytes() const {
    return params_.allocated() + pixels_.allocated() + results_.allocated() + teams_.allocated();
}

void PathKernel::submit(unsigned lane, const WorkRange& range) {
    assert(range.slots <= maxSlots_ && range.samples <= kMaxSamples);
    const std::uint32_t teamSlots = std::max(teamSamples_ / range.samples, 1u);
    submitted_[lane] = {range, teamSamples_, teamSlots};
    const std::uint32_t firstTeam = lane * maxSlots_;
    const std::uint32_t teams = (range.slots + teamSlots - 1) / teamSlots;
    const shared::DispatchParams push{range.firstSlot, range.slots,      range.firstSample, range.samples,
                                      teamSlots,       lane * maxSlots_, firstTeam};
    commands_[lane].submit("tracing paths", [&](const vk::raii::CommandBuffer& commands) {
        using Stage = vk::PipelineStageFlagBits;
        using Access = vk::AccessFlagBits;
        commands.fillBuffer(teams_.handle(), firstTeam * sizeof(shared::TeamProgress),
                            teams * sizeof(shared::TeamProgress), 0);
        // The other lane's dispatch writes the same buffers, elsewhere.
        const vk::MemoryBarrier barrier(Access::eShaderWrite | Access::eTransferWrite,
                                        Access::eShaderRead | Access::eShaderWrite);
        commands.pipelineBarrier(Stage::eComputeShader | Stage::eTransfer, Stage::eComputeShader, {}, barrier,
                                 {}, {});
        kernel_.dispatch(commands, push, (teams * teamSize_ + workgroupSize_ - 1) / workgroupSize_);
    });
}

PathKernel::Results PathKernel::wait(unsigned lane) {
    const double seconds = commands_[lane].wait("tracing paths");
    results_.invalidate();
    teams_.invalidate();
    const auto& [range, teamSamples, teamSlots] = submitted_[lane];
    const auto* slots =
        reinterpret_cast<const shared::SlotResult*>(results_.mapped()) + std::size_t{lane} * maxSlots_;
    const auto* team =
        reinterpret_cast<const shared::TeamProgress*>(teams_.mapped()) + std::size_t{lane} * maxSlots_;
    bool complete = true;
    for (std::uint32_t slot = 0; slot < range.slots; slot += teamSlots, ++team) {
        complete = complete && team->finished == std::min(teamSlots, range.slots - slot);
    }
    return {range, teamSamples, complete, {slots, range.slots}, seconds};
}

}  // namespace duolux
