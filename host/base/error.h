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

/// A request that is malformed, contradictory or not supported.
class UsageError : public Error {
  public:
    using Error::Error;
};

/// The device or the machine failed: one of the kinds below, or for example a full disk.
class MachineError : public Error {
  public:
    using Error::Error;
};

/// A device is missing, a call to it failed, or its limits other than memory do not suffice.
class DeviceError : public MachineError {
  public:
    using MachineError::MachineError;
};

/// The memory of the device or of the host does not suffice.
class MemoryError : public MachineError {
  public:
    using MachineError::MachineError;
};

}  // namespace duolux
