#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vulkan/vulkan_raii.hpp>

#include "host/vk/device.h"

namespace duolux {

/// How a buffer is bound in kernels.
enum class BufferUse : std::uint8_t {
    kTexels,  ///< uimageBuffer, rgba32ui: lavapipe inlines these reads, but calls a function for samplers
    kUniform,
    kStorage,
    kUnbound  ///< not at all
};

/// A buffer with its own memory. Never empty: a size of 0 is rounded up.
class Buffer {
  public:
    /// Creates a buffer that the host writes once, through a staging buffer if the device's memory is not
    /// visible to the host. `name` is for error messages; `extra`: uses in addition to `use`. Throws
    /// MachineError if the device's limits or memory do not suffice.
    static Buffer upload(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                         std::string_view name, vk::BufferUsageFlags extra = {});

    /// Like upload(), but always through a staging buffer, so that tests cover this case on every device.
    static Buffer uploadStaged(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                               std::string_view name);

    template <typename T>
    static Buffer upload(const Device& device, BufferUse use, std::span<const T> items, std::string_view name,
                         vk::BufferUsageFlags extra = {}) {
        return upload(device, use, std::as_bytes(items), name, extra);
    }

    /// Creates a buffer that only the device reads and writes.
    static Buffer device(const Device& device, BufferUse use, std::uint64_t size, vk::BufferUsageFlags extra,
                         std::string_view name);

    /// Creates a buffer that the device writes and the host reads through mapped(); `extra`: uses in addition
    /// to that in kernels.
    static Buffer readback(const Device& device, std::uint64_t size, std::string_view name,
                           vk::BufferUsageFlags extra = {});

    vk::Buffer handle() const { return *buffer_; }
    vk::BufferView view() const { return *view_; }  ///< kTexels: R32G32B32A32 uint
    std::uint64_t size() const { return size_; }
    std::uint64_t allocated() const { return allocated_; }  ///< bytes of device memory
    BufferUse use() const { return use_; }
    /// Device address; requires the extra use eShaderDeviceAddress.
    vk::DeviceAddress address() const;

    /// The contents of a readback buffer; valid after invalidate(), once the device has finished.
    const std::byte* mapped() const { return static_cast<const std::byte*>(mapped_); }
    void invalidate() const;

  private:
    enum class Memory : std::uint8_t { kDevice, kStaging, kReadback };
    Buffer(const Device& device, BufferUse use, std::uint64_t size, vk::BufferUsageFlags extra, Memory memory,
           std::string_view name);

    void write(std::span<const std::byte> bytes) const;
    void writeStaged(const Device& device, std::span<const std::byte> bytes, std::string_view name) const;

    const vk::raii::Device* device_;
    BufferUse use_;
    std::uint64_t size_;
    std::uint64_t allocated_ = 0;
    vk::raii::Buffer buffer_{nullptr};
    vk::raii::DeviceMemory memory_{nullptr};
    vk::raii::BufferView view_{nullptr};
    void* mapped_ = nullptr;
    bool coherent_ = false;
};

}  // namespace duolux
