#pragma once

// glTF files for tests. The bytes are written one by one with shifts, not with the loader's own functions.
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/gltf.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {

/// The little-endian bytes of whole numbers.
inline std::string bytesOf(const std::vector<std::int64_t>& values, int size) {
    std::string bytes;
    for (const std::int64_t value : values) {
        for (int i = 0; i < size; ++i)
            bytes.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff));
    }
    return bytes;
}

inline std::string bytesOf(const std::vector<float>& values) {
    std::vector<std::int64_t> words;
    for (const float value : values)
        words.push_back(std::bit_cast<std::uint32_t>(value));
    return bytesOf(words, 4);
}

inline std::string base64Of(std::string_view bytes) {
    const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text.push_back(i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=');
    }
    return text;
}

/// A file in the making, whose only buffer is `binary`.
struct GltfFile {
    static constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                         kUnsignedInt = 5125, kFloat = 5126;

    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::string binary;

    /// These add an element to a list and return its index.
    std::size_t add(const char* list, nlohmann::json element) {
        json[list].push_back(std::move(element));
        return json[list].size() - 1;
    }
    std::size_t view(std::string_view bytes) {
        binary.resize((binary.size() + 3) / 4 * 4);
        const std::size_t offset = binary.size();
        binary += bytes;
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
    }
    std::size_t accessor(std::string_view bytes, int componentType, const char* type, std::size_t count) {
        return add("accessors", {{"bufferView", view(bytes)},
                                 {"componentType", componentType},
                                 {"type", type},
                                 {"count", count}});
    }
    std::size_t floats(const std::vector<float>& values, const char* type, std::size_t components) {
        return accessor(bytesOf(values), kFloat, type, values.size() / components);
    }
    std::size_t vec3(const std::vector<float>& values) { return floats(values, "VEC3", 3); }
    std::size_t vec2(const std::vector<float>& values) { return floats(values, "VEC2", 2); }
    std::size_t indices(const std::vector<std::int64_t>& values) {
        return accessor(bytesOf(values, 2), kUnsignedShort, "SCALAR", values.size());
    }

    /// Adds a mesh of one primitive and a node that has it. Returns the primitive.
    nlohmann::json& primitive(nlohmann::json attributes) {
        const std::size_t mesh = add("meshes", {{"primitives", {{{"attributes", std::move(attributes)}}}}});
        add("nodes", {{"mesh", mesh}});
        return json["meshes"][mesh]["primitives"][0];
    }

    /// The file as JSON with its buffer as a data URI, and as binary glTF.
    std::string text() const {
        nlohmann::json complete = json;
        complete["buffers"] = {{{"byteLength", binary.size()},
                                {"uri", "data:application/octet-stream;base64," + base64Of(binary)}}};
        return complete.dump();
    }
    std::string glb() const {
        nlohmann::json complete = json;
        complete["buffers"] = {{{"byteLength", binary.size()}}};
        std::string text = complete.dump(), data = binary;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        data.resize((data.size() + 3) / 4 * 4, '\0');
        const auto length = static_cast<std::int64_t>(28 + text.size() + data.size());
        return "glTF" + bytesOf({2, length, static_cast<std::int64_t>(text.size())}, 4) + "JSON" + text +
               bytesOf({static_cast<std::int64_t>(data.size())}, 4) + std::string("BIN\0", 4) + data;
    }
};

/// The triangle (0, 0, 0), (1, 0, 0), (0, 1, 0).
inline const std::vector<float> kCorners{0, 0, 0, 1, 0, 0, 0, 1, 0};

inline GltfFile triangleFile() {
    GltfFile file;
    file.primitive({{"POSITION", file.vec3(kCorners)}});
    return file;
}

class GltfTest : public SceneFiles {
  protected:
    Mesh mesh(const GltfFile& file, Reading reading = Reading::kLenient) const {
        MaterialFiles files(reading);
        return loadGltf(write("mesh.gltf", file.text()), files);
    }

    /// Without the folder.
    std::vector<std::string> warningsOf(const Mesh& read) const {
        std::vector<std::string> warnings;
        for (std::string warning : read.warnings) {
            const std::string prefix = folder_.string() + "/";
            for (std::size_t at = warning.find(prefix); at != std::string::npos; at = warning.find(prefix))
                warning.erase(at, prefix.size());
            warnings.push_back(std::move(warning));
        }
        return warnings;
    }

    std::string errorOfGltf(const std::string& text, Reading reading = Reading::kLenient) const {
        write("mesh.gltf", text);
        return errorOf("mesh.gltf", reading);
    }
    std::string errorOfGltf(const GltfFile& file, Reading reading = Reading::kLenient) const {
        return errorOfGltf(file.text(), reading);
    }
};

/// The corners of a triangle.
inline std::vector<glm::vec3> cornersOf(const Geometry& geometry, std::size_t triangle) {
    const glm::uvec3& corners = geometry.triangles[triangle];
    return {geometry.positions[corners.x], geometry.positions[corners.y], geometry.positions[corners.z]};
}

}  // namespace duolux::test
