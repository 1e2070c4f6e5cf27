#include "host/render/path_kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "host/base/parallel.h"
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

bool onCpu(const Device& device) {
    return device.info().kind == DeviceKind::kCpu;
}

std::uint32_t chooseWorkgroupSize(const Device& device, std::uint32_t teamSize) {
    const auto limits = device.physical().getProperties().limits;
    // On a CPU a work group is about a team: what runs at once are the few threads.
    const std::uint32_t wanted = onCpu(device) ? 8u : 64u;
    const std::uint32_t largest =
        std::min({wanted, limits.maxComputeWorkGroupSize[0], limits.maxComputeWorkGroupInvocations});
    return std::max(largest / teamSize, 1u) * teamSize;
}

// On lavapipe 64 samples or more are within noise of each other, but 16 are 12 % slower; it ends the loops of
// a subgroup after 65535 iterations, which rays with many crossings reach early. A GPU needs many teams more
// than it needs this.
std::uint32_t chooseLaneSamples(const Device& device, const TransportTraits& traits) {
    if (!onCpu(device)) return 16u;
    return traits.transmittance == shared::kTransmittanceGeneral ? 32u : 128u;
}

// So many teams at least, as long as they are full, keep the device busy: threads of a CPU four times over.
std::uint32_t chooseFewestTeams(const Device& device) {
    return onCpu(device) ? 4u * workerCount() : 8192u;
}

std::vector<Specialization> specialize(const DeviceScene& deviceScene, const Scene& scene,
                                       std::uint32_t workgroupSize, std::uint32_t teamSize, bool closedForm) {
    const TransportTraits& traits = deviceScene.traits;
    std::uint32_t directLight = closedForm ? shared::kDirectLightClosedForm : shared::kDirectLightSampled;
    if (deviceScene.lightCount == 0) directLight = shared::kDirectLightNone;
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
            {shared::kSpecDirectLight, directLight},
            {shared::kSpecHasEmitters, deviceScene.hasEmitters},
            {shared::kSpecTeamSize, teamSize}};
}

Buffer uploadParams(const Device& device, const DeviceScene& deviceScene, const Scene& scene) {
    const shared::PathParams params = makeParams(scene, deviceScene);
    return Buffer::upload(device, BufferUse::kUniform, std::as_bytes(std::span(&params, 1)), "parameters");
}

}  // namespace

PathKernel::PathKernel(const Device& device, const DeviceScene& deviceScene, const Scene& scene,
                       std::span<const std::uint32_t> pixels, std::uint32_t maxSlots, bool closedForm)
    : teamSize_(std::max(device.info().subgroupSize, 1u)),
      workgroupSize_(chooseWorkgroupSize(device, teamSize_)),
      fewestTeams_(chooseFewestTeams(device)),
      laneSamples_(chooseLaneSamples(device, deviceScene.traits)),
      maxSlots_(maxSlots),
      params_(uploadParams(device, deviceScene, scene)),
      pixels_(Buffer::upload(device, BufferUse::kTexels, pixels, "pixel order")),
      results_(Buffer::readback(device, 2 * sizeof(shared::SlotResult) * std::uint64_t{maxSlots}, "results")),
      teams_(Buffer::device(
          device, BufferUse::kStorage, 2 * sizeof(shared::TeamProgress) * std::uint64_t{maxSlots},
          vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst, "progress")),
      teamsRead_(Buffer::readback(device, teams_.size(), "progress", vk::BufferUsageFlagBits::eTransferDst)),
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
              specialize(deviceScene, scene, workgroupSize_, teamSize_, closedForm),
              sizeof(shared::DispatchParams)),
      commands_{CommandSlot(device), CommandSlot(device)} {}

std::uint64_t PathKernel::deviceBytes() const {
    return params_.allocated() + pixels_.allocated() + results_.allocated() + teamsRead_.allocated() +
           teams_.allocated();
}

void PathKernel::submit(unsigned place, const WorkRange& range) {
    assert(range.slots <= maxSlots_ && range.samples <= std::min(kMaxSamples, laneSamples_));
    const std::uint32_t laneSlots = std::max(laneSamples_ / range.samples, 1u);
    const std::uint32_t fairLaneSlots = std::max(range.slots / (fewestTeams_ * teamSize_), 1u);
    const std::uint32_t teamSlots = std::min(laneSlots, fairLaneSlots) * teamSize_;
    const std::uint32_t teams = (range.slots + teamSlots - 1) / teamSlots;
    submitted_[place] = {range, teamSlots, teams};
    const std::uint32_t first = place * maxSlots_;  // of results and teams
    const shared::DispatchParams push{
        range.firstSlot, range.slots, range.firstSample, range.samples, teamSlots, first, first};
    const std::uint64_t teamsOffset = first * sizeof(shared::TeamProgress);
    const std::uint64_t teamsSize = teams * sizeof(shared::TeamProgress);
    commands_[place].submit("tracing paths", [&](const vk::raii::CommandBuffer& commands) {
        using Stage = vk::PipelineStageFlagBits;
        using Access = vk::AccessFlagBits;
        const auto barrier = [&](vk::PipelineStageFlags before, vk::AccessFlags written,
                                 vk::PipelineStageFlags after, vk::AccessFlags used) {
            commands.pipelineBarrier(before, after, {}, vk::MemoryBarrier(written, used), {}, {});
        };
        const vk::AccessFlags shader = Access::eShaderRead | Access::eShaderWrite;
        // The dispatch in the other place uses other parts of the same buffers.
        barrier(Stage::eComputeShader | Stage::eTransfer,
                shader | Access::eTransferRead | Access::eTransferWrite,
                Stage::eComputeShader | Stage::eTransfer, shader | Access::eTransferWrite);
        commands.fillBuffer(teams_.handle(), teamsOffset, teamsSize, 0);
        barrier(Stage::eTransfer, Access::eTransferWrite, Stage::eComputeShader, shader);
        kernel_.dispatch(commands, push, (teams * teamSize_ + workgroupSize_ - 1) / workgroupSize_);
        barrier(Stage::eComputeShader, Access::eShaderWrite, Stage::eTransfer, Access::eTransferRead);
        commands.copyBuffer(teams_.handle(), teamsRead_.handle(),
                            vk::BufferCopy(teamsOffset, teamsOffset, teamsSize));
    });
}

PathKernel::Results PathKernel::wait(unsigned place) {
    const double seconds = commands_[place].wait("tracing paths");
    results_.invalidate();
    teamsRead_.invalidate();
    const auto& [range, teamSlots, teams] = submitted_[place];
    const std::size_t first = std::size_t{place} * maxSlots_;
    const auto* slots = reinterpret_cast<const shared::SlotResult*>(results_.mapped()) + first;
    const auto* team = reinterpret_cast<const shared::TeamProgress*>(teamsRead_.mapped()) + first;
    bool complete = true;
    for (std::uint32_t i = 0; i < teams; ++i)
        complete = complete && team[i].finished == std::min(teamSlots, range.slots - i * teamSlots);
    return {range, teamSlots / teamSize_ * range.samples, complete, {slots, range.slots}, seconds};
}

}  // namespace duolux
