#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "host/vk/buffer.h"
#include "host/vk/device.h"

namespace vk::raii {
class CommandBuffer;
}

namespace duolux {

/// What accesses memory on the device.
enum class Work : std::uint8_t {
    kKernels = 1,
    kTransfers = 2,  ///< copies and fills
    kAll = 3
};

/// Commands of a device while they are recorded. Kernel::dispatch adds kernels.
class Commands {
  public:
    explicit Commands(const vk::raii::CommandBuffer& handle) : handle_(handle) {}

    /// Sets the words of [offset, offset + bytes) to `value`. Offset and size are multiples of 4.
    void fill(const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes, std::uint32_t value) const;
    /// Sets all words of a buffer.
    void fill(const Buffer& buffer, std::uint32_t value) const { fill(buffer, 0, buffer.size(), value); }

    void copy(const Buffer& from, std::uint64_t fromOffset, const Buffer& to, std::uint64_t toOffset,
              std::uint64_t bytes) const;

    /// Work of the kind `after` in later commands waits for work of the kind `before` in earlier commands,
    /// and sees what that wrote.
    void barrier(Work before, Work after) const;

    const vk::raii::CommandBuffer& handle() const { return handle_; }

  private:
    const vk::raii::CommandBuffer& handle_;
};

/// Commands that are recorded, submitted and waited for, again and again. Timestamps measure their execution.
class CommandSlot {
  public:
    explicit CommandSlot(const Device& device);
    /// Waits for commands in flight, because they use resources that are about to be destroyed.
    ~CommandSlot();
    CommandSlot(const CommandSlot&) = delete;
    CommandSlot& operator=(const CommandSlot&) = delete;

    /// Records and submits. The slot must not be in flight. `stage` is for error messages.
    void submit(std::string_view stage, const std::function<void(const Commands&)>& record);

    /// Waits until the device has finished. Returns the device's time in seconds (0 without timestamps).
    /// `stage` is for error messages.
    double wait(std::string_view stage);

  private:
    struct Handles;
    const Device* device_;
    std::unique_ptr<Handles> handles_;
    bool inFlight_ = false;
};

/// Records and submits commands once, and waits for them.
void runOnce(const Device& device, std::string_view stage,
             const std::function<void(const Commands&)>& record);

}  // namespace duolux
