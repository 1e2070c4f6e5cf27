#include "host/loaders/json_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/nearest_name.h"
#include "host/base/printable.h"

namespace duolux {

using nlohmann::json;

void JsonNode::fail(std::string_view problem, std::string_view remedy) const {
    throw InputError(file_->string(), path_, problem, remedy);
}

void JsonNode::failValue(std::string_view remedy) const {
    fail("is " + describe(), remedy);
}

std::string JsonNode::describe() const {
    if (value_->is_object()) return "an object";
    if (value_->is_array()) return fmt::format("an array of {}", value_->size());
    if (value_->is_string()) return inQuotes(value_->get_ref<const std::string&>());
    return value_->dump();
}

JsonNode JsonNode::member(std::string_view key, const json& value) const {
    return {value, *file_, path_ + (path_.empty() ? "" : ".") + shortened(key)};
}

void JsonNode::expectObject() const {
    if (!value_->is_object()) failValue("expected an object {...}");
}

void JsonNode::expectKeys(std::span<const std::string_view> keys) const {
    const std::vector<std::string> known(keys.begin(), keys.end());
    for (const auto& [key, node] : members()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            node.fail("unknown key", suggestName(key, known));
        }
    }
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
    expectObject();
    std::vector<std::pair<std::string, JsonNode>> members;
    for (const auto& [key, value] : value_->items())
        members.emplace_back(key, member(key, value));
    return members;
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
    expectObject();
    const auto found = value_->find(key);
    if (found == value_->end()) return std::nullopt;
    return member(key, *found);
}

JsonNode JsonNode::require(std::string_view key, std::string_view remedy) const {
    const std::optional<JsonNode> found = find(key);
    if (!found) throw InputError(file_->string(), path_, fmt::format("{} is missing", inQuotes(key)), remedy);
    return *found;
}

std::vector<JsonNode> JsonNode::elements(std::string_view remedy, std::optional<std::size_t> count) const {
    if (!value_->is_array() || (count && value_->size() != *count)) failValue(remedy);
    std::vector<JsonNode> elements;
    elements.reserve(value_->size());
    for (std::size_t i = 0; i < value_->size(); ++i) {
        elements.push_back({(*value_)[i], *file_, fmt::format("{}[{}]", path_, i)});
    }
    return elements;
}

bool JsonNode::isNumber() const {
    return value_->is_number();
}

bool JsonNode::isObject() const {
    return value_->is_object();
}

bool JsonNode::isArray() const {
    return value_->is_array();
}

double JsonNode::number(double low, double high, std::string_view remedy) const {
    if (!value_->is_number()) failValue(remedy);
    const double number = value_->get<double>();
    if (!(number >= low && number <= high)) failValue(remedy);
    return number;
}

std::uint32_t JsonNode::integer(std::uint32_t low, std::uint32_t high) const {
    const std::string remedy = low == high ? fmt::format("expected {}", low)
                                           : fmt::format("expected a whole number from {} to {}", low, high);
    if (!value_->is_number()) failValue(remedy);
    const double number = value_->get<double>();
    if (!(number >= low && number <= high) || number != std::floor(number)) failValue(remedy);
    return static_cast<std::uint32_t>(number);
}

bool JsonNode::boolean() const {
    if (!value_->is_boolean()) failValue("expected true or false");
    return value_->get<bool>();
}

const std::string& JsonNode::text(std::string_view remedy) const {
    if (!value_->is_string()) failValue(remedy);
    return value_->get_ref<const std::string&>();
}

std::size_t JsonNode::choice(std::span<const std::string> names) const {
    const std::string chosen = value_->is_string() ? value_->get<std::string>() : std::string();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == chosen && value_->is_string()) return i;
    }
    failValue(suggestName(chosen, names));
}

glm::dvec3 JsonNode::vector(double low, double high, std::string_view remedy) const {
    glm::dvec3 result;
    const std::vector<JsonNode> numbers = elements(remedy, 3);
    for (int i = 0; i < 3; ++i)
        result[i] = numbers[static_cast<std::size_t>(i)].number(low, high, remedy);
    return result;
}

glm::vec3 JsonNode::colour(double low, double high, std::string_view remedy) const {
    return isArray() ? glm::vec3(vector(low, high, remedy))
                     : glm::vec3(glm::dvec3(number(low, high, remedy)));
}

}  // namespace duolux
