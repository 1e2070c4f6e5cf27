#include "host/loaders/gltf_buffers.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "host/base/file.h"
#include "host/base/printable.h"
#include "host/loaders/gltf_meshopt.h"
#include "host/loaders/gltf_uri.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kLargestStride = 252;

}  // namespace

std::size_t readByteCount(const JsonNode& node, std::string_view key) {
    const auto value = node.find(key);
    if (!value) return 0;
    const char* const remedy = "expected a number of bytes";
    const double bytes = value->number(0.0, 0x1p53, remedy);
    if (bytes != std::floor(bytes)) value->failValue(remedy);
    return static_cast<std::size_t>(bytes);
}

GltfBuffers::View GltfBuffers::view(const JsonNode& node) {
    const std::uint32_t index = document_.index(node, "bufferViews");
    const auto found = views_.find(index);
    if (found != views_.end()) return found->second;
    const JsonNode& described = document_.list("bufferViews")[index];
    const auto compressed = extensionOf(described, "EXT_meshopt_compression");
    const View view = compressed ? decompress(*compressed, index) : readView(described);
    views_.emplace(index, view);
    return view;
}

GltfBuffers::View GltfBuffers::readView(const JsonNode& node) {
    View view{slice(node), std::nullopt};
    if (const auto stride = node.find("byteStride")) view.stride = stride->integer(1, kLargestStride);
    return view;
}

GltfBuffers::View GltfBuffers::decompress(const JsonNode& extension, std::uint32_t index) {
    const MeshoptView view = readMeshoptView(extension);
    std::string& bytes = decompressed_[index];
    bytes = decodeMeshopt(extension, view, slice(extension));
    return {bytes, view.stride};
}

std::string_view GltfBuffers::slice(const JsonNode& node) {
    const std::string_view bytes = buffer(node.require("buffer", "expected the index of a buffer"));
    const std::size_t offset = readByteCount(node, "byteOffset"), length = readByteCount(node, "byteLength");
    if (offset > bytes.size() || length > bytes.size() - offset) {
        node.fail(
            fmt::format("takes {} bytes from byte {} of a buffer of {} bytes", length, offset, bytes.size()),
            "expected a part of the buffer");
    }
    return bytes.substr(offset, length);
}

std::string_view GltfBuffers::buffer(const JsonNode& node) {
    const std::uint32_t index = document_.index(node, "buffers");
    const auto found = buffers_.find(index);
    if (found != buffers_.end()) return found->second;
    const JsonNode& described = document_.list("buffers")[index];
    const std::string_view bytes = readBuffer(described, index);
    const std::size_t length = readByteCount(described, "byteLength");
    if (length > bytes.size()) {
        described.fail(fmt::format("has {} bytes", bytes.size()),
                       fmt::format("expected {}, its byteLength", length));
    }
    return buffers_[index] = bytes.substr(0, length);
}

std::string_view GltfBuffers::readBuffer(const JsonNode& node, std::uint32_t index) {
    const auto uri = node.find("uri");
    if (!uri) {
        if (index == 0 && document_.binary()) return *document_.binary();
        node.fail("has no data", "expected \"uri\", or a binary glTF file");
    }
    std::string& bytes = loaded_[index];
    if (isDataUri(uri->text("expected a URI"))) return bytes = decodeDataUri(*uri);
    const fs::path path = pathOfUri(*uri);
    std::error_code ec;
    if (!fs::is_regular_file(path, ec)) {
        uri->fail(fmt::format("no file {}", shortened(path.string(), kLongestMessage / 4)),
                  "expected the path of a file, relative to the glTF file");
    }
    bytes = readFile(path);
    files_.push_back(path);
    fileBytes_ += bytes.size();
    return bytes;
}

}  // namespace duolux
