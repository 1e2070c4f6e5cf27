#include "tests/support/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "host/base/error.h"

namespace duolux::test {

namespace {

std::unique_ptr<Device>& opened() {
    static std::unique_ptr<Device> device;
    return device;
}

/// Fails the test if there are new validation messages.
void checkMessages(std::size_t& seen) {
    const std::vector<std::string> messages = opened()->validationMessages();
    for (std::size_t i = seen; i < messages.size(); ++i)
        ADD_FAILURE() << "validation: " << messages[i];
    seen = messages.size();
}

std::size_t seenMessages = 0;

class ValidationListener : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo&) override {
        if (opened() != nullptr) checkMessages(seenMessages);
    }
    /// Checks messages after the last test.
    void OnEnvironmentsTearDownEnd(const testing::UnitTest&) override {
        if (opened() != nullptr) checkMessages(seenMessages);
    }
    void OnTestProgramEnd(const testing::UnitTest&) override { closeDevice(); }
};

const bool kRegistered = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new ValidationListener);
    return true;
}();

}  // namespace

std::string deviceSelector() {
    const char* selector = std::getenv("DUOLUX_DEVICE");
    return selector != nullptr ? selector : "cpu";
}

Device& device() {
    try {
        if (opened() == nullptr) opened() = std::make_unique<Device>(deviceSelector(), Validation::kOn);
    } catch (const UsageError& e) {
        throw UsageError("DUOLUX_DEVICE=" + deviceSelector() + ": " + e.what());
    }
    return *opened();
}

void closeDevice() {
    opened().reset();
}

}  // namespace duolux::test
