#include "host/loaders/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/printable.h"
#include "host/loaders/json_text.h"

namespace duolux {

namespace {

constexpr std::string_view kMagic = "glTF";
constexpr const char* kVersionRemedy = "expected \"2.0\"";

/// Extensions that are read, or that do not affect pictures of the default state.
constexpr std::array<std::string_view, 21> kUnderstood{"EXT_mesh_gpu_instancing",
                                                       "EXT_meshopt_compression",
                                                       "FB_ngon_encoding",
                                                       "KHR_animation_pointer",
                                                       "KHR_draco_mesh_compression",
                                                       "KHR_lights_punctual",
                                                       "KHR_materials_anisotropy",
                                                       "KHR_materials_clearcoat",
                                                       "KHR_materials_emissive_strength",
                                                       "KHR_materials_ior",
                                                       "KHR_materials_pbrSpecularGlossiness",
                                                       "KHR_materials_sheen",
                                                       "KHR_materials_specular",
                                                       "KHR_materials_transmission",
                                                       "KHR_materials_unlit",
                                                       "KHR_materials_variants",
                                                       "KHR_materials_volume",
                                                       "KHR_mesh_quantization",
                                                       "KHR_texture_transform",
                                                       "KHR_xmp",
                                                       "KHR_xmp_json_ld"};

bool isUnderstood(std::string_view extension) {
    return std::find(kUnderstood.begin(), kUnderstood.end(), extension) != kUnderstood.end();
}

/// A little-endian number.
std::uint32_t wordAt(std::string_view bytes, std::size_t offset) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i])) << (8 * i);
    return word;
}

}  // namespace

GltfDocument::GltfDocument(const std::filesystem::path& path, GltfNotes& notes)
    : path_(path), bytes_(readFile(path)), json_(parse()), root_(json_, path_) {
    checkVersion();
    checkExtensions(notes);
}

nlohmann::json GltfDocument::parse() {
    if (!bytes_.starts_with(kMagic)) return parseJson(path_, bytes_, "glTF JSON or binary glTF");
    return parseJson(path_, splitChunks(), "glTF JSON");
}

/// Finds the chunks of a binary file and returns the JSON.
std::string_view GltfDocument::splitChunks() {
    constexpr std::size_t kHeader = 12, kChunkHeader = 8;
    constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
    const auto fail = [&](std::size_t offset, std::string_view problem, std::string_view remedy) {
        throw InputError(path_.string(), fmt::format("byte {}", offset), problem, remedy);
    };
    if (bytes_.size() < kHeader + kChunkHeader) {
        fail(bytes_.size(), "the file ends here", "expected the header of a binary glTF file");
    }
    if (const std::uint32_t version = wordAt(bytes_, 4); version != 2) {
        fail(4, fmt::format("is version {} of binary glTF", version), "expected version 2");
    }
    const std::uint32_t length = wordAt(bytes_, 8);
    if (length > bytes_.size()) {
        fail(bytes_.size(), "the file ends here", fmt::format("expected {} bytes", length));
    }
    const std::string_view bytes = std::string_view(bytes_).substr(0, length);
    std::optional<std::string_view> text;
    for (std::size_t at = kHeader; at + kChunkHeader <= bytes.size();) {
        const std::size_t size = wordAt(bytes, at), left = bytes.size() - at - kChunkHeader;
        if (size > left) {
            fail(at, fmt::format("the length of a chunk is {}", size),
                 fmt::format("expected at most {}", left));
        }
        const std::uint32_t kind = wordAt(bytes, at + 4);
        const std::string_view chunk = bytes.substr(at + kChunkHeader, size);
        if (at == kHeader && kind != kJson)
            fail(at, "the first chunk is not JSON", "expected the JSON chunk");
        if (at == kHeader) text = chunk;
        if (kind == kBinary && !binary_) binary_ = chunk;
        at += kChunkHeader + size;
    }
    if (!text) fail(kHeader, "has no chunk", "expected the JSON chunk");
    while (text->ends_with('\0'))
        text->remove_suffix(1);
    return *text;
}

void GltfDocument::checkVersion() const {
    const JsonNode asset = root_.require("asset", "expected {\"version\": \"2.0\"}");
    const JsonNode version = asset.require("version", kVersionRemedy);
    if (!version.text(kVersionRemedy).starts_with("2.")) version.failValue(kVersionRemedy);
    if (const auto least = asset.find("minVersion"); least && least->text(kVersionRemedy) != "2.0")
        least->failValue(kVersionRemedy);
}

void GltfDocument::checkExtensions(GltfNotes& notes) const {
    const char* const remedy = "expected the name of an extension";
    std::vector<std::string> required;
    for (const JsonNode& name : list("extensionsRequired")) {
        if (!isUnderstood(name.text(remedy))) {
            name.fail(fmt::format("the extension {} is not supported", inQuotes(name.text(remedy))),
                      "expected a file that does not require it");
        }
    }
    for (const JsonNode& name : list("extensionsUsed")) {
        const std::string& extension = name.text(remedy);
        if (isUnderstood(extension)) continue;
        notes.ignore(name, fmt::format("the extension {} is not supported", inQuotes(extension)), "ignored");
    }
}

const std::vector<JsonNode>& GltfDocument::list(const std::string& key) const {
    const auto [entry, isNew] = lists_.try_emplace(key);
    if (isNew) {
        if (const auto array = root_.find(key)) entry->second = array->elements("expected an array");
    }
    return entry->second;
}

std::uint32_t GltfDocument::index(const JsonNode& node, const std::string& key) const {
    const std::size_t count = list(key).size();
    if (count == 0)
        node.fail(fmt::format("refers to {}, of which there are none", key), "expected no reference");
    constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
    return node.integer(0, static_cast<std::uint32_t>(std::min(count, kMost) - 1));
}

std::optional<JsonNode> extensionOf(const JsonNode& node, std::string_view name) {
    const auto extensions = node.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

std::vector<double> readNumbers(const JsonNode& node, std::size_t count, double low, double high,
                                std::string_view remedy) {
    std::vector<double> numbers;
    numbers.reserve(count);
    for (const JsonNode& element : node.elements(remedy, count))
        numbers.push_back(element.number(low, high, remedy));
    return numbers;
}

}  // namespace duolux
