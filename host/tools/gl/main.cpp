// duolux-gl: renders a scene with OpenGL, as the reference for the `local` reflectance.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "host/base/clock.h"
#include "host/base/error.h"
#include "host/base/version.h"
#include "host/cli/console.h"
#include "host/cli/json.h"
#include "host/cli/options.h"
#include "host/cli/outputs.h"
#include "host/cli/program.h"
#include "host/film/image.h"
#include "host/loaders/scene_file.h"
#include "host/scene/hash.h"
#include "host/tools/gl/context.h"
#include "host/tools/gl/draw.h"
#include "host/tools/gl/opengl.h"
#include "host/view/load.h"

namespace duolux {

namespace {

constexpr float kCoarse = 0.5f;  // above this, lighting at vertices has errors of several percent

struct Arguments {
    std::string scene, lights = "5", lighting = "fixed-function", size, report;
    std::vector<std::string> outputs;
    std::vector<float> window{0.0f, 0.0f, 1.0f, 1.0f};
    std::uint32_t passes = 64;
    float exposure = 0.0f;
};

/// Throws InputError if the scene has something that is not drawn. All fields by name: a further one does not
/// compile until it is handled here.
void requireDrawable(const std::string& file, const Scene& scene) {
    const auto& [source, camera, display, reflectance, materials, geometry, pointEmitters, images, origin,
                 content] = scene;
    const auto& [positions, triangles, materialIndices, normals, normalIndices, colours, alphas, uvs,
                 secondUvs, tangents, uvIndices] = geometry;
    static_cast<void>(
        std::tie(alphas, uvs, secondUvs, tangents, uvIndices, images));  // of images and coverage
    static_cast<void>(std::tie(source, camera, origin, content, positions, triangles, materialIndices,
                               normals, normalIndices));
    static_cast<void>(reflectance);  // `local` is drawn in its place
    if (!colours.empty()) {
        throw InputError(file, "", "has colours of vertices, which duolux-gl does not draw",
                         "expected materials alone");
    }
    if (display != glm::vec2(0.0f, 1.0f)) {
        throw InputError(file, "display", "is not what OpenGL draws", "expected [0, 1]");
    }
    if (!pointEmitters.empty()) {
        throw InputError(file, "lights", "contains point lights",
                         "expected emitting surfaces, which duolux-gl replaces with OpenGL lights");
    }
    for (const Material& material : materials) {
        if (!isPlainDiffuse(material))
            throw InputError(file, fmt::format("material {}", material.name), "is not diffuse, or has images",
                             "duolux-gl draws only diffuse materials");
    }
}

void writeImages(WriteAll& write, const Arguments& arguments, const LoadedScene& scene,
                 std::vector<glm::vec3> pixels) {
    RadianceImage image{scene.settings.width, scene.settings.height, {}, std::move(pixels)};
    image.invisible.assign(image.visible.size(), glm::vec3(0.0f));
    ImageOptions options;
    options.exposure = arguments.exposure;
    options.metadata = {{"Software", fmt::format("duolux-gl {}", versionString())},
                        {"lights", arguments.lights},
                        {"lighting", arguments.lighting},
                        {"scene", hashScene(scene)}};
    for (const std::string& output : arguments.outputs)
        write(output, [&](const std::filesystem::path& path) { writeImage(path, image, options); });
}

void run(const Arguments& arguments) {
    const Tiling tiling = Tiling::parse(arguments.lights);
    std::vector<OutputFile> files;
    for (const std::string& output : arguments.outputs)
        files.push_back({"-o", output});
    if (!arguments.report.empty() && arguments.report != "-")
        files.push_back({"--report", arguments.report, false});
    checkOutputs(files, {arguments.scene});
    const Clock::time_point start = Clock::now();
    LoadedScene scene = loadScene(arguments.scene);
    checkNotRead(files, scene.files);
    for (const Warning& warning : scene.warnings)
        say(fmt::format("duolux-gl: warning: {}", warning.text));
    if (!arguments.size.empty()) {
        const glm::uvec2 size = parseSize(arguments.size);
        scene.settings.width = size.x;
        scene.settings.height = size.y;
    }
    requireDrawable(arguments.scene, scene);
    DrawOptions options;
    options.lighting = named<Lighting>(arguments.lighting).value_or(options.lighting);
    options.passes = arguments.passes;
    const std::vector<float>& window = arguments.window;
    if (!(window[2] > 0.0f && window[3] > 0.0f && window[0] + window[2] <= 1.0f &&
          window[1] + window[3] <= 1.0f)) {
        throw UsageError(fmt::format("--window {},{},{},{}: expected a non-empty part of the image",
                                     window[0], window[1], window[2], window[3]));
    }
    std::copy(arguments.window.begin(), arguments.window.end(), options.window.begin());
    std::vector<SpotLight> lights;
    if (options.lighting != Lighting::kWireframe) lights = spotLights(scene, tiling);
    if (options.lighting == Lighting::kFixedFunction && coarseness(scene, lights) > kCoarse) {
        say("duolux-gl: warning: some triangles are large against their distance from a light, and OpenGL "
            "lights them at their corners alone; use smaller ones, or --lighting per-fragment");
    }
    const double loadSeconds = secondsSince(start);

    const Clock::time_point contextStart = Clock::now();
    const GlContext context;
    const double contextSeconds = secondsSince(contextStart);
    const Clock::time_point uploadStart = Clock::now();
    GlScene glScene(scene, scene.settings);
    glFinish();
    const double uploadSeconds = secondsSince(uploadStart);
    const Clock::time_point drawStart = Clock::now();
    std::vector<glm::vec3> pixels = glScene.draw(lights, options);
    const double drawSeconds = secondsSince(drawStart);
    WriteAll write;
    writeImages(write, arguments, scene, std::move(pixels));

    if (arguments.report.empty()) return write.finish();
    nlohmann::ordered_json report;
    report["version"] = 1;
    report["program"] = {{"version", versionString()}, {"commit", commitString()}};
    report["scene"] = {{"file", arguments.scene},
                       {"hash", hashScene(scene)},
                       {"triangles", scene.geometry.triangles.size()},
                       {"vertices", glScene.statistics().vertices}};
    report["settings"] = {{"width", scene.settings.width},
                          {"height", scene.settings.height},
                          {"passes", arguments.passes},
                          {"lights", lights.size()},
                          {"lighting", arguments.lighting}};
    report["opengl"] = {{"renderer", context.renderer()},
                        {"version", context.version()},
                        {"lights_at_once", glScene.statistics().lightsAtOnce},
                        {"scene_drawings", glScene.statistics().sceneDrawings}};
    report["seconds"] = {{"load", loadSeconds},
                         {"context", contextSeconds},
                         {"upload", uploadSeconds},
                         {"draw", drawSeconds},
                         {"total", secondsSince(start)}};
    write(arguments.report, [&](const std::filesystem::path& path) { writeReport(path, jsonText(report)); });
    write.finish();
}

void parseAndRun(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{
        "Draws a scene with OpenGL's own lighting, its luminaires replaced by spot lights: the\n"
        "reference for the reflectance `local`. The scene's own reflectance is ignored.",
        "duolux-gl"};
    setUpProgram(app);
    app.add_option("SCENE", arguments.scene, fmt::format("The scene: {}", sceneExtensions()))->required();
    addRepeatable(app, "-o,--output", arguments.outputs,
                  fmt::format("Image to write: {}; may be given several times", imageExtensions()))
        ->required()
        ->type_name("FILE");
    app.add_option("--lights", arguments.lights,
                   "Spot lights of each luminaire: 5 (centre and corners of 3x3 tiles), or ROWSxCOLUMNS")
        ->capture_default_str()
        ->type_name("N");
    app.add_option(
           "--lighting", arguments.lighting,
           "OpenGL's fixed function, at vertices; the same per fragment by a shader; or the mesh's edges")
        ->check(CLI::IsMember(namesOfAll<Lighting>()))
        ->capture_default_str()
        ->type_name("NAME");
    app.add_option("--passes", arguments.passes, "Jittered images to average: samples per pixel")
        ->check(wholeNumber(1, 65536))
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--size", arguments.size, "Image size as WIDTHxHEIGHT (default: the scene's)")
        ->type_name("WIDTHxHEIGHT");
    app.add_option("--window", arguments.window,
                   "Part of the image to draw, as fractions of it: LEFT,TOP,WIDTH,HEIGHT")
        ->delimiter(',')
        ->expected(4)
        ->check(between(0.0, 1.0))
        ->type_name("L,T,W,H");
    app.add_option("--exposure", arguments.exposure, "Stops by which a PNG is brightened")
        ->check(between(-64.0, 64.0))
        ->type_name("STOPS");
    app.add_option("--report", arguments.report, "Write statistics as JSON to this file (-: standard output)")
        ->type_name("FILE");
    if (parseArguments(app, {argv + 1, argv + argc})) run(arguments);
}

}  // namespace

}  // namespace duolux

int main(int argc, char** argv) {
    return duolux::runMain("duolux-gl", [&] { duolux::parseAndRun(argc, argv); });
}
