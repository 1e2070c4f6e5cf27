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

bool isFraction(float value) {
    return value >= 0.0f && value <= 1.0f;
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
        checkItems("alphas", geometry.alphas, "expected numbers from 0 to 1", isFraction);
    }

    void checkRest() const {
        // All fields by name: a further one does not compile until it is handled here.
        const auto& [source, camera, display, reflectance, materials, geometry, pointEmitters, images, origin,
                     content] = scene_;
        static_cast<void>(std::tie(source, geometry));
        checkCamera(camera);
        expect(isWithin(display, -kAnything, kAnything), "display", "expected finite numbers");
        expect(isWithin(origin, -std::numeric_limits<double>::max(), std::numeric_limits<double>::max()),
               "origin", "expected finite numbers");
        check(reflectance, "reflectance");
        for (std::size_t i = 0; i < materials.size(); ++i)
            check(materials[i], fmt::format("materials[{}]", i));
        for (std::size_t i = 0; i < images.size(); ++i)
            check(*images[i], fmt::format("images[{}]", i));
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

    template <glm::length_t N>
    void check(const GeometryField<glm::vec<N, float>>& field, const std::vector<glm::vec<N, float>>& items,
               std::size_t) const {
        checkItems(field.name, items, "expected finite numbers",
                   [](const glm::vec<N, float>& item) { return isWithin(item, -kAnything, kAnything); });
    }

    void check(const GeometryField<float>& field, const std::vector<float>& items, std::size_t) const {
        checkItems(field.name, items, "expected finite numbers",
                   [](float item) { return isWithin(glm::vec1(item), -kAnything, kAnything); });
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
        forEachField(material, [&](const char* name, const auto& field) {
            checkField(fmt::format("{}.{}", place, name), field);
        });
        const auto fraction = [&](const char* name, float value) {
            expect(isFraction(value), fmt::format("{}.{}", place, name), "expected 0 to 1");
        };
        fraction("metallic", material.metallic);
        fraction("roughness", material.roughness);
        fraction("specular", material.specular);
        fraction("transmission", material.transmission);
        fraction("clearcoat", material.clearcoat);
        fraction("clearcoat_roughness", material.clearcoatRoughness);
        fraction("sheen_roughness", material.sheenRoughness);
        fraction("anisotropy", material.anisotropy);
        fraction("alpha", material.alpha.value);
        expect(material.ior >= 1.0f && material.ior <= Material::kLargestIor, place + ".ior",
               fmt::format("expected 1 to {}", Material::kLargestIor));
        expect(material.attenuationDistance > 0.0f, place + ".attenuation_distance",
               "expected a number above 0");
    }

    // The ranges of all fields of a type; single fields have narrower ones.
    void checkField(const std::string& place, float value) const {
        expect(!std::isnan(value), place, "expected a number");
    }
    // OBJ files may have colours above 1, about which their loader warns.
    void checkField(const std::string& place, const glm::vec3& colour) const {
        expect(isWithin(colour, 0.0f, kAnything), place, "expected finite numbers from 0");
    }
    void checkField(const std::string&, bool) const {}
    void checkField(const std::string& place, const Alpha& alpha) const {
        expect(alpha.cutoff >= 0.0f, place, "expected a cutoff of 0 or more");
    }
    void checkField(const std::string&, Sides) const {}
    void checkField(const std::string& place, const Emission& emission) const {
        const auto& [invisible, visible, sides] = emission;
        static_cast<void>(sides);
        for (const glm::vec3& radiance : {invisible, visible}) {
            expect(isWithin(radiance, 0.0f, kAnything), place, "expected finite numbers from 0");
        }
    }
    void checkField(const std::string& place, const std::optional<Reflectance>& reflectance) const {
        if (reflectance) check(*reflectance, place);
    }
    void checkField(const std::string& place, const std::vector<MaterialTexture>& textures) const {
        for (std::size_t i = 0; i < textures.size(); ++i) {
            const auto& [input, texture, channel] = textures[i];
            expect(i == 0 || textures[i - 1].input < input, place,
                   "expected one texture per input, ascending");
            expect(channel < 4, place, "expected channels below 4");
            expect(texture.image < scene_.images.size(), place,
                   fmt::format("expected image indices below {}", scene_.images.size()));
            expect(texture.uvSet < 2, place, "expected UV set 0 or 1");
            const auto& [scale, offset, rotation] = texture.transform;
            for (const float value : {scale.x, scale.y, offset.x, offset.y, rotation})
                expect(std::isfinite(value), place, "expected finite transforms");
        }
    }

    void check(const Image& image, const std::string& place) const {
        const std::size_t values = std::size_t{4} * image.width * image.height;
        expect(values > 0 && image.bytes.size() + image.floats.size() == values &&
                   (image.bytes.empty() || image.floats.empty()),
               place, "expected four values per pixel");
        expect(
            std::all_of(image.floats.begin(), image.floats.end(), [](float v) { return std::isfinite(v); }),
            place, "expected finite values");
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
