#include "host/cli/exit_status.h"

namespace duolux {

ExitStatus statusOf(const Error& error) {
    if (const auto* stopped = dynamic_cast<const Stopped*>(&error)) return stopped->status();
    if (dynamic_cast<const InputError*>(&error) != nullptr) return ExitStatus::kBadInput;
    if (dynamic_cast<const UsageError*>(&error) != nullptr) return ExitStatus::kUsage;
    return ExitStatus::kMachineFailed;
}

}  // namespace duolux
