#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/gltf_notes.h"
#include "host/loaders/json_node.h"

namespace duolux {

/// The JSON of a glTF file and, if it is binary, the chunk with the data. All members throw InputError.
class GltfDocument {
  public:
    /// Reads the file and checks its version and the extensions that it requires.
    GltfDocument(const std::filesystem::path& path, GltfNotes& notes);
    GltfDocument(const GltfDocument&) = delete;
    GltfDocument& operator=(const GltfDocument&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t size() const { return bytes_.size(); }
    const JsonNode& root() const { return root_; }

    /// The data chunk of a binary file.
    std::optional<std::string_view> binary() const { return binary_; }

    /// The elements of an array of the root; none if there is no such array.
    const std::vector<JsonNode>& list(const std::string& key) const;

    /// The value of a node that is an index into a list of the root.
    std::uint32_t index(const JsonNode& node, const std::string& key) const;

    /// The element of a list of the root that a node is the index of.
    const JsonNode& element(const JsonNode& node, const std::string& key) const {
        return list(key)[index(node, key)];
    }

  private:
    nlohmann::json parse();
    std::string_view splitChunks();
    void checkVersion() const;
    void checkExtensions(GltfNotes& notes) const;

    std::filesystem::path path_;
    std::string bytes_;
    std::optional<std::string_view> binary_;
    nlohmann::json json_;
    JsonNode root_;
    mutable std::map<std::string, std::vector<JsonNode>> lists_;
};

/// The extension of a node; empty if it does not have it.
std::optional<JsonNode> extensionOf(const JsonNode& node, std::string_view name);

/// `count` numbers, each in [low, high].
std::vector<double> readNumbers(const JsonNode& node, std::size_t count, double low, double high,
                                std::string_view remedy);

}  // namespace duolux
