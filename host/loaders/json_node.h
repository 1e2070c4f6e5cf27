#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/named.h"

namespace duolux {

/// A value of a JSON document with its location, so that every error names the file, the path, the value and
/// what would be right. All non-trivial members throw InputError.
class JsonNode {
  public:
    /// `value` and `file` must outlive the node.
    JsonNode(const nlohmann::json& value, const std::filesystem::path& file) : JsonNode(value, file, "") {}

    const std::string& path() const { return path_; }
    const std::filesystem::path& file() const { return *file_; }

    /// Requires an object whose keys are all among these.
    void expectKeys(std::span<const std::string_view> keys) const;
    void expectKeys(std::initializer_list<std::string_view> keys) const {
        expectKeys(std::span(keys.begin(), keys.size()));
    }
    /// The members of an object, in the order of their names.
    std::vector<std::pair<std::string, JsonNode>> members() const;
    std::optional<JsonNode> find(std::string_view key) const;
    /// `remedy` is for the error if there is no such member.
    JsonNode require(std::string_view key, std::string_view remedy) const;

    /// The elements of an array; exactly `count` if given.
    std::vector<JsonNode> elements(std::string_view remedy,
                                   std::optional<std::size_t> count = std::nullopt) const;

    bool isArray() const;
    bool isObject() const;
    bool isNumber() const;
    /// A finite number in [low, high].
    double number(double low, double high, std::string_view remedy) const;
    /// A whole number in [low, high].
    std::uint32_t integer(std::uint32_t low, std::uint32_t high) const;
    /// true or false.
    bool boolean() const;
    const std::string& text(std::string_view remedy) const;
    /// The index of the value in a list of names.
    std::size_t choice(std::span<const std::string> names) const;
    /// The value of an enumeration that the value names.
    template <typename E>
    E choice() const {
        return kValuesOf<E>[choice(namesOfAll<E>())];
    }
    /// Three numbers in [low, high].
    glm::dvec3 vector(double low, double high, std::string_view remedy) const;
    /// Three numbers in [low, high], or one for all channels.
    glm::vec3 colour(double low, double high, std::string_view remedy) const;

    [[noreturn]] void fail(std::string_view problem, std::string_view remedy) const;
    /// "is VALUE; REMEDY".
    [[noreturn]] void failValue(std::string_view remedy) const;

  private:
    JsonNode(const nlohmann::json& value, const std::filesystem::path& file, std::string path)
        : value_(&value), file_(&file), path_(std::move(path)) {}

    void expectObject() const;
    JsonNode member(std::string_view key, const nlohmann::json& value) const;
    /// A short description of the value.
    std::string describe() const;

    const nlohmann::json* value_;
    const std::filesystem::path* file_;
    std::string path_;
};

}  // namespace duolux
