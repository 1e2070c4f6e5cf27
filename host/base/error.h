#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace duolux {

/// Base of all errors, each of a kind below, that are reported to the user as one line. what() is that line,
/// without a trailing newline.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A scene, image or checkpoint that cannot be used: "FILE: PLACE: PROBLEM; REMEDY".
/// `place` is "line 12" for text formats, a JSON path such as "camera.vfov" for JSON, or empty. `remedy` says
/// what would be right, for example "expected a number from 0 to 180".
class InputError : public Error {
  public:
    InputError(std::string_view file, std::string_view place, std::string_view problem,
               std::string_view remedy);
};

/// Something is asked for that cannot be, or is not understood.
class UsageError : public Error {
  public:
    using Error::Error;
};

/// The device or the machine failed: a Vulkan call, memory, a full disk.
class MachineError : public Error {
  public:
    using Error::Error;
};

}  // namespace duolux
