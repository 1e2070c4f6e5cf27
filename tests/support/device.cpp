#include "tests/support/device.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace duolux::test {

Device& device() {
    static const char* selector = std::getenv("DUOLUX_DEVICE");
    static Device device(selector != nullptr ? selector : "cpu", Validation::kOn);
    return device;
}

namespace {

/// Each test fails if the validation layer said anything while it ran.
class ValidationListener : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo&) override {
        const std::vector<std::string> messages = device().validationMessages();
        for (std::size_t i = seen_; i < messages.size(); ++i)
            ADD_FAILURE() << "validation: " << messages[i];
        seen_ = messages.size();
    }
    std::size_t seen_ = 0;
};

const bool kRegistered = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new ValidationListener);
    return true;
}();

}  // namespace

}  // namespace duolux::test
