#include "host/vk/buffer.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <optional>

#include "host/base/error.h"
#include "host/vk/commands.h"
#include "host/vk/handles.h"

namespace duolux {

namespace {

constexpr std::uint64_t kTexelBytes = 16;

using Usage = vk::BufferUsageFlagBits;

vk::BufferUsageFlags usageOf(BufferUse use) {
    switch (use) {
        case BufferUse::kTexels:
            return Usage::eStorageTexelBuffer;
        case BufferUse::kUniform:
            return Usage::eUniformBuffer;
        case BufferUse::kStorage:
            return Usage::eStorageBuffer;
        case BufferUse::kUnbound:
            return {};
    }
    return {};
}

vk::BufferUsageFlags usageOf(TreeUse use) {
    switch (use) {
        case TreeUse::kNone:
            return {};
        case TreeUse::kInput:
            return Usage::eShaderDeviceAddress | Usage::eAccelerationStructureBuildInputReadOnlyKHR;
        case TreeUse::kStorage:
            return Usage::eShaderDeviceAddress | Usage::eAccelerationStructureStorageKHR;
        case TreeUse::kScratch:
            return Usage::eShaderDeviceAddress | Usage::eStorageBuffer;
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
        throw DeviceError(fmt::format("{} ({}): {} take {} bytes; the device can bind at most {}", info.name,
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

Buffer::Fill copyOf(std::span<const std::byte> bytes) {
    return [bytes](std::span<std::byte> out) { std::memcpy(out.data(), bytes.data(), bytes.size()); };
}

}  // namespace

Buffer::Buffer(const Device& device, BufferUse use, TreeUse treeUse, std::uint64_t size, Memory memory,
               std::string_view name)
    : device_(&device),
      use_(use),
      size_(std::max<std::uint64_t>((size + 15) / 16 * 16, 16)),
      handles_(std::make_unique<Handles>()) {
    if (memory != Memory::kStaging)
        checkLimits(device.info(), use, size_, name);  // staging buffers are never bound
    const vk::raii::Device& vulkan = device.handles().device;
    try {
        handles_->buffer = vk::raii::Buffer(
            vulkan,
            vk::BufferCreateInfo(
                {}, size_, usageOf(use) | usageOf(treeUse) | Usage::eTransferSrc | Usage::eTransferDst));
        const vk::MemoryRequirements requirements = handles_->buffer.getMemoryRequirements();
        const vk::PhysicalDeviceMemoryProperties properties = device.handles().physical.getMemoryProperties();
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
        if (!type) throw DeviceError(fmt::format("{}: no memory type for {}", device.info().name, name));
        vk::MemoryAllocateInfo allocation(requirements.size, *type);
        const vk::MemoryAllocateFlagsInfo addressed(vk::MemoryAllocateFlagBits::eDeviceAddress);
        if (treeUse != TreeUse::kNone) allocation.setPNext(&addressed);
        handles_->memory = vk::raii::DeviceMemory(vulkan, allocation);
        allocated_ = requirements.size;
        handles_->buffer.bindMemory(*handles_->memory, 0);
        const vk::MemoryPropertyFlags flags = properties.memoryTypes[*type].propertyFlags;
        coherent_ = static_cast<bool>(flags & Flag::eHostCoherent);
        if (flags & Flag::eHostVisible) mapped_ = handles_->memory.mapMemory(0, VK_WHOLE_SIZE);
        if (mapped_ != nullptr && device.info().kind == DeviceKind::kCpu) adviseHugePages(mapped_, size_);
        if (use == BufferUse::kTexels && memory != Memory::kStaging) {
            handles_->view = vk::raii::BufferView(
                vulkan, vk::BufferViewCreateInfo({}, *handles_->buffer, vk::Format::eR32G32B32A32Uint, 0,
                                                 VK_WHOLE_SIZE));
        }
    } catch (const vk::SystemError& e) {
        failOn(device.info(), fmt::format("allocating {} bytes for {}", size_, name), e);
    }
}

Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&& other) noexcept = default;
Buffer& Buffer::operator=(Buffer&& other) noexcept = default;

void Buffer::write(std::uint64_t size, const Fill& fill) const {
    fill({static_cast<std::byte*>(mapped_), size});
    if (coherent_) return;
    try {
        device_->handles().device.flushMappedMemoryRanges(
            vk::MappedMemoryRange(*handles_->memory, 0, VK_WHOLE_SIZE));
    } catch (const vk::SystemError& e) {
        failOn(device_->info(), "writing to the device's memory", e);
    }
}

Buffer Buffer::upload(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                      std::string_view name, TreeUse treeUse) {
    return upload(device, use, bytes.size(), name, copyOf(bytes), treeUse);
}

Buffer Buffer::upload(const Device& device, BufferUse use, std::uint64_t size, std::string_view name,
                      const Fill& fill, TreeUse treeUse) {
    Buffer buffer(device, use, treeUse, size, Memory::kDevice, name);
    if (size == 0) return buffer;
    if (buffer.mapped_ != nullptr) {
        buffer.write(size, fill);
    } else {
        buffer.writeStaged(size, fill, name);
    }
    return buffer;
}

Buffer Buffer::uploadStaged(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                            std::string_view name) {
    Buffer buffer(device, use, TreeUse::kNone, bytes.size(), Memory::kDevice, name);
    if (!bytes.empty()) buffer.writeStaged(bytes.size(), copyOf(bytes), name);
    return buffer;
}

void Buffer::writeStaged(std::uint64_t size, const Fill& fill, std::string_view name) const {
    const Buffer staging(*device_, BufferUse::kUnbound, TreeUse::kNone, size, Memory::kStaging, name);
    staging.write(size, fill);
    // The end of the commands makes the copied data visible to all later reads.
    runOnce(*device_, fmt::format("uploading {}", name),
            [&](const Commands& commands) { commands.copy(staging, 0, *this, 0, size); });
}

Buffer Buffer::device(const Device& device, BufferUse use, std::uint64_t size, std::string_view name,
                      TreeUse treeUse) {
    return Buffer(device, use, treeUse, size, Memory::kDevice, name);
}

Buffer Buffer::readback(const Device& device, std::uint64_t size, std::string_view name) {
    return Buffer(device, BufferUse::kStorage, TreeUse::kNone, size, Memory::kReadback, name);
}

std::uint64_t Buffer::address() const {
    return device_->handles().device.getBufferAddress(vk::BufferDeviceAddressInfo(*handles_->buffer));
}

void Buffer::invalidate() const {
    if (coherent_) return;
    try {
        device_->handles().device.invalidateMappedMemoryRanges(
            vk::MappedMemoryRange(*handles_->memory, 0, VK_WHOLE_SIZE));
    } catch (const vk::SystemError& e) {
        failOn(device_->info(), "reading the device's memory", e);
    }
}

}  // namespace duolux
