#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <set>

#include "shaders/shared/bvh_layout.h"
#include "shaders/shared/path_tracer_layout.h"
#include "shaders/shared/texture_layout.h"
#include "tests/shader/layout_words.h"
#include "tests/shader/mirror_types.h"
#include "tests/shader/no_scene.h"

// Records in texels: the host writes a sentinel into every field, and the library's fetch functions must
// return it in the corresponding field. There are several records to test the stride.

namespace duolux::test {
namespace {

constexpr std::size_t kRecords = 4;

/// A name without the structures that contain it: "bsdf.baseColor.x" -> "baseColor.x".
std::string_view fieldOf(std::string_view word) {
    const bool component = word.size() > 2 && word[word.size() - 2] == '.';
    const std::size_t dot = word.substr(0, word.size() - (component ? 2 : 0)).rfind('.');
    return dot == std::string_view::npos ? word : word.substr(dot + 1);
}

/// What the words of a record hold, by their names, as the numbers that the device returns.
template <typename S>
class SentinelRecord {
  public:
    explicit SentinelRecord(std::size_t record) {
        for (std::size_t w = 0; w < words_.size(); ++w) {
            const std::uint32_t bits = sentinel(record, w);
            numbers_[words_[w].name] = words_[w].isFloat ? static_cast<double>(std::bit_cast<float>(bits))
                                                         : static_cast<double>(bits);
        }
    }

    std::vector<double> ofWords(const std::vector<std::string>& names) {
        std::vector<double> out;
        for (const std::string& name : names) {
            EXPECT_TRUE(numbers_.contains(name)) << name;
            out.push_back(numbers_[name]);
            fetched_.insert(name);
        }
        return out;
    }

    /// Those of the fields of a structure of the library, which have the names of those of the record.
    std::vector<double> ofStructure(std::string_view structure) {
        std::vector<std::string> names;
        for (const LayoutWord& word : layoutWords(structure))
            names.emplace_back(fieldOf(word.name));
        return ofWords(names);
    }

    /// Fails the test for a word that nothing fetched.
    void expectAllFetched() const {
        for (const auto& [name, number] : numbers_) {
            EXPECT_TRUE(fetched_.contains(name) || name.starts_with("unused")) << name;
        }
    }

  private:
    std::vector<LayoutWord> words_ = layoutWords<S>();
    std::map<std::string, double> numbers_;
    std::set<std::string> fetched_;
};

std::vector<std::uint32_t> recordIndices() {
    return {0, 1, 2, 3};
}

TEST(RecordLayout, MaterialsAreFetchedFieldByField) {
    using mirror::single::Material;
    using mirror::single::ReflectanceMatrix;
    const auto records = sentinels<shared::DeviceMaterial>(kRecords);
    ShaderLibrary library({"shaders/lib/material.glsl", "shaders/lib/material_textures.glsl"});
    library.define(
        "uvec4 fetchTextureTexel(uint index) { return uvec4(0u); }"
        "uvec4 fetchAtlasTexel(uint index) { return uvec4(0u); }");
    library.texels("fetchMaterialTexel", std::span(std::as_const(records)));
    const auto ranges = library.call<glm::uvec2>("fetchTextureRange", recordIndices());
    const auto normalScales = library.call<float>("fetchNormalScale", recordIndices());
    const auto coatScales = library.call<float>("fetchCoatNormalScale", recordIndices());
    const auto materials = library.call<Material>("fetchMaterial", recordIndices());
    const auto opaque = library.call<ReflectanceMatrix>("fetchOpaque", recordIndices());
    const auto transparent = library.call<ReflectanceMatrix>("fetchTransparent", recordIndices());
    for (std::size_t i = 0; i < kRecords; ++i) {
        SentinelRecord<shared::DeviceMaterial> record(i);
        EXPECT_EQ(numbers(materials[i]), record.ofStructure("Material"));
        // m00, m01, m10, m11 in xyz; w is padding.
        const auto matrix = [&](const char* field) {
            std::vector<std::string> names;
            for (int entry = 0; entry < 4; ++entry) {
                for (const char component : {'x', 'y', 'z'})
                    names.push_back(fmt::format("{}[{}].{}", field, entry, component));
                record.ofWords({fmt::format("{}[{}].w", field, entry)});
            }
            return record.ofWords(names);
        };
        EXPECT_EQ((std::vector<double>{static_cast<double>(ranges[i].x), static_cast<double>(ranges[i].y),
                                       static_cast<double>(normalScales[i])}),
                  record.ofWords({"firstTexture", "textureCount", "normalScale"}));
        EXPECT_EQ(static_cast<double>(coatScales[i]), record.ofWords({"clearcoatNormalScale"}).at(0));
        EXPECT_EQ(numbers(opaque[i]), matrix("opaque"));
        EXPECT_EQ(numbers(transparent[i]), matrix("transparent"));
        record.expectAllFetched();
    }
}

TEST(RecordLayout, TexturesAreFetchedFieldByField) {
    const auto records = sentinels<shared::DeviceTexture>(kRecords);
    ShaderLibrary library("shaders/lib/texture.glsl");
    library.define("uvec4 fetchAtlasTexel(uint index) { return uvec4(0u); }");
    library.texels("fetchTextureTexel", std::span(std::as_const(records)));
    const auto textures = library.call<mirror::single::Texture>("fetchTexture", recordIndices());
    for (std::size_t i = 0; i < kRecords; ++i) {
        SentinelRecord<shared::DeviceTexture> record(i);
        EXPECT_EQ(numbers(textures[i]), record.ofStructure("Texture"));
        record.expectAllFetched();
    }
}

/// Each word of a vertex by the record that the corner names.
TEST(RecordLayout, VerticesAreFetchedCornerByCorner) {
    const auto vertices = sentinels<shared::DeviceVertex>(3 * kRecords);
    std::vector<shared::DeviceCorners> corners;
    for (std::uint32_t i = 0; i < kRecords; ++i)
        corners.push_back({{3 * i + 2, 3 * i, 3 * i + 1}, 0xdeadbeefu});
    ShaderLibrary library("shaders/lib/vertex_records.glsl");
    library.define("uvec4 fetchSecondUvTexel(uint index) { return uvec4(0u); }");
    library.texels("fetchCornerTexel", std::span(std::as_const(corners)))
        .texels("fetchVertexTexel", std::span(std::as_const(vertices)));
    for (const auto& [field, vertex] :
         {std::pair{"first", 2}, std::pair{"second", 0}, std::pair{"third", 1}}) {
        const auto words = library.evaluate<glm::uvec4>(fmt::format("result = fetchVertices(x0).{};", field),
                                                        recordIndices());
        for (std::uint32_t i = 0; i < kRecords; ++i) {
            for (std::size_t w = 0; w < 4; ++w) {
                EXPECT_EQ(words[i][static_cast<int>(w)],
                          sentinel(3 * i + static_cast<std::size_t>(vertex), w))
                    << field << " " << i << " " << w;
            }
        }
    }
}

TEST(RecordLayout, EmittersAreFetchedFieldByField) {
    using mirror::single::AliasEntry;
    using mirror::single::Emitter;
    const auto records = sentinels<shared::DeviceEmitter>(kRecords);
    ShaderLibrary library("shaders/lib/emitter/emitter_types.glsl");
    library.define(
        "uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }"
        "uvec4 fetchPairTexel(uint index) { return uvec4(0u); }"
        "uvec4 fetchNormalTexel(uint index) { return uvec4(0u); }");
    library.define(kNoVertexRecords).define(kNoEmissionTextures);
    library.texels("fetchEmitterTexel", std::span(std::as_const(records)));
    const auto emitters = library.call<Emitter>("fetchEmitter", recordIndices());
    const auto entries = library.call<AliasEntry>("fetchAliasEntry", recordIndices());
    for (std::size_t i = 0; i < kRecords; ++i) {
        SentinelRecord<shared::DeviceEmitter> record(i);
        EXPECT_EQ(numbers(emitters[i]), record.ofStructure("Emitter"));
        EXPECT_EQ(numbers(entries[i]), record.ofStructure("AliasEntry"));
        record.expectAllFetched();
    }
}

TEST(RecordLayout, TrianglesAreFetchedFieldByField) {
    using mirror::single::Triangle;
    const auto records = sentinels<shared::DevicePair>(kRecords);
    ShaderLibrary library("shaders/lib/traverse.glsl");
    library.texels("fetchPairTexel", std::span(std::as_const(records)));
    library.define(
        "uvec4 fetchNodeTexel(uint index) { return uvec4(0u); }"
        "uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }");
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 2 * kRecords; ++i)
        indices.push_back(i);
    const auto triangles = library.call<Triangle>("fetchTriangle", indices);
    const auto first = library.evaluate<Triangle>("result = fetchPair(x0).first;", recordIndices());
    const auto second = library.evaluate<Triangle>("result = fetchPair(x0).second;", recordIndices());
    for (std::size_t i = 0; i < kRecords; ++i) {
        SentinelRecord<shared::DevicePair> record(i);
        const auto triangle = [&](const std::array<const char*, 3>& corners, const char* rank,
                                  const char* flags) {
            std::vector<std::string> names;
            for (const char* corner : corners) {
                for (const char component : {'x', 'y', 'z'})
                    names.push_back(fmt::format("{}.{}", corner, component));
            }
            names.insert(names.end(), {rank, flags});
            return record.ofWords(names);
        };
        const auto firstNumbers = triangle({"v0", "v1", "v2"}, "primitive0", "materialFlags0");
        const auto secondNumbers = triangle({"v3", "v2", "v1"}, "primitive1", "materialFlags1");
        record.expectAllFetched();
        EXPECT_EQ(numbers(triangles[2 * i]), firstNumbers);
        EXPECT_EQ(numbers(triangles[2 * i + 1]), secondNumbers);
        EXPECT_EQ(numbers(first[i]), firstNumbers);
        EXPECT_EQ(numbers(second[i]), secondNumbers);
    }
}

// Octahedral words of the six axes, by hand: vertex k of record i has axis i + k.
TEST(RecordLayout, NormalsAreFetchedVertexByVertex) {
    const std::array<std::uint32_t, 6> words{0x00007fffu, 0x7fff0000u, 0x00000000u,
                                             0x00008001u, 0x80010000u, 0x7fff7fffu};
    const std::array<glm::vec3, 6> axes{
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
    std::vector<shared::DeviceNormals> records;
    std::vector<std::uint32_t> triangles;
    std::vector<glm::vec2> barycentrics;
    std::vector<glm::vec3> expected;
    for (std::uint32_t i = 0; i < kRecords; ++i) {
        records.push_back({{words[i], words[i + 1], words[i + 2]}, 0x12345678u});
        for (std::uint32_t k = 0; k < 3; ++k) {
            triangles.push_back(i);
            barycentrics.emplace_back(k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f);
            expected.push_back(axes[i + k]);
        }
    }
    ShaderLibrary library("shaders/lib/normals.glsl");
    library.define(kNoVertexRecords);
    library.texels("fetchNormalTexel", std::span(std::as_const(records)));
    const auto normals = library.call<glm::vec3>("shadingNormal", triangles, barycentrics);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_LT(glm::length(normals[i] - expected[i]), 1e-6f) << i;
}

/// A node with distinct bytes: units of 1, 2 and 1/2, children separated along all axes. Even slots hold
/// nodes, odd slots hold leaves.
shared::WideNode probedNode() {
    shared::WideNode node{};
    const std::array<float, 3> origin{-100.0f, 20.0f, 3.0f};
    const std::array<std::uint8_t, 3> exponent{127, 128, 126};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.origin[axis] = origin[axis];
        node.exponent[axis] = exponent[axis];
        for (std::size_t slot = 0; slot < 8; ++slot) {
            // The order of the children differs between axes.
            const std::size_t place = (slot * (2 * axis + 1) + axis) % 8;
            node.lower[axis][slot] = static_cast<std::uint8_t>(5 + 31 * place + axis);
            node.upper[axis][slot] = static_cast<std::uint8_t>(5 + 31 * place + axis + 9 + slot);
        }
    }
    node.innerMask = 0x55;
    node.childBase = 0x00c0ffeeu;
    node.pairBase = 0x00abcdefu;
    for (std::uint32_t slot = 0; slot < 8; ++slot) {
        const std::uint32_t triangles = (1u << (1 + slot / 2 % 3)) - 1;  // unary, 1 to 3
        const std::uint32_t meta =
            slot % 2 == 0 ? shared::kMetaInner | (24 + slot) : triangles << 5 | 2 * slot;
        node.meta[slot] = static_cast<std::uint8_t>(meta);
    }
    return node;
}

/// A ray along an axis through the middle of a child, and the expected result of visiting the node.
struct NodeProbes {
    std::vector<glm::vec3> origin, direction;
    std::vector<float> tMin, tMax;
    std::vector<glm::uvec4> expected;  // groupBase, groupMask, pairBase, pairMask; 0: nothing hit
};

void probeChild(NodeProbes& probes, const shared::WideNode& node, std::uint32_t slot, int axis, float sign) {
    glm::vec3 unit, lower, upper;
    for (int a = 0; a < 3; ++a) {
        const auto k = static_cast<std::size_t>(a);
        unit[a] = std::ldexp(1.0f, node.exponent[k] - 127);
        lower[a] = node.origin[k] + unit[a] * static_cast<float>(node.lower[k][slot]);
        upper[a] = node.origin[k] + unit[a] * static_cast<float>(node.upper[k][slot]);
    }
    glm::vec3 direction(0.0f);
    direction[axis] = sign;
    glm::vec3 origin = 0.5f * (lower + upper);
    const float entry = sign > 0.0f ? lower[axis] : upper[axis];
    const float leave = sign > 0.0f ? upper[axis] : lower[axis];
    origin[axis] = node.origin[static_cast<std::size_t>(axis)] - sign * 1000.0f;
    const float near = std::abs(entry - origin[axis]), far = std::abs(leave - origin[axis]);
    const float step = 0.25f * unit[axis];  // a quarter of the unit
    const std::uint32_t octant = (axis == 0 && sign < 0.0f ? 0u : 4u) | (axis == 1 && sign < 0.0f ? 0u : 2u) |
                                 (axis == 2 && sign < 0.0f ? 0u : 1u);
    glm::uvec4 hit(0u, 0u, node.pairBase, (node.meta[slot] >> 5u) << (node.meta[slot] & 31u));
    if (slot % 2 == 0)
        hit = {node.childBase, 1u << (24 + (slot ^ octant)) | node.innerMask, node.pairBase, 0};
    const auto add = [&](float tMin, float tMax, bool hits) {
        probes.origin.push_back(origin);
        probes.direction.push_back(direction);
        probes.tMin.push_back(tMin);
        probes.tMax.push_back(tMax);
        probes.expected.push_back(hits ? hit : glm::uvec4(0u, 0u, node.pairBase, 0u));
    };
    // Intervals that just fail to reach the planes of the child's box, and intervals that just reach them.
    add(0.0f, near - step, false);
    add(0.0f, near + step, true);
    add(far + step, 1e30f, false);
    add(far - step, 1e30f, true);
}

TEST(RecordLayout, NodesAreVisitedByteByByte) {
    const std::vector<shared::WideNode> nodes{{}, {}, probedNode()};
    NodeProbes probes;
    for (std::uint32_t slot = 0; slot < 8; ++slot) {
        for (int axis = 0; axis < 3; ++axis) {
            probeChild(probes, nodes[2], slot, axis, 1.0f);
            probeChild(probes, nodes[2], slot, axis, -1.0f);
        }
    }
    ShaderLibrary library("shaders/lib/traverse.glsl");
    library.texels("fetchNodeTexel", std::span(nodes));
    library.define(
        "uvec4 fetchPairTexel(uint index) { return uvec4(0u); }"
        "uvec4 fetchPlaneTexel(uint index) { return uvec4(0u); }");
    // If no inner child is hit, there is no group, and its base is undefined.
    const auto seen = library.evaluate<glm::uvec4>(
        "Traversal r = traversalStart(2u, x0, x1, x2, 0u, x3, false); visitNode(r);"
        "bool group = r.groupMask > 0x00ffffffu;"
        "result = uvec4(group ? uvec2(r.groupBase, r.groupMask) : uvec2(0u), r.pairBase, "
        "r.pairMask);",
        probes.origin, probes.direction, probes.tMin, probes.tMax);
    for (std::size_t i = 0; i < seen.size(); ++i)
        EXPECT_EQ(seen[i], probes.expected[i])
            << "slot " << i / 24 << ", axis " << i / 8 % 3 << ", probe " << i % 8;
}

}  // namespace
}  // namespace duolux::test
