#include "host/loaders/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

namespace duolux {

namespace {

constexpr std::uint32_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                        kUnsignedInt = 5125, kFloat = 5126;

/// 0 for what is not a component type.
std::size_t sizeOfComponent(std::uint32_t type) {
    switch (type) {
        case kByte:
        case kUnsignedByte:
            return 1;
        case kShort:
        case kUnsignedShort:
            return 2;
        case kUnsignedInt:
        case kFloat:
            return 4;
        default:
            return 0;
    }
}

std::uint32_t readComponentType(const JsonNode& accessor) {
    const char* const remedy =
        "expected 5120, 5121, 5122, 5123, 5125 or 5126 (signed and unsigned 8 and 16 bits, unsigned 32 bits, "
        "float)";
    const JsonNode node = accessor.require("componentType", remedy);
    const double type = node.number(0.0, 1e9, remedy);
    if (type < kByte || type > kFloat || sizeOfComponent(static_cast<std::uint32_t>(type)) == 0)
        node.failValue(remedy);
    return static_cast<std::uint32_t>(type);
}

/// The number of components of a type that is among `allowed`.
std::uint32_t readComponents(const JsonNode& accessor, std::string_view allowed) {
    constexpr std::array<std::pair<std::string_view, std::uint32_t>, 5> kTypes{
        {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};
    const std::string remedy = fmt::format("expected {}", allowed);
    const JsonNode node = accessor.require("type", remedy);
    const std::string& name = node.text(remedy);
    for (const auto& [type, components] : kTypes) {
        if (name == type && allowed.find(type) != std::string_view::npos) return components;
    }
    node.failValue(remedy);
}

template <typename T>
T load(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

template <typename T>
float loadInteger(const char* bytes, bool normalised) {
    const auto value = static_cast<double>(load<T>(bytes));
    if (!normalised) return static_cast<float>(value);
    return static_cast<float>(std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0));
}

constexpr const char* kCountRemedy = "expected the number of elements";

}  // namespace

GltfAccessor::GltfAccessor(const GltfDocument& document, GltfBuffers& buffers, const JsonNode& index,
                           std::string_view types)
    : node_(document.element(index, "accessors")),
      componentType_(readComponentType(node_)),
      components_(readComponents(node_, types)) {
    constexpr std::uint32_t kMost = std::numeric_limits<std::int32_t>::max(), kMostZeros = 1u << 24;
    const bool hasView = node_.find("bufferView").has_value();
    count_ = node_.require("count", kCountRemedy).integer(0, hasView ? kMost : kMostZeros);
    if (const auto normalised = node_.find("normalized")) normalised_ = normalised->boolean();
    const std::size_t size = components_ * sizeOfComponent(componentType_);
    if (hasView) {
        place_ = place(node_, buffers, count_, size);
    } else {
        static constexpr std::array<char, 64> kZeros{};
        place_ = {std::string_view(kZeros.data(), kZeros.size()), 0};
    }
    if (const auto sparse = node_.find("sparse")) readSparse(buffers, *sparse);
}

GltfAccessor::GltfAccessor(const JsonNode& node, std::vector<float> values, std::uint32_t components)
    : node_(node), componentType_(kFloat), components_(components), count_(values.size() / components) {
    decoded_ = std::make_shared<const std::vector<float>>(std::move(values));
    place_ = {
        std::string_view(reinterpret_cast<const char*>(decoded_->data()), decoded_->size() * sizeof(float)),
        components * sizeof(float)};
}

GltfAccessor::Place GltfAccessor::place(const JsonNode& node, GltfBuffers& buffers, std::size_t count,
                                        std::size_t elementSize) const {
    const JsonNode viewIndex = node.require("bufferView", "expected the index of a buffer view");
    const auto [bytes, viewStride] = buffers.view(viewIndex);
    const std::size_t stride = viewStride.value_or(elementSize), offset = readByteCount(node, "byteOffset");
    if (stride < elementSize && count > 1) {
        viewIndex.fail(fmt::format("the buffer view has a stride of {} bytes", stride),
                       fmt::format("expected at least {}, the size of an element", elementSize));
    }
    if (count == 0) return {{}, stride};
    if (offset > bytes.size() || (count - 1) * stride + elementSize > bytes.size() - offset) {
        node.fail(fmt::format("{} elements from byte {} on do not fit into a buffer view of {} bytes", count,
                              offset, bytes.size()),
                  fmt::format("expected at least {} bytes", offset + (count - 1) * stride + elementSize));
    }
    return {bytes.substr(offset), stride};
}

void GltfAccessor::readSparse(GltfBuffers& buffers, const JsonNode& sparse) {
    const JsonNode indices = sparse.require("indices", "expected an object");
    const JsonNode values = sparse.require("values", "expected an object");
    const std::size_t count =
        sparse.require("count", kCountRemedy).integer(0, static_cast<std::uint32_t>(count_));
    GltfAccessor reader(*this);
    reader.node_ = indices;
    reader.components_ = 1;
    reader.normalised_ = false;
    reader.componentType_ = readComponentType(indices);
    if (reader.componentType_ != kUnsignedByte && reader.componentType_ != kUnsignedShort &&
        reader.componentType_ != kUnsignedInt)
        indices.find("componentType")->failValue("expected 5121, 5123 or 5125 (unsigned integers)");
    reader.place_ = place(indices, buffers, count, sizeOfComponent(reader.componentType_));
    sparseValues_ = place(values, buffers, count, components_ * sizeOfComponent(componentType_));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(count);
    for (std::size_t i = 0; i < count; ++i) {
        pairs[i] = {reader.whole(i, 0), static_cast<std::uint32_t>(i)};
        if (pairs[i].first >= count_) {
            indices.fail(fmt::format("element {} is {}", i, pairs[i].first),
                         fmt::format("expected indices below {}", count_));
        }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [index, order] : pairs) {
        sparseIndices_.push_back(index);
        sparseOrder_.push_back(order);
    }
}

bool GltfAccessor::isFloat() const {
    return componentType_ == kFloat;
}

const char* GltfAccessor::at(std::size_t element, std::uint32_t component) const {
    const std::size_t inElement = component * sizeOfComponent(componentType_);
    if (!sparseIndices_.empty()) {
        const auto found = std::lower_bound(sparseIndices_.begin(), sparseIndices_.end(), element);
        if (found != sparseIndices_.end() && *found == element) {
            const std::size_t order = sparseOrder_[static_cast<std::size_t>(found - sparseIndices_.begin())];
            return sparseValues_.bytes.data() + order * sparseValues_.stride + inElement;
        }
    }
    return place_.bytes.data() + element * place_.stride + inElement;
}

float GltfAccessor::number(std::size_t element, std::uint32_t component) const {
    const char* const bytes = at(element, component);
    switch (componentType_) {
        case kByte:
            return loadInteger<std::int8_t>(bytes, normalised_);
        case kUnsignedByte:
            return loadInteger<std::uint8_t>(bytes, normalised_);
        case kShort:
            return loadInteger<std::int16_t>(bytes, normalised_);
        case kUnsignedShort:
            return loadInteger<std::uint16_t>(bytes, normalised_);
        case kUnsignedInt:
            return loadInteger<std::uint32_t>(bytes, normalised_);
        default:
            return load<float>(bytes);
    }
}

std::uint32_t GltfAccessor::whole(std::size_t element, std::uint32_t component) const {
    const char* const bytes = at(element, component);
    switch (componentType_) {
        case kUnsignedByte:
            return load<std::uint8_t>(bytes);
        case kUnsignedShort:
            return load<std::uint16_t>(bytes);
        case kUnsignedInt:
            return load<std::uint32_t>(bytes);
        default: {
            // A reader that needs an index refuses the largest one.
            const float value = number(element, component);
            return value >= 0.0f && value < 0x1p31f ? static_cast<std::uint32_t>(value)
                                                    : std::numeric_limits<std::uint32_t>::max();
        }
    }
}

glm::dmat4 GltfAccessor::mat4(std::size_t element) const {
    glm::dmat4 matrix;
    for (std::uint32_t i = 0; i < 16; ++i)
        matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = static_cast<double>(number(element, i));
    return matrix;
}

}  // namespace duolux
