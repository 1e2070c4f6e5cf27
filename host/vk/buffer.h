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
    kTexels,  ///< uimageBuffer, rgba32ui: lavapipe reads these in line, but calls a function for samplers
    kUniform,
    kStorage,
    kUnbound  ///< not at all
};

/// A buffer with memory of its own. Never empty: a size of 0 is rounded up.
class Buffer {
  public:
    /// Written by the host once, through a staging buffer where the device's memory is not visible to the
    /// host. `name` is for error messages; `extra`: uses beyond `use`. Throws MachineError if the device's
    /// limits or memory do not suffice.
    static Buffer upload(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                         std::string_view name, vk::BufferUsageFlags extra = {});

    /// Through a staging buffer in any case, so that tests reach what upload() does where memory is not
    /// visible.
    static Buffer uploadStaged(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                               std::string_view name);

    template <typename T>
    static Buffer upload(const Device& device, BufferUse use, std::span<const T> items, std::string_view name,
                         vk::BufferUsageFlags extra = {}) {
        return upload(device, use, std::as_bytes(items), name, extra);
    }

    /// Written and read by the device alone.
    static Buffer device(const Device& device, BufferUse use, std::uint64_t size, vk::BufferUsageFlags extra,
                         std::string_view name);

    /// Written by the device, read by the host through mapped(); `extra`: uses beyond that in kernels.
    static Buffer readback(const Device& device, std::uint64_t size, std::string_view name,
                           vk::BufferUsageFlags extra = {});

    vk::Buffer handle() const { return *buffer_; }
    vk::BufferView view() const { return *view_; }  ///< kTexels: R32G32B32A32 uint
    std::uint64_t size() const { return size_; }
    std::uint64_t allocated() const { return allocated_; }  ///< bytes of device memory
    BufferUse use() const { return use_; }
    /// In the device's memory; only with the extra use eShaderDeviceAddress.
    vk::DeviceAddress address() const;

    /// The contents of a readback buffer; valid after invalidate() once the device is done.
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
