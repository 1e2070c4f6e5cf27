#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/gltf_buffers.h"
#include "host/loaders/gltf_document.h"

namespace duolux {

/// The elements of an accessor, read from where they are in a buffer.
class GltfAccessor {
  public:
    /// `index`: a node that holds the index of an accessor. `types` names the allowed types: "VEC3 or VEC4".
    /// Throws InputError.
    GltfAccessor(const GltfDocument& document, GltfBuffers& buffers, const JsonNode& index,
                 std::string_view types);

    /// The elements are numbers that are already decoded, `components` per element.
    GltfAccessor(const JsonNode& node, std::vector<float> values, std::uint32_t components);

    /// For messages.
    const JsonNode& node() const { return node_; }
    std::size_t count() const { return count_; }
    std::uint32_t components() const { return components_; }
    bool isFloat() const;

    /// Integers are fractions of the largest one (glTF 2.0, section 3.6.2.2).
    void setNormalised() { normalised_ = true; }

    /// A number of an element. `element` < count(), `component` < components().
    float number(std::size_t element, std::uint32_t component) const;
    std::uint32_t whole(std::size_t element, std::uint32_t component) const;

    glm::vec2 vec2(std::size_t element) const { return {number(element, 0), number(element, 1)}; }
    glm::vec3 vec3(std::size_t element) const {
        return {number(element, 0), number(element, 1), number(element, 2)};
    }
    glm::vec4 vec4(std::size_t element) const {
        return {number(element, 0), number(element, 1), number(element, 2), number(element, 3)};
    }
    glm::dmat4 mat4(std::size_t element) const;

  private:
    /// Where elements are in a buffer view.
    struct Place {
        std::string_view bytes;  ///< from the first element on
        std::size_t stride = 0;
    };

    void readSparse(GltfBuffers& buffers, const JsonNode& sparse);
    Place place(const JsonNode& node, GltfBuffers& buffers, std::size_t count, std::size_t elementSize) const;
    const char* at(std::size_t element, std::uint32_t component) const;

    JsonNode node_;
    Place place_;
    std::uint32_t componentType_, components_;
    std::size_t count_ = 0;
    bool normalised_ = false;
    std::vector<std::uint32_t> sparseIndices_;  ///< ascending: the elements that are in sparseValues_
    std::vector<std::uint32_t> sparseOrder_;    ///< where each of them is there
    Place sparseValues_;
    std::shared_ptr<const std::vector<float>> decoded_;
};

}  // namespace duolux
