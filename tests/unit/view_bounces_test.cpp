#include "host/view/load.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class ViewBounces : public SceneFiles {
  protected:
    LoadedScene with(const std::string& keys, const SceneChoices& choices = {}) {
        write("mesh.obj", kTriangleObj);
        return loadScene(
            write("scene.json", R"({"duolux": 1, "objects": [{"mesh": "mesh.obj"}])" + keys + "}"), choices);
    }
    SceneChoices withReflectance(float t, float o) {
        SceneChoices choices;
        choices.reflectance = blendReflectance(t, o);
        return choices;
    }
};

TEST_F(ViewBounces, AreFewWhereLightMayGrowAndNothingSaysHowMany) {
    const std::string shadowless = R"(, "reflectance": {"preset": "shadowless"})";
    const std::string material = R"(, "materials": {"default": {"reflectance": {"preset": "shadowless"}}})";
    for (const LoadedScene& scene : {with(shadowless), with("", withReflectance(1, 1)), with(material),
                                     with("", withReflectance(0.5f, 1))}) {
        EXPECT_EQ(scene.settings.bounces, 4u);
        EXPECT_THAT(textsOf(scene.warnings), Contains(HasSubstr("is not specified: using 4")));
    }
    // A specified number of bounces is kept without a warning.
    SceneChoices choices = withReflectance(1, 1);
    choices.bounces = 16;
    for (const LoadedScene& scene :
         {with(shadowless + R"(, "render": {"bounces": 16})"), with("", choices)}) {
        EXPECT_EQ(scene.settings.bounces, 16u);
        EXPECT_THAT(textsOf(scene.warnings), Not(Contains(HasSubstr("may grow"))));
    }
}

TEST_F(ViewBounces, AreSixteenWhereLightFades) {
    for (const LoadedScene& scene :
         {with(""), with("", withReflectance(1, 0)), with("", withReflectance(0.1f, 1)),
          with(R"(, "reflectance": {"preset": "shadowless"})", withReflectance(0, 1)),
          with(R"(, "materials": {"default": {"diffuse": 1}})")}) {
        EXPECT_EQ(scene.settings.bounces, 16u);
        EXPECT_THAT(textsOf(scene.warnings), Not(Contains(HasSubstr("may grow"))));
    }
}

}  // namespace
}  // namespace duolux::test
