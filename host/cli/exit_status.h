#pragma once

#include <string>

#include "host/base/error.h"

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

/// A signal has ended the program's work.
class Stopped : public Error {
  public:
    Stopped(ExitStatus status, const std::string& line) : Error(line), status_(status) {}
    ExitStatus status() const { return status_; }

  private:
    ExitStatus status_;
};

/// The status of a program that ends with this error.
ExitStatus statusOf(const Error& error);

}  // namespace duolux
