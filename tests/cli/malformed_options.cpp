#include <string>
#include <utility>
#include <vector>

#include "tests/cli/malformed_cases.h"

namespace duolux::test {

std::vector<WrongUsage> wrongUsages() {
    const auto render = [](const char* name, std::vector<std::string> options,
                           std::vector<std::string> words) {
        std::vector<std::string> arguments{"render", "good.obj", "-o", "out.png"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return WrongUsage{name, std::move(arguments), std::move(words)};
    };
    return {
        {"NoCommand", {}, {"expected a command", "render"}},
        {"UnknownCommand", {"rendre", "good.obj"}, {"rendre", "\"render\""}},
        {"RenderWithoutScene", {"render"}, {"SCENE"}},
        {"InfoWithoutScene", {"info"}, {"SCENE"}},
        {"InfoOfTwoScenes", {"info", "good.obj", "other.obj"}, {"other.obj"}},
        render("UnknownOption", {"--sppp", "4"}, {"--sppp"}),
        render("SamplesZero", {"--spp", "0"}, {"--spp", "1"}),
        render("SamplesOfWord", {"--spp", "many"}, {"--spp", "many"}),
        render("SamplesTooMany", {"--spp", "99999999999"}, {"--spp"}),
        render("BouncesNegative", {"--bounces", "-1"}, {"--bounces"}),
        render("BouncesTooMany", {"--bounces", "65536"}, {"--bounces", "65535"}),
        render("SeedNegative", {"--seed", "-1"}, {"--seed"}),
        render("SizeOfOne", {"--size", "640"}, {"--size 640", "WIDTHxHEIGHT"}),
        render("SizeZero", {"--size", "0x480"}, {"--size 0x480", "1 to 16384"}),
        render("SizeHuge", {"--size", "640x16385"}, {"--size 640x16385", "16384"}),
        render("PresetUnknown", {"--preset", "glob"}, {"--preset", "glob", "global"}),
        render("BlendOfOne", {"--blend", "0.5"}, {"--blend 0.5", "T,O"}),
        render("BlendNegative", {"--blend", "1,-1"}, {"--blend 1,-1", "from 0 to 1"}),
        render("BlendTooLarge", {"--blend", "2,0"}, {"--blend 2,0", "from 0 to 1"}),
        render("LookAtOfTwo", {"--look-at", "1,2"}, {"--look-at 1,2", "X,Y,Z"}),
        render("LookAtOfWord", {"--look-at", "1,2,up"}, {"--look-at 1,2,up", "X,Y,Z"}),
        render("CameraPositionInfinite", {"--camera-position", "1,2,1e30"},
               {"--camera-position 1,2,1e30", "1e+18"}),
        render("CameraPositionNotANumber", {"--camera-position", "nan,2,3"}, {"--camera-position nan,2,3"}),
        render("CameraAtWhatItLooksAt", {"--camera-position", "1,2,3", "--look-at", "1,2,3"},
               {"--camera-position 1,2,3", "--look-at", "the same"}),
        render("UpAlongTheView", {"--camera-position", "1,2,3", "--look-at", "1,2,9", "--up", "z"},
               {"--up z", "parallel to the view direction"}),
        render("UpOfWord", {"--up", "w"}, {"--up w", "y, z or"}),
        render("UpZero", {"--up", "0,0,0"}, {"--up 0,0,0", "no direction"}),
        render("VfovZero", {"--vfov", "0"}, {"--vfov", "179.9"}),
        render("VfovTooLarge", {"--vfov", "180"}, {"--vfov", "179.9"}),
        render("LampAndNone", {"--lamp", "--no-lamp"}, {"--lamp", "--no-lamp"}),
        render("OutputTwice", {"-o", "./out.png"}, {"./out.png", "written by -o"}),
        render("OutputIsScene", {"--report", "good.obj"}, {"--report good.obj", "read by this command"}),
        render("OutputIsFolder", {"--report", "."}, {"--report .", "is a folder"}),
        render("BlendNotFinite", {"--blend", "nan,1"}, {"--blend nan,1"}),
        render("PresetAndBlend", {"--preset", "local", "--blend", "1,1"}, {"--preset", "--blend"}),
        render("SamplerUnknown", {"--sampler", "halton"}, {"--sampler", "halton", "sobol"}),
        render("ExposureOfWord", {"--exposure", "bright"}, {"--exposure", "bright"}),
        render("TimeLimitNegative", {"--time-limit", "-1"}, {"--time-limit"}),
        render("IntegratorUnknown", {"--integrator", "lights"}, {"--integrator", "lights", "light"}),
        render("DirectLightOfLightPaths", {"--integrator", "light", "--direct-light", "sampled"},
               {"--direct-light", "--integrator path"}),
        render("LayoutUnknown", {"--layout", "rays"}, {"--layout", "rays", "ray-query"}),
        render("KernelUnknown", {"--kernel", "fast"}, {"--kernel", "fast", "refilling"}),
        render("SampleRangeOfOne", {"--sample-range", "4"}, {"--sample-range 4", "A:B"}),
        render("SampleRangeEmpty", {"--sample-range", "4:4"}, {"--sample-range 4:4", "A < B"}),
        render("SampleRangeBeyond", {"--spp", "8", "--sample-range", "4:9"}, {"4:9", "B <= 8"}),
        render("ResumeOfNothing", {"--resume", ""}, {"--resume", "not an empty text"}),
        render("CheckpointFolder", {"--checkpoint", "nowhere/state"}, {"--checkpoint", "nowhere"}),
        render("CheckpointIsScene", {"--checkpoint", "good.obj"}, {"good.obj", "read by this command"}),
        {"MergeWithoutOutput", {"merge", "a", "b"}, {"--output"}},
        {"MergeOfNothing", {"merge", "-o", "a.png"}, {"PART"}},
        {"MergeOverPart", {"merge", "-o", "a.png", "a.png"}, {"a.png", "read by this command"}},
        render("OutputFormat", {"-o", "picture.jpg"}, {"picture.jpg", ".exr, .png or .pfm"}),
        render("OutputFolder", {"-o", "nowhere/picture.png"}, {"nowhere"}),
        {"CompareOfOne", {"compare", "a.png"}, {"REFERENCE"}},
        {"CompareLimitWithoutValue",
         {"compare", "a.png", "b.png", "--fail-above", "rmse"},
         {"--fail-above rmse", "METRIC=VALUE"}},
        {"CompareLimitOfWord",
         {"compare", "a.png", "b.png", "--fail-above", "rmse=low"},
         {"rmse=low", "number"}},
        {"CompareLimitUnknown", {"compare", "a.png", "b.png", "--fail-above", "rmsd=1"}, {"rmsd", "rmse"}},
        {"CompareLimitPsnr", {"compare", "a.png", "b.png", "--fail-above", "psnr=1"}, {"psnr"}},
        {"CompareTransfer", {"compare", "a.png", "b.png", "--transfer", "gamma"}, {"gamma", "srgb"}},
        {"CompareHeatMap", {"compare", "a.png", "b.png", "--heatmap", "map.jpg"}, {"map.jpg", ".png"}},
        {"CompareHeatMapRange", {"compare", "a.png", "b.png", "--heatmap-range", "0"}, {"--heatmap-range"}},
        {"MakeSceneWithoutName", {"make-scene", "-o", "new"}, {"NAME"}},
        {"MakeSceneWithoutFolder", {"make-scene", "two-spheres"}, {"--output"}},
        {"MakeSceneUnknown", {"make-scene", "teapot", "-o", "new"}, {"\"teapot\"", "two-spheres"}},
        {"MakeSceneTooFew",
         {"make-scene", "two-spheres", "--triangles", "99", "-o", "new"},
         {"--triangles", "99", "100"}},
        {"MakeSceneNegative",
         {"make-scene", "two-spheres", "--triangles", "-5", "-o", "new"},
         {"--triangles", "-5"}},
    };
}

}  // namespace duolux::test
