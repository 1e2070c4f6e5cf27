#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/render/light_tracer_kernel.h"
#include "host/render/path_tracer_kernel.h"
#include "shaders/embedded.h"
#include "tests/support/cornell.h"
#include "tests/support/device.h"
#include "tests/support/spec_ids.h"

namespace duolux::test {
namespace {

using testing::IsEmpty;

// A constant that the host forgets would silently have the default of the kernel's source.
TEST(Specialization, GivesAllConstantsOfTheKernels) {
    const LoadedScene scene = cornellBox();
    const DeviceScene deviceScene = uploadScene(device(), scene);
    const RenderInputs inputs{device(), deviceScene, scene, scene.settings};
    const std::vector<Specialization> path = pathTracerSpecialization(inputs, false);
    for (const spirv::Words& kernel :
         {spirv::kPathTracerTexel, spirv::kPathTracerStorage, spirv::kPathTracerRayQuery,
          spirv::kPathTracerPlainTexel, spirv::kPathTracerPlainStorage, spirv::kPathTracerPlainRayQuery})
        EXPECT_THAT(idsLeftOut(kernel, path), IsEmpty());
    const std::vector<Specialization> light = lightTracerSpecialization(inputs, 1, 1);
    for (const spirv::Words& kernel :
         {spirv::kLightTracerTexel, spirv::kLightTracerStorage, spirv::kLightTracerRayQuery,
          spirv::kLightTracerInt64Texel, spirv::kLightTracerInt64Storage, spirv::kLightTracerInt64RayQuery,
          spirv::kLightTracerPlainTexel, spirv::kLightTracerInt64PlainTexel})
        EXPECT_THAT(idsLeftOut(kernel, light), IsEmpty());
    EXPECT_TRUE(specIds(spirv::kPathTracerTexel).contains(shared::kSpecWorkgroupSize));
    EXPECT_TRUE(specIds(spirv::kPathTracerTexel).contains(shared::kSpecDirectLight));
    EXPECT_TRUE(specIds(spirv::kPathTracerTexel).contains(shared::kSpecLobes));
    EXPECT_FALSE(specIds(spirv::kPathTracerPlainTexel).contains(shared::kSpecLobes));
    EXPECT_TRUE(specIds(spirv::kLightTracerTexel).contains(shared::kSpecBandPixels));
}

}  // namespace
}  // namespace duolux::test
