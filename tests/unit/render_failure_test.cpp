// The kinds of errors if a device fails or memory runs out.
#include <gtest/gtest.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <string>

#include "host/render/render.h"
#include "host/view/load.h"

namespace duolux {
namespace {

/// A device with a fault, as specified for tests/support/fault_layer.
class FaultyDevice {
  public:
    FaultyDevice(const char* fault, int number) : fault_(fault) {
        ::setenv("VK_LAYER_PATH", DUOLUX_FAULT_LAYER, 1);
        ::setenv("VK_INSTANCE_LAYERS", "VK_LAYER_DUOLUX_fault", 1);
        ::setenv(fault, std::to_string(number).c_str(), 1);
        device_.emplace("cpu");
    }
    ~FaultyDevice() {
        device_.reset();
        for (const char* name : {"VK_LAYER_PATH", "VK_INSTANCE_LAYERS", fault_})
            ::unsetenv(name);
    }
    FaultyDevice(const FaultyDevice&) = delete;
    FaultyDevice& operator=(const FaultyDevice&) = delete;

    Device& operator*() { return *device_; }

  private:
    const char* fault_;
    std::optional<Device> device_;
};

LoadedScene cornell() {
    LoadedScene scene = loadScene(DUOLUX_ASSETS "/cornell/cornell.json");
    scene.settings.width = 64;
    scene.settings.height = 48;
    scene.settings.spp = 64;
    return scene;
}

TEST(Failure, ALostDeviceIsADeviceError) {
    FaultyDevice device("DUOLUX_FAULT_LOST", 0);
    EXPECT_THROW(render(*device, cornell()), DeviceError);
}

TEST(Failure, AfterSomeSamplesTheDeviceErrorIsNested) {
    FaultyDevice device("DUOLUX_FAULT_LOST", 5);  // after the first look at the image
    try {
        render(*device, cornell());
        ADD_FAILURE() << "expected RenderFailure";
    } catch (const RenderFailure& e) {
        EXPECT_GT(e.output().film.totalSamples(), 0u);
        EXPECT_THROW(std::rethrow_if_nested(e), DeviceError);
    }
}

TEST(Failure, OutOfDeviceMemoryIsAMemoryError) {
    FaultyDevice device("DUOLUX_FAULT_MEMORY", 1);
    EXPECT_THROW(render(*device, cornell()), MemoryError);
}

TEST(Failure, OutOfHostMemoryIsAMemoryErrorToo) {
    Device device("cpu");
    RenderControl control;
    control.onProgress = [](const RenderProgress& progress) -> bool {
        if (progress.samplesDone > 0) throw std::bad_alloc();
        return true;
    };
    try {
        render(device, cornell(), control);
        ADD_FAILURE() << "expected RenderFailure";
    } catch (const RenderFailure& e) {
        EXPECT_GT(e.output().film.totalSamples(), 0u);
        EXPECT_THROW(std::rethrow_if_nested(e), MemoryError);
    }
}

}  // namespace
}  // namespace duolux
