#include <gtest/gtest.h>

#include <set>

#include "host/base/named.h"
#include "host/device_scene/tuning.h"
#include "host/render/render.h"
#include "host/scene/scene.h"

namespace duolux::test {
namespace {

template <typename E>
class Names : public testing::Test {};

using Enumerations = testing::Types<Sides, CameraType, Sampler, Integrator, Layout, KernelKind, DirectLight>;
TYPED_TEST_SUITE(Names, Enumerations);

TYPED_TEST(Names, StandForOneValueEach) {
    std::set<std::string> names;
    for (const TypeParam value : kValuesOf<TypeParam>) {
        EXPECT_EQ(named<TypeParam>(nameOf(value)), value);
        names.insert(nameOf(value));
    }
    EXPECT_EQ(names.size(), kValuesOf<TypeParam>.size());
    EXPECT_FALSE(names.contains(""));
    EXPECT_EQ(namesOfAll<TypeParam>().front(), nameOf(kValuesOf<TypeParam>.front()));
    EXPECT_FALSE(named<TypeParam>(""));
    EXPECT_FALSE(named<TypeParam>("no such name"));
}

// A value that is missing in an array has no name that is read. Enumerations count from 0.
TYPED_TEST(Names, ExistForAllValuesUpToTheLast) {
    for (std::size_t i = 0; i < kValuesOf<TypeParam>.size(); ++i)
        EXPECT_EQ(static_cast<std::size_t>(kValuesOf<TypeParam>[i]), i);
    EXPECT_STREQ(nameOf(static_cast<TypeParam>(kValuesOf<TypeParam>.size())), "")
        << "a value has a name, but is not in the array";
}

}  // namespace
}  // namespace duolux::test
