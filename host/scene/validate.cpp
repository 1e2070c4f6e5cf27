#include "host/scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "host/base/error.h"
#include "host/scene/camera_choice.h"
#include "host/scene/fields.h"

namespace duolux {

namespace {

constexpr float kAnything = std::numeric_limits<float>::max();

template <glm::length_t N, typename T>
bool isWithin(const glm::vec<N, T>& v, T low, T high) {
    bool good = true;
    for (glm::length_t i = 0; i < N; ++i)
        good = good && v[i] >= low && v[i] <= high;  // false for NaN
    return good;
}

bool isFinite(const glm::vec3& v) {
    return isWithin(v, -kAnything, kAnything);
}

class Validator {
  public:
    explicit Validator(const Scene& scene) : scene_(scene) {}

    void checkGeometry() const {
        const Geometry& geometry = scene_.geometry;
        constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
        if (geometry.triangles.empty()) fail("geometry.triangles", "is empty", "expected triangles");
        if (geometry.triangles.size() > kMost || geometry.positions.size() > kMost)
            fail("geometry", "is too large", "expected fewer than 2^31 triangles and positions");
        forEachField(geometry, [&](const auto& field, const auto& items) { checkArray(field, items); });
        checkItems("colours", geometry.colours, "expected numbers from 0 to 1",
                   [](const glm::vec3& colour) { return isWithin(colour, 0.0f, 1.0f); });
    }

    void checkRest() const {
        // All fields by name: a further one does not compile until it is handled here.
        const auto& [source, camera, display, reflectance, materials, geometry, pointEmitters, origin,
                     content] = scene_;
        static_cast<void>(std::tie(source, geometry));
        checkCamera(camera);
        expect(isWithin(display, -kAnything, kAnything), "display", "expected finite numbers");
        expect(isWithin(origin, -std::numeric_limits<double>::max(), std::numeric_limits<double>::max()),
               "origin", "expected finite numbers");
        check(reflectance, "reflectance");
        for (std::size_t i = 0; i < materials.size(); ++i)
            check(materials[i], fmt::format("materials[{}]", i));
        for (std::size_t i = 0; i < pointEmitters.size(); ++i)
            check(pointEmitters[i], fmt::format("pointEmitters[{}]", i));
        if (content.positions > geometry.positions.size() || content.triangles > geometry.triangles.size() ||
            content.materials > materials.size())
            fail("content", "is more than the scene has", "expected the numbers of noteContent");
    }

  private:
    [[noreturn]] void fail(std::string_view place, std::string_view problem, std::string_view remedy) const {
        throw InputError(scene_.source.empty() ? "scene" : scene_.source.string(), place, problem, remedy);
    }

    void expect(bool good, std::string_view place, std::string_view remedy) const {
        if (!good) fail(place, "is out of range", remedy);
    }

    /// Whether all items satisfy `isGood`.
    template <typename Item, typename IsGood>
    void checkItems(const char* name, const std::vector<Item>& items, std::string_view remedy,
                    const IsGood& isGood) const {
        const auto bad = std::find_if_not(items.begin(), items.end(), isGood);
        if (bad != items.end())
            fail(fmt::format("geometry.{}[{}]", name, bad - items.begin()), "is out of range", remedy);
    }

    template <typename Item>
    void checkArray(const GeometryField<Item>& field, const std::vector<Item>& items) const {
        const GeometryCounts counts(scene_.geometry);
        const std::size_t indexed = field.indexes ? counts.of(*field.indexes) : 0;
        if (items.empty() && field.absent && indexed == 0) return;
        if (items.size() != counts.of(field.per)) {
            fail(fmt::format("geometry.{}", field.name), fmt::format("has {} items", items.size()),
                 fmt::format("expected {}", counts.of(field.per)));
        }
        check(field, items, indexed);
    }

    void check(const GeometryField<glm::vec3>& field, const std::vector<glm::vec3>& items,
               std::size_t) const {
        checkItems(field.name, items, "expected finite numbers", isFinite);
    }

    void check(const GeometryField<glm::uvec3>& field, const std::vector<glm::uvec3>& items,
               std::size_t indexed) const {
        checkItems(field.name, items, fmt::format("expected indices below {}", indexed),
                   [&](const glm::uvec3& item) {
                       return (item.x < indexed && item.y < indexed && item.z < indexed) ||
                              (field.absent && item.x == field.absent->x);
                   });
    }

    void check(const GeometryField<std::uint32_t>& field, const std::vector<std::uint32_t>& items,
               std::size_t) const {
        const std::size_t materials = scene_.materials.size();
        checkItems(field.name, items, fmt::format("expected indices below {}", materials),
                   [&](std::uint32_t item) { return item < materials; });
    }

    void check(const ReflectanceMatrix& matrix, const std::string& place) const {
        const auto& [m00, m01, m10, m11] = matrix;
        for (const glm::vec3& entry : {m00, m01, m10, m11})
            expect(isWithin(entry, 0.0f, kAnything), place, "expected finite numbers from 0");
    }

    void check(const Reflectance& reflectance, const std::string& place) const {
        const auto& [opaque, transparent] = reflectance;
        check(opaque, place + ".opaque");
        check(transparent, place + ".transparent");
    }

    void check(const Material& material, const std::string& place) const {
        const auto& [name, baseColor, metallic, roughness, sides, emission, reflectance] = material;
        static_cast<void>(std::tie(name, sides));
        // OBJ files may have colours above 1, about which their loader warns.
        expect(isWithin(baseColor, 0.0f, kAnything), place + ".baseColor", "expected finite numbers from 0");
        expect(metallic >= 0.0f && metallic <= 1.0f, place + ".metallic", "expected 0 to 1");
        expect(roughness >= 0.0f && roughness <= 1.0f, place + ".roughness", "expected 0 to 1");
        const auto& [invisible, visible, emittingSides] = emission;
        static_cast<void>(emittingSides);
        for (const glm::vec3& radiance : {invisible, visible}) {
            expect(isWithin(radiance, 0.0f, kAnything), place + ".emission",
                   "expected finite numbers from 0");
        }
        if (reflectance) check(*reflectance, place + ".reflectance");
    }

    void check(const PointEmitter& emitter, const std::string& place) const {
        const auto& [position, invisible, visible] = emitter;
        expect(isFinite(position), place + ".position", "expected finite numbers");
        for (const glm::vec3& intensity : {invisible, visible})
            expect(isWithin(intensity, 0.0f, kAnything), place, "expected finite intensities from 0");
    }

    void checkCamera(const Camera& camera) const {
        const auto& [position, target, up, vfov, type, height] = camera;
        for (const glm::vec3& vector : {position, target, up})
            expect(isFinite(vector), "camera", "expected finite vectors");
        switch (type) {
            case CameraType::kPerspective:
                expect(vfov > 0.0f && vfov < 180.0f, "camera.vfov",
                       "expected the full vertical angle in degrees, between 0 and 180");
                break;
            case CameraType::kOrthographic:
                expect(height > 0.0f && height <= kAnything, "camera.height",
                       "expected the height of the image in scene units, above 0");
                break;
        }
        CameraChoice choice;
        choice.position = glm::dvec3(position);
        choice.target = glm::dvec3(target);
        choice.up = glm::dvec3(up);
        if (const auto wrong = choice.contradiction()) fail("camera", wrong->problem, wrong->remedy);
    }

    const Scene& scene_;
};

}  // namespace

void validate(const Scene& scene) {
    const Validator validator(scene);
    validator.checkGeometry();
    validator.checkRest();
}

void validateExceptGeometry(const Scene& scene) {
    Validator(scene).checkRest();
}

void validate(const RenderSettings& settings) {
    // All fields by name: a further one does not compile until it is handled here.
    const auto& [width, height, spp, bounces, seed, sampler, integrator, layers] = settings;
    static_cast<void>(std::tie(seed, sampler, integrator, layers));  // have no wrong values
    const auto expect = [](const char* field, std::uint32_t value, std::uint32_t least, std::uint32_t most) {
        if (value >= least && value <= most) return;
        throw UsageError(
            fmt::format("settings: {} is {}; expected a number from {} to {}", field, value, least, most));
    };
    expect("width", width, 1, RenderSettings::kLargestSize);
    expect("height", height, 1, RenderSettings::kLargestSize);
    expect("spp", spp, 1, RenderSettings::kMostSpp);
    expect("bounces", bounces, 0, RenderSettings::kMostBounces);
}

}  // namespace duolux
