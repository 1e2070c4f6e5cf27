#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"

namespace duolux {

class AccelerationStructure;

/// A buffer or an acceleration structure that a kernel binds, all in set 0. Consecutive entries of a list
/// with the same number are the elements of an array.
struct Binding {
    std::uint32_t binding;
    const Buffer* buffer;
    const AccelerationStructure* structure = nullptr;  ///< if `buffer` is null
};

/// A specialisation constant: bool, or uint32.
struct Specialization {
    std::uint32_t id;
    std::uint32_t value;
};

/// A compute pipeline with its descriptor set. The bound resources must outlive it.
class Kernel {
  public:
    /// `name` is for error messages. Throws DeviceError if the driver fails to compile it.
    Kernel(const Device& device, std::string_view name, std::span<const std::uint32_t> spirv,
           std::span<const Binding> bindings, std::span<const Specialization> specialization,
           std::uint32_t pushConstantBytes);
    ~Kernel();
    Kernel(Kernel&& other) noexcept;
    Kernel& operator=(Kernel&& other) noexcept;

    /// Records a dispatch of `groups` work groups along x.
    template <typename Push>
    void dispatch(const Commands& commands, const Push& push, std::uint32_t groups) const {
        record(commands, std::as_bytes(std::span(&push, 1)), groups);
    }

  private:
    void record(const Commands& commands, std::span<const std::byte> push, std::uint32_t groups) const;

    struct Handles;
    std::unique_ptr<Handles> handles_;
};

}  // namespace duolux
