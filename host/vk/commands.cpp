#include "host/vk/commands.h"

#include "host/vk/handles.h"

namespace duolux {

namespace {

using Access = vk::AccessFlagBits;
using Stage = vk::PipelineStageFlagBits;

bool contains(Work all, Work part) {
    return (static_cast<unsigned>(all) & static_cast<unsigned>(part)) != 0;
}

vk::PipelineStageFlags stagesOf(Work work) {
    vk::PipelineStageFlags stages;
    if (contains(work, Work::kKernels)) stages |= Stage::eComputeShader;
    if (contains(work, Work::kTransfers)) stages |= Stage::eTransfer;
    return stages;
}

vk::AccessFlags writesOf(Work work) {
    vk::AccessFlags writes;
    if (contains(work, Work::kKernels)) writes |= Access::eShaderWrite;
    if (contains(work, Work::kTransfers)) writes |= Access::eTransferWrite;
    return writes;
}

vk::AccessFlags readsOf(Work work) {
    vk::AccessFlags reads;
    if (contains(work, Work::kKernels)) reads |= Access::eShaderRead;
    if (contains(work, Work::kTransfers)) reads |= Access::eTransferRead;
    return reads;
}

}  // namespace

void Commands::fill(const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes,
                    std::uint32_t value) const {
    handle_.fillBuffer(*buffer.handles().buffer, offset, bytes, value);
}

void Commands::copy(const Buffer& from, std::uint64_t fromOffset, const Buffer& to, std::uint64_t toOffset,
                    std::uint64_t bytes) const {
    handle_.copyBuffer(*from.handles().buffer, *to.handles().buffer,
                       vk::BufferCopy(fromOffset, toOffset, bytes));
}

void Commands::barrier(Work before, Work after) const {
    const vk::MemoryBarrier memory(writesOf(before), readsOf(after) | writesOf(after));
    handle_.pipelineBarrier(stagesOf(before), stagesOf(after), {}, memory, {}, {});
}

struct CommandSlot::Handles {
    explicit Handles(const Device::Handles& device)
        : pool(device.device, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                        device.queueFamily)),
          commands(std::move(vk::raii::CommandBuffers(
              device.device, vk::CommandBufferAllocateInfo(*pool, vk::CommandBufferLevel::ePrimary, 1))[0])),
          fence(device.device, vk::FenceCreateInfo()) {
        if (device.timestampPeriod == 0.0) return;
        timestamps = {device.device, vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2)};
    }

    vk::raii::CommandPool pool;
    vk::raii::CommandBuffer commands;
    vk::raii::Fence fence;
    vk::raii::QueryPool timestamps{nullptr};
};

CommandSlot::CommandSlot(const Device& device) try
    : device_(&device), handles_(std::make_unique<Handles>(device.handles())) {
} catch (const vk::SystemError& e) {
    failOn(device.info(), "creating a command buffer", e);
}

CommandSlot::~CommandSlot() {
    if (!inFlight_) return;
    try {
        static_cast<void>(device_->handles().device.waitForFences(*handles_->fence, VK_TRUE, UINT64_MAX));
    } catch (const vk::SystemError&) {
        // The device is lost, so nothing is in flight any more.
    }
}

void CommandSlot::submit(std::string_view stage, const std::function<void(const Commands&)>& record) {
    const vk::raii::CommandBuffer& commands = handles_->commands;
    const bool timed = device_->handles().timestampPeriod > 0.0;
    try {
        commands.reset();
        commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
        if (timed) {
            commands.resetQueryPool(*handles_->timestamps, 0, 2);
            // The timestamp is written after all dispatches submitted earlier have finished.
            commands.writeTimestamp(Stage::eComputeShader, *handles_->timestamps, 0);
        }
        record(Commands(commands));
        if (timed) commands.writeTimestamp(Stage::eBottomOfPipe, *handles_->timestamps, 1);
        // Makes the device's writes visible to the host and to later submissions.
        const vk::MemoryBarrier written(Access::eMemoryWrite,
                                        Access::eHostRead | Access::eMemoryRead | Access::eMemoryWrite);
        const vk::PipelineStageFlags all = Stage::eAllCommands;
        commands.pipelineBarrier(all, all | Stage::eHost, {}, written, {}, {});
        commands.end();
        device_->handles().device.resetFences(*handles_->fence);
        vk::SubmitInfo submit;
        const vk::CommandBuffer handle = *commands;
        submit.setCommandBuffers(handle);
        device_->handles().queue.submit(submit, *handles_->fence);
        inFlight_ = true;
    } catch (const vk::SystemError& e) {
        failOn(device_->info(), stage, e);
    }
}

double CommandSlot::wait(std::string_view stage) {
    const Device::Handles& device = device_->handles();
    try {
        // Without a time limit, every result other than success is thrown as an exception.
        static_cast<void>(device.device.waitForFences(*handles_->fence, VK_TRUE, UINT64_MAX));
        inFlight_ = false;
        if (device.timestampPeriod == 0.0) return 0.0;
        const auto [status, ticks] = handles_->timestamps.getResults<std::uint64_t>(
            0, 2, 2 * sizeof(std::uint64_t), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
        if (status != vk::Result::eSuccess) return 0.0;
        return static_cast<double>(ticks[1] - ticks[0]) * device.timestampPeriod * 1e-9;
    } catch (const vk::SystemError& e) {
        failOn(device_->info(), stage, e);
    }
}

void runOnce(const Device& device, std::string_view stage,
             const std::function<void(const Commands&)>& record) {
    CommandSlot slot(device);
    slot.submit(stage, record);
    slot.wait(stage);
}

}  // namespace duolux
