// two_views SCENE FIRST SECOND: renders a scene with its own camera and from another position, without
// uploading it twice, and writes two images. Prints, for each, the mean radiance and the normal a third below
// the top.
#include <duolux.h>

#include <cstdio>
#include <exception>
#include <vector>

namespace {

double meanOf(const duolux::RadianceImage& image, glm::vec2 display) {
    double sum = 0.0;
    for (const glm::vec3& radiance : image.displayed(display))
        sum += static_cast<double>(radiance.x + radiance.y + radiance.z) / 3.0;
    return sum / (static_cast<double>(image.width) * image.height);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    try {
        duolux::Device device("cpu");
        const duolux::LoadedScene scene = duolux::loadScene(argv[1]);
        for (const duolux::Warning& warning : scene.warnings)
            std::fprintf(stderr, "two_views: %s\n", warning.text.c_str());
        duolux::Renderer renderer(device, scene);
        duolux::RenderSettings settings = scene.settings;
        settings.width = settings.height = 32;
        settings.spp = 4;
        settings.layers = duolux::kLayerNormal;

        duolux::Camera camera = scene.camera;
        for (const char* file : {argv[2], argv[3]}) {
            renderer.setCamera(camera);
            const duolux::RenderOutput output = renderer.render(settings);
            const duolux::RadianceImage image = output.film.resolve();
            const std::vector<float> normals = output.film.resolve(duolux::kLayerNormal);
            const float* normal = &normals[3 * (settings.height / 3 * settings.width + settings.width / 2)];
            std::printf("%s: radiance %.4f, normal %.2f %.2f %.2f\n", file, meanOf(image, scene.display),
                        static_cast<double>(normal[0]), static_cast<double>(normal[1]),
                        static_cast<double>(normal[2]));
            duolux::writeImage(file, image, {.display = scene.display});
            camera.position.x -= 100.0f;
        }
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "two_views: %s\n", e.what());
        return 1;
    }
}
