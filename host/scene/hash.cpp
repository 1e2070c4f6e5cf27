#include "host/scene/hash.h"

#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace duolux {

namespace {

/// FNV-1a (Fowler, Noll, Vo) over words of 8 bytes, with a rotation so that high bits reach low ones, and the
/// finaliser of SplitMix64 (Steele, Lea, Flood 2014).
class Hasher {
  public:
    void add(std::uint64_t word) { state_ = std::rotl((state_ ^ word) * 0x00000100000001b3ull, 29); }

    void add(float value) { add(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value))); }

    void add(const glm::vec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }

    void add(const LightMatrix& matrix) {
        add(matrix.m00);
        add(matrix.m01);
        add(matrix.m10);
        add(matrix.m11);
    }

    void add(const Reflectance& reflectance) {
        add(reflectance.opaque);
        add(reflectance.transparent);
    }

    /// The bytes of an array, and its length.
    template <typename T>
    void addArray(const std::vector<T>& array) {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0 && alignof(T) == 4);
        add(static_cast<std::uint64_t>(array.size()));
        const char* at = reinterpret_cast<const char*>(array.data());
        std::size_t bytes = array.size() * sizeof(T);
        for (; bytes >= 8; bytes -= 8, at += 8) {
            std::uint64_t word;
            std::memcpy(&word, at, 8);
            add(word);
        }
        if (bytes > 0) {
            std::uint32_t half;
            std::memcpy(&half, at, 4);
            add(static_cast<std::uint64_t>(half));
        }
    }

    std::uint64_t result() const {
        std::uint64_t h = state_;
        h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ull;
        h = (h ^ (h >> 27)) * 0x94d049bb133111ebull;
        return h ^ (h >> 31);
    }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325ull;
};

}  // namespace

std::string hashScene(const Scene& scene) {
    Hasher hasher;
    const Geometry& geometry = scene.geometry;
    hasher.addArray(geometry.positions);
    hasher.addArray(geometry.triangles);
    hasher.addArray(geometry.materials);
    hasher.addArray(geometry.normals);
    hasher.addArray(geometry.normalIndices);
    for (const Material& material : scene.materials) {
        hasher.add(material.diffuse);
        hasher.add(static_cast<std::uint64_t>(material.sides));
        hasher.add(material.emission.invisible);
        hasher.add(material.emission.visible);
        hasher.add(static_cast<std::uint64_t>(material.emission.sides));
        hasher.add(scene.reflectanceOf(material));
    }
    if (scene.origin != glm::dvec3(0.0)) {
        for (int i = 0; i < 3; ++i)
            hasher.add(std::bit_cast<std::uint64_t>(scene.origin[i]));
    }
    hasher.add(scene.camera.position);
    hasher.add(scene.camera.target);
    hasher.add(scene.camera.up);
    if (scene.camera.type == CameraType::kOrthographic) {
        hasher.add(static_cast<std::uint64_t>(scene.camera.type));
        hasher.add(scene.camera.height);
    } else {
        hasher.add(scene.camera.vfov);
    }
    hasher.add(scene.display.x);
    hasher.add(scene.display.y);
    return fmt::format("{:016x}", hasher.result());
}

}  // namespace duolux
