#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "host/scene/fields.h"
#include "host/scene/hash.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {
namespace {

class HashTest : public SceneFiles {};

/// Changes everything in a scene that the image depends on, one number at a time, and expects that each
/// change gives another hash than all before. Goes by the lists of fields.
class Perturbation {
  public:
    explicit Perturbation(Scene scene) : scene_(std::move(scene)) { note("nothing"); }

    void run() {
        // All fields by name: a further one does not compile until it is handled here.
        auto& [source, camera, display, reflectance, materials, geometry, pointEmitters, images, origin,
               content] = scene_;
        static_cast<void>(std::tie(source, content));  // see NamesAndSettingsDoNotCount
        fields("camera", camera);
        change("camera.type", camera.type);
        change("display", display);
        change("reflectance", reflectance);
        for (Material& material : materials) {
            const std::string place = "materials " + material.name;
            // The list is of constant fields, but the scene is not constant.
            forEachField(material, [&]<typename T>(const char* name, const T& field) {
                change(place + "." + name, const_cast<T&>(field));
            });
        }
        forEachField(geometry, [&](const auto& field, auto& items) { change(field.name, items); });
        for (PointEmitter& emitter : pointEmitters)
            fields("pointEmitters", emitter);
        resize("pointEmitters", pointEmitters);
        for (std::shared_ptr<const Image>& image : images)
            change("images", image);
        resize("images", images);
        change("origin", origin);
    }

    std::size_t count() const { return hashes_.size(); }

  private:
    void note(const std::string& what) {
        const auto [entry, isNew] = hashes_.try_emplace(hashScene(scene_), what);
        EXPECT_TRUE(isNew) << what << " has the hash of " << entry->second;
    }

    template <typename T>
    void changeTo(const std::string& what, T& value, const T& other) {
        const T before = value;
        value = other;
        note(what);
        value = before;
    }

    template <typename Object>
    void fields(const std::string& place, Object& object) {
        // A camera's type decides which fields it has.
        forEachField(object, [&]<typename T>(const char* name, T& field) {
            if constexpr (!std::is_same_v<T, CameraType>) change(place + "." + name, field);
        });
    }

    void change(const std::string& what, float& value) { changeTo(what, value, value + 0.25f); }
    void change(const std::string& what, double& value) { changeTo(what, value, value + 0.25); }
    void change(const std::string& what, std::uint32_t& value) { changeTo(what, value, value + 1); }
    void change(const std::string& what, Sides& value) {
        changeTo(what, value, value == Sides::kBoth ? Sides::kFront : Sides::kBoth);
    }
    void change(const std::string& what, CameraType& value) {
        changeTo(what, value, CameraType::kOrthographic);
        value = CameraType::kOrthographic;
        fields("camera", scene_.camera);
        value = CameraType::kPerspective;
    }
    void change(const std::string& what, bool& value) { changeTo(what, value, !value); }
    template <typename E>
    requires std::is_enum_v<E>
    void change(const std::string& what, E& value) {
        changeTo(what, value, static_cast<E>((static_cast<int>(value) + 1) % 2));
    }
    void change(const std::string& what, Alpha& alpha) {
        auto& [mode, value, cutoff] = alpha;
        change(what + ".mode", mode);
        change(what + ".value", value);
        change(what + ".cutoff", cutoff);
    }
    void change(const std::string& what, MaterialTexture& used) {
        auto& [input, texture, channel] = used;
        change(what + ".input", input);
        change(what + ".channel", channel);
        auto& [image, colourSpace, wrapU, wrapV, filter, uvSet, transform] = texture;
        change(what + ".image", image);
        change(what + ".colourSpace", colourSpace);
        change(what + ".wrapU", wrapU);
        change(what + ".wrapV", wrapV);
        change(what + ".filter", filter);
        change(what + ".uvSet", uvSet);
        auto& [scale, offset, rotation] = transform;
        change(what + ".scale", scale);
        change(what + ".offset", offset);
        change(what + ".rotation", rotation);
    }
    void change(const std::string& what, std::shared_ptr<const Image>& image) {
        const std::shared_ptr<const Image> before = image;
        Image other = *before;
        auto& [name, width, height, bytes, floats] = other;
        const auto noteImage = [&](const char* field) {
            image = std::make_shared<Image>(other);
            note(what + field);
            other = *before;
        };
        std::swap(width, height);
        noteImage(".size");
        bytes[1] ^= 1u;
        noteImage(".bytes");
        floats.push_back(0.5f);
        noteImage(".floats");
        image = before;
    }
    template <glm::length_t N, typename T>
    void change(const std::string& what, glm::vec<N, T>& value) {
        for (glm::length_t i = 0; i < N; ++i)
            change(what + "[" + std::to_string(i) + "]", value[i]);
    }
    void change(const std::string& what, ReflectanceMatrix& value) {
        auto& [m00, m01, m10, m11] = value;
        change(what + ".m00", m00);
        change(what + ".m01", m01);
        change(what + ".m10", m10);
        change(what + ".m11", m11);
    }
    void change(const std::string& what, Reflectance& value) {
        auto& [opaque, transparent] = value;
        change(what + ".opaque", opaque);
        change(what + ".transparent", transparent);
    }
    void change(const std::string& what, std::optional<Reflectance>& value) {
        if (value) change(what, *value);
        changeTo(what, value, std::optional(blendReflectance(0.125f, 0.375f)));
    }
    void change(const std::string& what, Emission& value) {
        auto& [invisible, visible, sides] = value;
        change(what + ".invisible", invisible);
        change(what + ".visible", visible);
        change(what + ".sides", sides);
    }
    template <typename T>
    void change(const std::string& what, std::vector<T>& items) {
        for (std::size_t i = 0; i < items.size(); ++i)
            change(what + "[" + std::to_string(i) + "]", items[i]);
        resize(what, items);
    }
    template <typename T>
    void resize(const std::string& what, std::vector<T>& items) {
        std::vector<T> more = items;
        more.push_back(items.back());
        changeTo(what + " and one more", items, more);
        changeTo(what + ", none", items, {});
    }

    Scene scene_;
    std::map<std::string, std::string> hashes_;  // with what was changed
};

TEST_F(HashTest, IsSixteenHexDigitsAndRepeats) {
    const LoadedScene scene = loadObj(kTriangleObj);
    EXPECT_THAT(hashScene(scene), testing::MatchesRegex("[0-9a-f]+"));
    EXPECT_EQ(hashScene(scene).size(), 16u);
    EXPECT_EQ(hashScene(scene), hashScene(loadObj(kTriangleObj)));
}

TEST_F(HashTest, EverythingThatChangesTheImageChangesIt) {
    Scene scene = loadObj(std::string(kTriangleObj) + "vn 0 0 1\nf 1//1 2//1 3//1\n");
    scene.materials[0].reflectance = blendReflectance(0.5f, 0.75f);
    scene.pointEmitters = {{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}};
    Geometry& geometry = scene.geometry;
    geometry.colours.assign(geometry.positions.size(), glm::vec3(0.5f));
    geometry.alphas.assign(geometry.positions.size(), 0.5f);
    geometry.uvs = geometry.secondUvs = {{0.0f, 0.25f}};
    geometry.tangents = {{1.0f, 0.0f, 0.0f, 1.0f}};
    geometry.uvIndices.assign(geometry.triangles.size(), glm::uvec3(0));
    scene.images = {std::make_shared<Image>(Image{"i", 2, 1, std::vector<std::uint8_t>(8, 7), {}})};
    for (Material& material : scene.materials) {
        material.textures.resize(1);
        material.attenuationDistance = 2.0f;  // an infinite one cannot be changed by a little
    }
    forEachField(scene.geometry, [](const auto& field, const auto& items) {
        ASSERT_FALSE(items.empty()) << field.name << ": give it items here";
    });
    Perturbation perturbation(scene);
    perturbation.run();
    EXPECT_GT(perturbation.count(), 100u);
}

/// Checkpoints and reports hold hashes.
TEST(Hash, IsTheSameInEveryBuild) {
    Scene scene;
    scene.geometry.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.geometry.triangles = {{0, 1, 2}};
    scene.geometry.materials = {0};
    scene.materials.resize(1);
    EXPECT_EQ(hashScene(scene), "b11d3b81bccc0a66");
    scene.geometry.normals = {{0, 0, 1}};
    scene.geometry.normalIndices = {{0, 0, 0}};
    scene.geometry.colours.assign(3, glm::vec3(0.5f));
    scene.materials[0].reflectance = blendReflectance(0.5f, 0.25f);
    scene.camera.type = CameraType::kOrthographic;
    EXPECT_EQ(hashScene(scene), "e59265c2ffe2814a");
}

TEST_F(HashTest, NamesAndSettingsDoNotCount) {
    LoadedScene scene = loadObj(kTriangleObj);
    const std::string original = hashScene(scene);
    scene.materials[0].name = "other";
    scene.settings.spp = 7;
    scene.settings.seed = 9;
    scene.source = "elsewhere.obj";
    scene.warnings.clear();
    EXPECT_EQ(hashScene(scene), original);
}

}  // namespace
}  // namespace duolux::test
