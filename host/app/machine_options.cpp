#include "host/app/machine_options.h"

#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "host/base/parallel.h"
#include "host/cli/options.h"

namespace duolux {

namespace {

/// Runs `step`, which needs a driver, and adds relevant environment variables to the error if none can be
/// loaded.
template <typename Step>
auto withDriver(const Step& step) {
    try {
        return step();
    } catch (const NoDriverError& e) {
        std::string line = e.what();
        for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
            const char* value = std::getenv(name);
            if (value != nullptr) line += fmt::format("; {} is set to '{}'", name, value);
        }
        throw DeviceError(line);
    }
}

/// Mesa's software driver reads its number of threads from the environment when it is loaded.
void chooseThreads(unsigned count) {
    limitWorkers(count);
    ::setenv("LP_NUM_THREADS", std::to_string(workerCount()).c_str(), 1);
}

}  // namespace

void addDeviceOption(CLI::App& command, std::string& device) {
    command
        .add_option(
            "--device", device,
            "cpu, gpu, an index or part of a name, see 'duolux devices' (default: a GPU if there is one)")
        ->type_name("DEVICE");
}

void addThreadsOption(CLI::App& command) {
    command
        .add_option_function<unsigned>(
            "--threads", chooseThreads,
            "Number of threads of the program and of the software driver; may exceed the number of cores "
            "(default and 0: one per core). Images do not depend on it")
        ->type_name("N")
        ->check(wholeNumber(0, 1024));
}

Device openDevice(const std::string& selector) {
    return withDriver([&] {
        try {
            return Device(selector);
        } catch (const UsageError& e) {
            throw UsageError(fmt::format("--device {}: {}", selector, e.what()));
        }
    });
}

std::vector<DeviceInfo> findDevices() {
    return withDriver([] { return listDevices(); });
}

}  // namespace duolux
