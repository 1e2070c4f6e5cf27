#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "host/vk/device.h"

namespace duolux {

/// How a buffer is bound in kernels.
enum class BufferUse : std::uint8_t {
    kTexels,  ///< uimageBuffer, rgba32ui: lavapipe inlines these reads, but calls a function for samplers
    kUniform,
    kStorage,
    kUnbound  ///< not at all
};

/// What a buffer is to an acceleration structure. All but kNone require DeviceInfo::rayQueries, and have a
/// device address.
enum class TreeUse : std::uint8_t { kNone, kInput, kStorage, kScratch };

/// A buffer with its own memory, which commands can copy and fill. Never empty: a size of 0 is rounded up.
class Buffer {
  public:
    /// Creates a buffer that the host writes once, through a staging buffer if the device's memory is not
    /// visible to the host. `name` is for error messages. Throws DeviceError if the device's limits do
    /// not suffice, MemoryError if memory does not.
    static Buffer upload(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                         std::string_view name, TreeUse treeUse = TreeUse::kNone);

    /// Writes memory that the device may see: every byte, each once, without reading any.
    using Fill = std::function<void(std::span<std::byte>)>;

    /// Like upload(), without the bytes in memory of their own. `size`: in bytes.
    static Buffer upload(const Device& device, BufferUse use, std::uint64_t size, std::string_view name,
                         const Fill& fill, TreeUse treeUse = TreeUse::kNone);

    /// Like upload(), but always through a staging buffer, so that tests cover this case on every device.
    static Buffer uploadStaged(const Device& device, BufferUse use, std::span<const std::byte> bytes,
                               std::string_view name);

    template <typename T>
    static Buffer upload(const Device& device, BufferUse use, std::span<const T> items, std::string_view name,
                         TreeUse treeUse = TreeUse::kNone) {
        return upload(device, use, std::as_bytes(items), name, treeUse);
    }

    /// Creates a buffer that only the device reads and writes.
    static Buffer device(const Device& device, BufferUse use, std::uint64_t size, std::string_view name,
                         TreeUse treeUse = TreeUse::kNone);

    /// Creates a buffer that the device writes and the host reads through mapped().
    static Buffer readback(const Device& device, std::uint64_t size, std::string_view name);

    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    std::uint64_t size() const { return size_; }
    std::uint64_t allocated() const { return allocated_; }  ///< bytes of device memory
    BufferUse use() const { return use_; }
    std::uint64_t address() const;  ///< device address; not with TreeUse::kNone

    /// The contents of a readback buffer; valid after invalidate(), once the device has finished.
    const std::byte* mapped() const { return static_cast<const std::byte*>(mapped_); }
    void invalidate() const;

    struct Handles;  ///< as Device::Handles
    const Handles& handles() const { return *handles_; }

  private:
    enum class Memory : std::uint8_t { kDevice, kStaging, kReadback };
    Buffer(const Device& device, BufferUse use, TreeUse treeUse, std::uint64_t size, Memory memory,
           std::string_view name);

    void write(std::uint64_t size, const Fill& fill) const;
    void writeStaged(std::uint64_t size, const Fill& fill, std::string_view name) const;

    const Device* device_;
    BufferUse use_;
    std::uint64_t size_;
    std::uint64_t allocated_ = 0;
    std::unique_ptr<Handles> handles_;
    void* mapped_ = nullptr;
    bool coherent_ = false;
};

}  // namespace duolux
