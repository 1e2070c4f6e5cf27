#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace duolux {

/// Exit statuses of the program (a contract with scripts).
enum class ExitStatus : int {
    kDone = 0,
    kMachineFailed = 1,
    kUsage = 2,
    kBadInput = 3,
    kInterrupted = 130,
    kTerminated = 143
};

/// Base of all errors that are reported to the user as one line. what() is that line, without a trailing
/// newline.
class Error : public std::runtime_error {
  public:
    Error(ExitStatus status, const std::string& line) : std::runtime_error(line), status_(status) {}
    ExitStatus status() const { return status_; }

  private:
    ExitStatus status_;
};

/// A scene, image or checkpoint that cannot be used: "FILE: PLACE: PROBLEM; REMEDY".
/// `place` is "line 12" for text formats, a JSON path such as "camera.vfov" for JSON, or empty. `remedy` says
/// what would be right, for example "expected a number from 0 to 180".
class InputError : public Error {
  public:
    InputError(std::string_view file, std::string_view place, std::string_view problem,
               std::string_view remedy);
};

/// Incorrect use of the command line (exit status 2).
class UsageError : public Error {
  public:
    explicit UsageError(const std::string& line) : Error(ExitStatus::kUsage, line) {}
};

/// The device or the machine failed: a Vulkan call, a full disk (exit status 1).
class MachineError : public Error {
  public:
    explicit MachineError(const std::string& line) : Error(ExitStatus::kMachineFailed, line) {}
};

}  // namespace duolux
