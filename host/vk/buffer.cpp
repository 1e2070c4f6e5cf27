#include "host/vk/buffer.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <optional>

#include "host/base/error.h"
#include "host/vk/commands.h"

namespace duolux {

namespace {

constexpr std::uint64_t kTexelBytes = 16;

vk::BufferUsageFlags usageOf(BufferUse use) {
    switch (use) {
        case BufferUse::kTexels:
            return vk::BufferUsageFlagBits::eStorageTexelBuffer;
        case BufferUse::kUniform:
            return vk::BufferUsageFlagBits::eUniformBuffer;
        case BufferUse::kStorage:
            return vk::BufferUsageFlagBits::eStorageBuffer;
        case BufferUse::kUnbound:
            return {};
    }
    return {};
}

/// Index of a memory type that has all of `wanted` and, if possible, `preferred`; empty if there is none.
std::optional<std::uint32_t> memoryType(const vk::PhysicalDeviceMemoryProperties& memory,
                                        std::uint32_t allowed, vk::MemoryPropertyFlags wanted,
                                        vk::MemoryPropertyFlags preferred) {
    for (const vk::MemoryPropertyFlags flags : {wanted | preferred, wanted}) {
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
            if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
        }
    }
    return std::nullopt;
}

void checkLimits(const DeviceInfo& info, BufferUse use, std::uint64_t size, std::string_view name) {
    const auto fail = [&](std::uint64_t limit) {
        throw MachineError(fmt::format("{} ({}): {} take {} bytes; the device can bind at most {}", info.name,
                                       info.driver, name, size, limit));
    };
    if (use == BufferUse::kTexels && size / kTexelBytes > info.maxTexelBufferElements) {
        fail(info.maxTexelBufferElements * kTexelBytes);
    }
    if (use == BufferUse::kStorage && size > info.maxStorageBufferRange) fail(info.maxStorageBufferRange);
}

/// Requests huge pages. A software driver uses the memory of this process, and with small pages random reads
/// of a large tree wait for address translation. The kernel may ignore the request.
void adviseHugePages(void* begin, std::uint64_t size) {
    constexpr std::uintptr_t kHugePage = std::uintptr_t{2} << 20;
    const auto first = (reinterpret_cast<std::uintptr_t>(begin) + kHugePage - 1) / kHugePage * kHugePage;
    const auto last = (reinterpret_cast<std::uintptr_t>(begin) + size) / kHugePage * kHugePage;
    if (first < last) static_cast<void>(madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE));
}

}  // namespace

Buffer::Buffer(const Device& device, BufferUse use, std::uint64_t size, vk::BufferUsageFlags extra,
               Memory memory, std::string_view name)
    : device_(&device.handle()), use_(use), size_(std::max<std::uint64_t>((size + 15) / 16 * 16, 16)) {
    if (memory != Memory::kStaging)
        checkLimits(device.info(), use, size_, name);  // staging buffers are never bound
    try {
        buffer_ = vk::raii::Buffer(*device_, vk::BufferCreateInfo({}, size_, usageOf(use) | extra));
        const vk::MemoryRequirements requirements = buffer_.getMemoryRequirements();
        const vk::PhysicalDeviceMemoryProperties properties = device.physical().getMemoryProperties();
        using Flag = vk::MemoryPropertyFlagBits;
        std::optional<std::uint32_t> type;
        switch (memory) {
            case Memory::kDevice:
                type = memoryType(properties, requirements.memoryTypeBits, Flag::eDeviceLocal, {});
                break;
            case Memory::kStaging:
                type = memoryType(properties, requirements.memoryTypeBits, Flag::eHostVisible,
                                  Flag::eHostCoherent);
                break;
            case Memory::kReadback:
                type = memoryType(properties, requirements.memoryTypeBits, Flag::eHostVisible,
                                  Flag::eHostCached);
                break;
        }
        if (!type) throw MachineError(fmt::format("{}: no memory type for {}", device.info().name, name));
        vk::MemoryAllocateInfo allocation(requirements.size, *type);
        const vk::MemoryAllocateFlagsInfo addressed(vk::MemoryAllocateFlagBits::eDeviceAddress);
        if (extra & vk::BufferUsageFlagBits::eShaderDeviceAddress) allocation.setPNext(&addressed);
        memory_ = vk::raii::DeviceMemory(*device_, allocation);
        allocated_ = requirements.size;
        buffer_.bindMemory(*memory_, 0);
        const vk::MemoryPropertyFlags flags = properties.memoryTypes[*type].propertyFlags;
        coherent_ = static_cast<bool>(flags & Flag::eHostCoherent);
        if (flags & Flag::eHostVisible) mapped_ = memory_.mapMemory(0, VK_WHOLE_SIZE);
        if (mapped_ != nullptr && device.info().kind == DeviceKind::kCpu) adviseHugePages(mapped_, size_);
        if (use == BufferUse::kTexels && memory != Memory::kStaging) {
            view_ = vk::raii::BufferView(
                *device_,
                vk::BufferViewCreateInfo({}, *buffer_, vk::Format::eR32G32B32A32Uint, 0, VK_WHOLE_SIZE));
        }
    } catch (const vk::SystemError& e) {
        throw failureOn(device.info(), fmt::format("allocating {} bytes for {}", size_, name), e);
    }
}

void Buffer::write(std::span<const std::byte> bytes) const {
    std::memcpy(mapped_, bytes.data(), bytes.size());
    if (!coherent_) device_->flushMappedMemoryRanges(vk::MappedMemoryRange(*memory_, 0, VK_WHOLE_SIZE));
}

Buffer Buffer::upload(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                      std::string_view name, vk::BufferUsageFlags extra) {
    Buffer buffer(device, use, bytes.size(), extra | vk::BufferUsageFlagBits::eTransferDst, Memory::kDevice,
                  name);
    if (bytes.empty()) return buffer;
    if (buffer.mapped_ != nullptr) {
        buffer.write(bytes);
    } else {
        buffer.writeStaged(device, bytes, name);
    }
    return buffer;
}

Buffer Buffer::uploadStaged(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                            std::string_view name) {
    Buffer buffer(device, use, bytes.size(), vk::BufferUsageFlagBits::eTransferDst, Memory::kDevice, name);
    if (!bytes.empty()) buffer.writeStaged(device, bytes, name);
    return buffer;
}

void Buffer::writeStaged(const Device& device, std::span<const std::byte> bytes,
                         std::string_view name) const {
    const Buffer staging(device, BufferUse::kStorage, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc,
                         Memory::kStaging, name);
    staging.write(bytes);
    runOnce(device, fmt::format("uploading {}", name), [&](const vk::raii::CommandBuffer& commands) {
        commands.copyBuffer(staging.handle(), handle(), vk::BufferCopy(0, 0, bytes.size()));
        // The fence makes the copied data available; the barrier makes it visible to all later reads.
        commands.pipelineBarrier(
            vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eAllCommands, {},
            vk::MemoryBarrier(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eMemoryRead), {}, {});
    });
}

Buffer Buffer::device(const Device& device, BufferUse use, std::uint64_t size, vk::BufferUsageFlags extra,
                      std::string_view name) {
    return Buffer(device, use, size, extra, Memory::kDevice, name);
}

Buffer Buffer::readback(const Device& device, std::uint64_t size, std::string_view name,
                        vk::BufferUsageFlags extra) {
    return Buffer(device, BufferUse::kStorage, size, extra, Memory::kReadback, name);
}

vk::DeviceAddress Buffer::address() const {
    return device_->getBufferAddress(vk::BufferDeviceAddressInfo(*buffer_));
}

void Buffer::invalidate() const {
    if (!coherent_) device_->invalidateMappedMemoryRanges(vk::MappedMemoryRange(*memory_, 0, VK_WHOLE_SIZE));
}

}  // namespace duolux
