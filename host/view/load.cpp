#include "host/view/load.h"

#include <fmt/format.h>

#include <utility>

#include "host/base/error.h"
#include "host/base/memory.h"
#include "host/base/printable.h"
#include "host/image/scene_images.h"
#include "host/loaders/scene_file.h"
#include "host/scene/emitters.h"
#include "host/scene/energy.h"
#include "host/scene/mesh.h"
#include "host/view/emitter_sides.h"
#include "host/view/frame_camera.h"
#include "host/view/lamp.h"

namespace duolux {

namespace {

/// The warning for a scene without emitters.
Warning blackPicture(const Scene& scene) {
    std::string text = fmt::format("{}: the picture will be black",
                                   anySurfaceScatters(scene)
                                       ? "nothing emits light"
                                       : "all surfaces are black: they neither reflect nor emit light");
    return {std::move(text), WarningKind::kBlackPicture};
}

void warnOfEmitters(LoadedScene& scene, const Surface& surface) {
    for (Warning& warning : emitterWarnings(surface, scene.camera, scene.settings.aspect()))
        scene.warnings.push_back(std::move(warning));
}

/// Which part of the surface an automatic camera leaves out; empty if it shows all.
std::string describeOutliers(const Surface& surface) {
    const std::size_t outliers = surface.bulk().outliers;
    if (outliers == 0) return {};
    const Geometry& geometry = surface.scene().geometry;
    std::size_t first = 0;
    while (surface.isFramed(first))
        ++first;
    const glm::dvec3 place =
        surface.scene().origin + glm::dvec3(geometry.positions[geometry.triangles[first].x]);
    return fmt::format(
        "{} far from the rest (one of the corners is at {:g}, {:g}, {:g}): the camera shows the rest",
        outliers == 1 ? "1 triangle is" : fmt::format("{} triangles are", outliers), place.x, place.y,
        place.z);
}

/// Chooses camera and lamp.
class View {
  public:
    View(LoadedScene& scene, std::size_t framedTriangles)
        : scene_(scene),
          surface_(scene, framedTriangles),
          illumination_(surface_),
          samples_(surface_, illumination_),
          aspect_(scene.settings.aspect()) {}

    void frame(const CameraChoice& choice) {
        scene_.camera = frameCamera(choice, surface_, samples_, aspect_);
        const std::string outliers = choice.complete() ? std::string() : describeOutliers(surface_);
        if (!outliers.empty()) scene_.warnings.push_back(outliers);
        warnOfEmitters(scene_, surface_);
    }

    bool dark() const {
        return brightnessFor(scene_.camera, aspect_, surface_, illumination_, samples_) < kDark;
    }

    void addLamp() { duolux::addLamp(scene_, surface_); }

  private:
    LoadedScene& scene_;
    Surface surface_;
    Illumination illumination_;
    ViewSamples samples_;
    float aspect_;
};

/// Converts a point from the file's coordinates to the scene's.
glm::dvec3 withinScene(const Scene& scene, const char* what, const glm::dvec3& place) {
    const glm::dvec3 local = place - scene.origin;
    if (glm::any(glm::greaterThan(glm::abs(local), glm::dvec3(kLargestCoordinate)))) {
        throw InputError(scene.source.string(), what, "is too far from the scene",
                         fmt::format("expected a distance of at most {:g}", kLargestCoordinate));
    }
    return local;
}

void chooseView(LoadedScene& scene, const SceneFile& read, const SceneChoices& choices) {
    CameraChoice camera = read.camera.overriddenBy(choices.camera);
    if (const auto wrong = camera.contradiction()) {
        throw InputError(scene.source.string(), "camera", wrong->problem, wrong->remedy);
    }
    if (camera.position) *camera.position = withinScene(scene, "camera.position", *camera.position);
    if (camera.target) *camera.target = withinScene(scene, "camera.target", *camera.target);
    const bool emits = anyEmitter(scene);
    const bool mayAddLamp = choices.lamp == Lamp::kAlways ||
                            (choices.lamp == Lamp::kIfDark && !read.hasLights && anySurfaceScatters(scene));
    if (camera.complete() && !mayAddLamp) {
        scene.camera = completeCamera(camera);
        if (!emits) scene.warnings.push_back(blackPicture(scene));
        if (emits) warnOfEmitters(scene, Surface(scene, read.framedTriangles));
        return;
    }
    View view(scene, read.framedTriangles);
    view.frame(camera);
    const char* const out = "a lamp is added near the camera, out of view";
    if (choices.lamp == Lamp::kAlways) {
        view.addLamp();
    } else if (!mayAddLamp) {
        if (!emits) scene.warnings.push_back(blackPicture(scene));
    } else if (!emits) {
        view.addLamp();
        scene.warnings.push_back(fmt::format("nothing emits light: {}", out));
    } else if (view.dark()) {
        view.addLamp();
        scene.warnings.push_back(
            fmt::format("white surfaces would appear at less than {} % of white: {}", kDarkPercent, out));
    }
}

void chooseBounces(LoadedScene& scene, const SceneFile& read, const SceneChoices& choices) {
    if (choices.bounces) {
        scene.settings.bounces = *choices.bounces;
    } else if (!read.hasBounces && seriesMayGrow(scene)) {
        scene.settings.bounces = kBouncesOfGrowth;
        scene.warnings.push_back(fmt::format(
            "light may grow with every bounce, and the number of bounces is not specified: using {}",
            kBouncesOfGrowth));
    }
}

LoadedScene load(const std::filesystem::path& path, const SceneChoices& choices) {
    SceneFile read = readSceneFile(path, choices.reading);
    LoadedScene scene = std::move(read.scene);
    decodeImages(scene, choices.reading);
    if (choices.size) {
        scene.settings.width = choices.size->x;
        scene.settings.height = choices.size->y;
    }
    scene.reflectance = choices.reflectance.value_or(scene.reflectance);
    chooseBounces(scene, read, choices);
    noteContent(scene);
    chooseView(scene, read, choices);
    for (Warning& warning : scene.warnings)
        warning.text = asMessage(warning.text);
    return scene;
}

}  // namespace

LoadedScene loadScene(const std::filesystem::path& path, const SceneChoices& choices) {
    return withMemoryToRead(path, [&] { return load(path, choices); });
}

}  // namespace duolux
