#include "host/tools/paper/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/film/sheet.h"
#include "host/generators/two_spheres.h"
#include "host/tools/compare/heat_map.h"
#include "host/tools/paper/program.h"

namespace duolux {

namespace {

namespace fs = std::filesystem;

class Laboratory {
  public:
    explicit Laboratory(const ExperimentSetup& setup) : setup_(setup) {}

    Experiment run() {
        makeScenes();
        figureOne();
        referenceImages();
        compareAll();
        figureFour();
        explainResidual();
        race();
        return std::move(result_);
    }

  private:
    fs::path file(const std::string& name) const { return setup_.folder / name; }
    std::string text(const std::string& name) const { return file(name).string(); }

    static void say(const std::string& line) { fmt::print(stderr, "==> {}\n", line); }

    /// `duolux render` of a scene in the folder to NAME.exr and .png; returns its report.
    nlohmann::json transport(const std::string& scene, const std::string& name,
                             std::vector<std::string> options) {
        const std::string size = fmt::format("{0}x{0}", setup_.size);
        options.insert(options.begin(), {"render", text(scene), "-o", text(name + ".exr"), "-o",
                                         text(name + ".png"), "--size", size, "--quiet"});
        nlohmann::json report = runProgram(setup_.duolux, std::move(options), file("report.json"));
        result_.device = report["device"]["name"].get<std::string>() + ", " +
                         report["device"]["driver"].get<std::string>();
        return report;
    }

    nlohmann::json openGl(const std::string& scene, const std::string& name,
                          std::vector<std::string> options) {
        const std::string size = fmt::format("{0}x{0}", setup_.size);
        options.insert(options.begin(),
                       {text(scene), "-o", text(name + ".exr"), "-o", text(name + ".png"), "--size", size});
        nlohmann::json report = runProgram(setup_.duoluxGl, std::move(options), file("report.json"));
        result_.openGl = report["opengl"]["renderer"].get<std::string>() + ", " +
                         report["opengl"]["version"].get<std::string>();
        return report;
    }

    RadianceImage image(const std::string& name) const { return readImage(file(name + ".exr")); }

    /// Writes the scene's JSON again with other emissions.
    void writeVariant(const std::string& name, const nlohmann::json& materials) {
        nlohmann::json scene = nlohmann::json::parse(readFile(file("scene/two_spheres.json")));
        scene["materials"].update(materials);
        writeFile(file("scene/" + name), scene.dump(2) + "\n");
    }

    void makeScenes() {
        say(fmt::format("Two spheres, {} triangles", setup_.triangles));
        writeTwoSpheres(file("scene"), setup_.triangles);
        const auto emission = [](double invisible, glm::dvec2 visible) {
            return nlohmann::json{{"emission",
                                   {{"invisible", {invisible, invisible, invisible}},
                                    {"visible", {visible.x, visible.y, 0.0}},
                                    {"sides", "both"}}}};
        };
        writeVariant(
            "visible.json",
            {{"luminaire", {{"emission", {{"invisible", {18, 18, 18}}, {"visible", {18, 18, 18}}}}}}});
        // Each object shows its number i as the colour (i, i^2): a mixture of two is on no object's parabola.
        nlohmann::json objects;
        double i = 1.0;
        for (const char* name :
             {"floor", "ceiling", "back", "left", "right", "luminaire", "left_sphere", "right_sphere"}) {
            objects[name] = emission(0.0, {i, i * i});
            i += 1.0;
        }
        writeVariant("objects.json", objects);
    }

    void figureOne() {
        say("Figure 1: the four reflectances, luminaire visible");
        std::vector<SheetCell> cells;
        for (const char* preset : {"global", "shadowless", "one-bounce", "local"}) {
            const std::string name = std::string("figure1-") + preset;
            std::vector<std::string> options{"--preset", preset, "--spp", setup_.quick ? "4" : "256"};
            // The series of `shadowless` diverges: this image has four bounces.
            if (std::string_view(preset) == "shadowless") options.insert(options.end(), {"--bounces", "4"});
            transport("scene/visible.json", name, options);
            cells.push_back({image(name), preset});
        }
        writeImage(file("figure1.png"), makeSheet(cells, 4), {});
    }

    /// OpenGL's pictures: name of each is "gl-LIGHTS-LIGHTING".
    void referenceImages() {
        struct Kind {
            const char* lights;
            const char* lighting;
        };
        std::vector<Kind> kinds{{"5", "fixed-function"},
                                {"3x3", "fixed-function"},
                                {"5", "per-fragment"},
                                {"3x3", "per-fragment"}};
        if (!setup_.quick)
            kinds.insert(kinds.end(),
                         {{"8x8", "fixed-function"}, {"8x8", "per-fragment"}, {"32x32", "per-fragment"}});
        for (const Kind& kind : kinds) {
            say(fmt::format("OpenGL, {} lights, {}", kind.lights, kind.lighting));
            const std::string name = fmt::format("gl-{}-{}", kind.lights, kind.lighting);
            openGl("scene/two_spheres.json", name,
                   {"--lights", kind.lights, "--lighting", kind.lighting, "--passes",
                    fmt::format("{}", setup_.passes)});
            references_.push_back({kind.lights, kind.lighting});
        }
    }

    /// True away from silhouettes: where a pixel and its neighbours show the same object.
    std::vector<bool> smoothPixels() {
        say("Where the silhouettes are");
        transport("scene/objects.json", "objects", {"--bounces", "0", "--spp", "256"});
        const RadianceImage objects = image("objects");
        const auto n = static_cast<int>(setup_.size);
        const auto at = [&](int x, int y) {
            return objects
                .visible[static_cast<std::size_t>(std::clamp(y, 0, n - 1) * n + std::clamp(x, 0, n - 1))];
        };
        std::vector<bool> smooth;
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                bool one = true;
                for (int k = 0; k < 9; ++k) {
                    const glm::vec3 p = at(x + k % 3 - 1, y + k / 3 - 1);
                    one = one && std::abs(p.y - p.x * p.x) < 1e-3f && std::abs(p.x - at(x, y).x) < 1e-3f;
                }
                smooth.push_back(one);
            }
        }
        RadianceImage mask{setup_.size, setup_.size, {}, {}};
        mask.invisible.resize(smooth.size());
        for (const bool s : smooth)
            mask.visible.emplace_back(s ? 1.0f : 0.0f);
        writeImage(file("mask.png"), mask, {});
        result_.silhouetteFraction = static_cast<double>(std::count(smooth.begin(), smooth.end(), false)) /
                                     static_cast<double>(smooth.size());
        return smooth;
    }

    Comparison compareWhere(const RadianceImage& a, const RadianceImage& b,
                            const std::vector<bool>& mask) const {
        CompareOptions options;
        options.mask = mask;
        return compare(a, b, options);
    }

    void compareAll() {
        smooth_ = smoothPixels();
        std::vector<bool> silhouettes = smooth_;
        silhouettes.flip();
        for (const char* estimator : {"closed-form", "sampled"}) {
            for (const std::uint32_t spp : setup_.spp) {
                say(fmt::format("local by transport, {}, {} samples per pixel", estimator, spp));
                const std::string name = fmt::format("local-{}-{}", estimator, spp);
                transport(
                    "scene/two_spheres.json", name,
                    {"--preset", "local", "--direct-light", estimator, "--spp", fmt::format("{}", spp)});
                const RadianceImage picture = image(name);
                for (const auto& [lights, lighting] : references_) {
                    const RadianceImage reference = image(fmt::format("gl-{}-{}", lights, lighting));
                    result_.cells.push_back({lights, lighting, estimator, spp,
                                             compareWhere(picture, reference, {}),
                                             compareWhere(picture, reference, smooth_),
                                             compareWhere(picture, reference, silhouettes)});
                }
            }
        }
    }

    std::string best() const { return fmt::format("local-closed-form-{}", setup_.spp.back()); }

    /// Each pixel as scale x scale pixels.
    static RadianceImage magnify(const RadianceImage& in, std::uint32_t x0, std::uint32_t y0,
                                 std::uint32_t size, std::uint32_t scale) {
        RadianceImage out{size * scale, size * scale, {}, {}};
        for (std::uint32_t y = 0; y < out.height; ++y) {
            for (std::uint32_t x = 0; x < out.width; ++x)
                out.visible.push_back(in.visible[std::size_t{y0 + y / scale} * in.width + x0 + x / scale]);
        }
        out.invisible.resize(out.visible.size());
        return out;
    }

    void figureFour() {
        say("Figure 4: OpenGL, the mesh, and details");
        const std::string gl = "gl-5-fixed-function";
        const std::string local = fmt::format("local-sampled-{}", setup_.spp.back());
        writeImage(file("figure4-pictures.png"),
                   makeSheet(std::vector<SheetCell>{{image(gl), "OpenGL, 5 lights"},
                                                    {image(local), "local, by transport"}},
                             2),
                   {});
        // The upper left of the left sphere.
        const std::uint32_t size = setup_.size / 8;
        const std::uint32_t x = setup_.size * 25 / 100;
        const std::uint32_t y = setup_.size * 55 / 100;
        const double part = static_cast<double>(size) / setup_.size;
        openGl("scene/two_spheres.json", "mesh",
               {"--lighting", "wireframe", "--passes", "16", "--window",
                fmt::format("{},{},{},{}", static_cast<double>(x) / setup_.size + part * 0.4,
                            static_cast<double>(y) / setup_.size + part * 0.3, part / 4, part / 4)});
        const std::uint32_t scale = 8;
        RadianceImage mesh = image("mesh");
        if (mesh.width != size * scale) mesh = magnify(mesh, 0, 0, size * scale, 1);
        writeImage(
            file("figure4-details.png"),
            makeSheet(
                std::vector<SheetCell>{{std::move(mesh), "triangle mesh (detail)"},
                                       {magnify(image(gl), x, y, size, scale), "OpenGL (detail)"},
                                       {magnify(image(local), x, y, size, scale), "path tracer (detail)"}},
                3),
            {});
        for (const std::string& reference : {gl, std::string("gl-5-per-fragment")}) {
            const RadianceImage a = image(local);
            writeImage(file("heat-" + reference + ".png"),
                       heatMap(epsMap(a, image(reference), {}), a.width, a.height, 0.02f), {});
        }
    }

    double eps(const std::string& a, const std::string& b, const std::vector<bool>& mask) const {
        return compareWhere(image(a), image(b), mask).epsMean;
    }

    void explainResidual() {
        const std::string gl = "gl-5-fixed-function";
        const std::string fragment = "gl-5-per-fragment";
        const std::string many = setup_.quick ? "gl-3x3-per-fragment" : "gl-32x32-per-fragment";
        auto& r = result_.residual;
        r.emplace_back("all of it: closed form against OpenGL's fixed function with five lights",
                       eps(best(), gl, {}));
        r.emplace_back("five lights in place of an area: OpenGL per fragment, five against the most lights",
                       eps(fragment, many, {}));
        r.emplace_back("lighting at vertices: OpenGL, fixed function against per fragment",
                       eps(gl, fragment, {}));
        r.emplace_back(
            "the rest, at silhouettes: closed form against OpenGL per fragment with the most lights, all "
            "pixels",
            eps(best(), many, {}));
        r.emplace_back("the same away from silhouettes", eps(best(), many, smooth_));
        r.emplace_back(
            fmt::format("noise: sampled at {} spp against closed form",
                        setup_.spp[std::min<std::size_t>(1, setup_.spp.size() - 1)]),
            eps(fmt::format("local-sampled-{}", setup_.spp[std::min<std::size_t>(1, setup_.spp.size() - 1)]),
                best(), {}));
    }

    void race() {
        for (const std::uint32_t triangles : setup_.crossing) {
            Race race;
            const std::string folder = fmt::format("race-{}", triangles);
            race.triangles = writeTwoSpheres(file(folder), triangles);
            say(fmt::format("Speed, {} triangles", race.triangles));
            const std::string scene = folder + "/two_spheres.json";
            for (int i = 0; i < setup_.repetitions; ++i) {
                for (const char* estimator : {"closed-form", "sampled"}) {
                    const nlohmann::json report = transport(
                        scene, "race", {"--preset", "local", "--spp", "64", "--direct-light", estimator});
                    const double seconds = report["seconds"]["render"];
                    const bool sampled = std::string_view(estimator) == "sampled";
                    (sampled ? race.sampled : race.transport).push_back(seconds);
                    if (!sampled) race.transportAll.push_back(report["seconds"]["total"]);
                }
                const nlohmann::json report = openGl(scene, "race", {"--lights", "5", "--passes", "64"});
                race.openGl.push_back(report["seconds"]["draw"]);
                race.openGlAll.push_back(report["seconds"]["total"]);
            }
            result_.races.push_back(std::move(race));
            fs::remove_all(file(folder));
        }
        say("Time to the paper's error");
        for (const std::uint32_t samples : {1u, 2u, 4u, 8u, 16u, 32u, 64u}) {
            const std::string count = fmt::format("{}", samples);
            if (result_.transportTo.seconds == 0.0) {
                const nlohmann::json report =
                    transport("scene/two_spheres.json", "race", {"--preset", "local", "--spp", count});
                reached(result_.transportTo, samples, eps("race", "gl-5-fixed-function", {}),
                        report["seconds"]["render"]);
            }
            if (result_.openGlTo.seconds == 0.0) {
                const nlohmann::json report = openGl("scene/two_spheres.json", "race", {"--passes", count});
                reached(result_.openGlTo, samples, eps("race", best(), {}), report["seconds"]["draw"]);
            }
        }
    }

    static void reached(TimeToError& out, std::uint32_t samples, double eps, double seconds) {
        if (eps <= kPaperEps) out = {samples, eps, seconds};
    }

    const ExperimentSetup& setup_;
    Experiment result_;
    std::vector<std::pair<std::string, std::string>> references_;
    std::vector<bool> smooth_;
};

}  // namespace

double Race::median(const std::vector<double>& seconds) const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
}

Experiment runExperiment(const ExperimentSetup& setup) {
    std::error_code error;
    fs::create_directories(setup.folder, error);
    if (error)
        throw UsageError(fmt::format("-o {}: {}; expected a folder", setup.folder.string(), error.message()));
    return Laboratory(setup).run();
}

}  // namespace duolux
