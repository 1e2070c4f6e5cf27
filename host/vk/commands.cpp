#include "host/vk/commands.h"

#include <array>

namespace duolux {

namespace {

vk::raii::CommandBuffer allocate(const Device& device, const vk::raii::CommandPool& pool) {
    return std::move(vk::raii::CommandBuffers(
        device.handle(), vk::CommandBufferAllocateInfo(*pool, vk::CommandBufferLevel::ePrimary, 1))[0]);
}

vk::raii::QueryPool makeTimestamps(const Device& device) {
    if (device.timestampPeriod() == 0.0) return nullptr;
    return {device.handle(), vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2)};
}

}  // namespace

CommandSlot::CommandSlot(const Device& device)
    : device_(&device),
      pool_(device.handle(), vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                       device.queueFamily())),
      commands_(allocate(device, pool_)),
      fence_(device.handle(), vk::FenceCreateInfo()),
      timestamps_(makeTimestamps(device)) {}

CommandSlot::~CommandSlot() {
    if (!inFlight_) return;
    try {
        static_cast<void>(device_->handle().waitForFences(*fence_, VK_TRUE, UINT64_MAX));
    } catch (const vk::SystemError&) {
        // The device is lost, so nothing is in flight any more.
    }
}

void CommandSlot::submit(std::string_view stage,
                         const std::function<void(const vk::raii::CommandBuffer&)>& record) {
    try {
        commands_.reset();
        commands_.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
        const bool timed = device_->timestampPeriod() > 0.0;
        if (timed) {
            commands_.resetQueryPool(*timestamps_, 0, 2);
            // The timestamp is written after all dispatches submitted earlier have finished.
            commands_.writeTimestamp(vk::PipelineStageFlagBits::eComputeShader, *timestamps_, 0);
        }
        record(commands_);
        if (timed) commands_.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *timestamps_, 1);
        // Makes the device's writes visible to the host and to later submissions.
        using Access = vk::AccessFlagBits;
        const vk::MemoryBarrier written(Access::eMemoryWrite,
                                        Access::eHostRead | Access::eMemoryRead | Access::eMemoryWrite);
        const vk::PipelineStageFlags all = vk::PipelineStageFlagBits::eAllCommands;
        commands_.pipelineBarrier(all, all | vk::PipelineStageFlagBits::eHost, {}, written, {}, {});
        commands_.end();
        device_->handle().resetFences(*fence_);
        vk::SubmitInfo submit;
        const vk::CommandBuffer handle = *commands_;
        submit.setCommandBuffers(handle);
        device_->queue().submit(submit, *fence_);
        inFlight_ = true;
    } catch (const vk::SystemError& e) {
        throw failureOn(device_->info(), stage, e);
    }
}

double CommandSlot::wait(std::string_view stage) {
    try {
        // Without a time limit, every result other than success is thrown as an exception.
        static_cast<void>(device_->handle().waitForFences(*fence_, VK_TRUE, UINT64_MAX));
        inFlight_ = false;
        if (device_->timestampPeriod() == 0.0) return 0.0;
        const auto [status, ticks] = timestamps_.getResults<std::uint64_t>(
            0, 2, 2 * sizeof(std::uint64_t), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
        if (status != vk::Result::eSuccess) return 0.0;
        return static_cast<double>(ticks[1] - ticks[0]) * device_->timestampPeriod() * 1e-9;
    } catch (const vk::SystemError& e) {
        throw failureOn(device_->info(), stage, e);
    }
}

void runOnce(const Device& device, std::string_view stage,
             const std::function<void(const vk::raii::CommandBuffer&)>& record) {
    CommandSlot slot(device);
    slot.submit(stage, record);
    slot.wait(stage);
}

}  // namespace duolux
