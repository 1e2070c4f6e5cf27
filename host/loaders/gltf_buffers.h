#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/gltf_document.h"

namespace duolux {

/// The bytes of a glTF file's buffers and buffer views. Each is read, and decompressed, when it is first
/// needed, so that errors in what nothing refers to do not matter. Members throw InputError.
class GltfBuffers {
  public:
    explicit GltfBuffers(const GltfDocument& document) : document_(document) {}

    struct View {
        std::string_view bytes;
        std::optional<std::size_t> stride;  ///< bytes between elements; empty: elements follow each other
    };

    /// The buffer view that a node is the index of.
    View view(const JsonNode& index);

    /// All files that were read.
    const std::vector<std::filesystem::path>& files() const { return files_; }
    /// The sum of their sizes.
    std::uint64_t fileBytes() const { return fileBytes_; }

  private:
    View readView(const JsonNode& node);
    View decompress(const JsonNode& extension, std::uint32_t index);
    /// The bytes of a buffer from `byteOffset` of a node, `byteLength` many.
    std::string_view slice(const JsonNode& node);
    std::string_view buffer(const JsonNode& index);
    std::string_view readBuffer(const JsonNode& node, std::uint32_t index);

    const GltfDocument& document_;
    std::map<std::uint32_t, std::string_view> buffers_;
    std::map<std::uint32_t, View> views_;
    std::map<std::uint32_t, std::string> loaded_, decompressed_;  ///< what the views above refer to
    std::vector<std::filesystem::path> files_;
    std::uint64_t fileBytes_ = 0;
};

/// The size or the offset of something in bytes; 0 if there is no such member.
std::size_t readByteCount(const JsonNode& node, std::string_view key);

}  // namespace duolux
