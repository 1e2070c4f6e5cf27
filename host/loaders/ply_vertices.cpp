#include "host/loaders/ply_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "host/base/error.h"
#include "host/base/srgb.h"

namespace duolux {

namespace {

template <std::size_t kCount>
using PropertyNames = std::array<std::string_view, kCount>;

constexpr std::array<PropertyNames<3>, 3> kColourNames{
    {{"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}}};
constexpr std::array<PropertyNames<2>, 4> kUvNames{
    {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}};

class PlyVertexReader {
  public:
    PlyVertexReader(const PlyElement& element, PlyBody& body, bool strict, PlyOddities& oddities)
        : element_(element), body_(body), strict_(strict), oddities_(oddities) {}

    PlyVertices run() {
        slots_.assign(element_.properties.size(), kSkipped);
        if (!assign(find<3>({"x", "y", "z"}), kPosition)) {
            throw InputError(body_.file(), "element vertex", "has no coordinates",
                             "expected the properties x, y and z, which are no lists");
        }
        const bool hasNormal = assign(find<3>({"nx", "ny", "nz"}), kNormal);
        const bool hasColour = assign(firstOf(kColourNames), kColour);
        const bool hasAlpha = hasColour && assign(find<1>({"alpha"}), kAlpha);
        const bool hasUv = assign(firstOf(kUvNames), kUv);
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            if (slots_[i] == kSkipped) oddities_.noteUnused(element_, element_.properties[i]);
        }

        vertices_.positions.reserve(element_.count);
        if (hasNormal) vertices_.normals.reserve(element_.count);
        if (hasColour) vertices_.colours.reserve(element_.count);
        for (std::uint64_t vertex = 0; vertex < element_.count; ++vertex) {
            readValues();
            vertices_.positions.emplace_back(values_[kPosition], values_[kPosition + 1],
                                             values_[kPosition + 2]);
            if (hasNormal) addNormal({values_[kNormal], values_[kNormal + 1], values_[kNormal + 2]});
            if (hasColour) addColour({values_[kColour], values_[kColour + 1], values_[kColour + 2]});
            if (hasAlpha) addAlpha(values_[kAlpha]);
            if (hasUv) addUv(values_[kUv], values_[kUv + 1]);
        }
        return std::move(vertices_);
    }

  private:
    template <std::size_t kCount>
    using Indices = std::optional<std::array<std::size_t, kCount>>;

    /// The indices of properties; empty unless all are there and none is a list.
    template <std::size_t kCount>
    Indices<kCount> find(const PropertyNames<kCount>& names) const {
        std::array<std::size_t, kCount> found{};
        for (std::size_t i = 0; i < kCount; ++i) {
            const auto index = element_.find(names[i]);
            if (!index || element_.properties[*index].isList()) return std::nullopt;
            found[i] = *index;
        }
        return found;
    }

    template <std::size_t kCount, std::size_t kChoices>
    Indices<kCount> firstOf(const std::array<PropertyNames<kCount>, kChoices>& choices) const {
        for (const auto& names : choices) {
            if (const auto found = find<kCount>(names)) return found;
        }
        return std::nullopt;
    }

    template <std::size_t kCount>
    bool assign(const Indices<kCount>& indices, std::size_t first) {
        if (!indices) return false;
        for (std::size_t i = 0; i < kCount; ++i)
            slots_[(*indices)[i]] = first + i;
        return true;
    }

    void readValues() {
        body_.beginItem();
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            const PlyProperty& property = element_.properties[i];
            const std::size_t slot = slots_[i];
            if (slot == kSkipped) {
                body_.skip(property);
                continue;
            }
            const bool isColour = slot >= kColour && slot <= kAlpha;
            values_[slot] = body_.value(property.type) / (isColour ? unitOf(property.type) : 1.0);
        }
        body_.endItem();
    }

    void addNormal(const glm::dvec3& normal) {
        const double length = glm::length(normal);
        const bool isGood = length > 0.0 && std::isfinite(length);
        if (!isGood) tolerate(PlyOddity::kNormal, "the normal is 0 or not finite", "expected a direction");
        vertices_.normals.push_back(isGood ? glm::vec3(normal / length) : glm::vec3(0.0f));
    }

    /// `colour`: encoded by the transfer function of sRGB.
    void addColour(const glm::dvec3& colour) {
        glm::vec3 linear;
        bool isGood = true;
        for (int i = 0; i < 3; ++i) {
            isGood = isGood && colour[i] >= 0.0 && colour[i] <= 1.0;
            // Also 0 for what is not a number.
            linear[i] = colour[i] > 0.0 ? static_cast<float>(srgbDecode(std::min(colour[i], 1.0))) : 0.0f;
        }
        if (!isGood) tolerate(PlyOddity::kColour, "a colour is not between 0 and 1", "expected 0 to 1");
        vertices_.colours.push_back(linear);
    }

    void addAlpha(double alpha) {
        if (!(alpha >= 0.0 && alpha <= 1.0))
            tolerate(PlyOddity::kColour, "the alpha is not between 0 and 1", "expected 0 to 1");
        vertices_.alphas.push_back(alpha > 0.0 ? static_cast<float>(std::min(alpha, 1.0)) : 0.0f);
    }

    void addUv(double u, double v) {
        const glm::vec2 uv = uvFromBelow(u, v);
        if (uv == kBadUv) {
            tolerate(PlyOddity::kUv, "a texture coordinate is not finite or too large",
                     "expected at most 1e+06 in magnitude");
        }
        vertices_.uvs.push_back(uv);
    }

    /// Counts an error in the current item, or throws it in strict reading.
    void tolerate(PlyOddity oddity, std::string_view problem, std::string_view remedy) {
        if (strict_) throw body_.error(problem, remedy);
        oddities_.count(oddity, [&] { return body_.place(); });
    }

    // Places of values in values_.
    static constexpr std::size_t kPosition = 0, kNormal = 3, kColour = 6, kAlpha = 9, kUv = 10, kSlots = 12,
                                 kSkipped = kSlots;

    const PlyElement& element_;
    PlyBody& body_;
    const bool strict_;
    PlyOddities& oddities_;
    std::vector<std::size_t> slots_;       ///< of each property
    std::array<double, kSlots> values_{};  ///< of the current vertex
    PlyVertices vertices_;
};

}  // namespace

PlyVertices readPlyVertices(const PlyElement& element, PlyBody& body, bool strict, PlyOddities& oddities) {
    return PlyVertexReader(element, body, strict, oddities).run();
}

}  // namespace duolux
