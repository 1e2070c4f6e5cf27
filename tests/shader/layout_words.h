#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "shaders/shared/bvh_layout.h"
#include "shaders/shared/light_layout.h"
#include "shaders/shared/path_layout.h"
#include "shaders/shared/trace_layout.h"

// The structures of shaders/shared as lists of their 4-byte words. Sentinels in these words test whether host
// and device agree on the offset of each field.

namespace duolux::test {

/// A word of a structure: its name in GLSL, its type and its offset.
struct LayoutWord {
    std::string name;
    bool isFloat;
    std::size_t offset;
};

/// Collects the words of the fields that it visits.
class WordList {
  public:
    explicit WordList(const void* structure) : base_(static_cast<const std::byte*>(structure)) {}

    void operator()(const std::string& name, const float& field) { add(name, true, &field); }
    void operator()(const std::string& name, const std::uint32_t& field) { add(name, false, &field); }
    template <glm::length_t N>
    void operator()(const std::string& name, const glm::vec<N, float>& field) {
        for (glm::length_t i = 0; i < N; ++i)
            add(name + "." + "xyzw"[i], true, &field[i]);
    }
    template <typename T, std::size_t N>
    void operator()(const std::string& name, const T (&field)[N]) {
        for (std::size_t i = 0; i < N; ++i)
            (*this)(name + "[" + std::to_string(i) + "]", field[i]);
    }
    void operator()(const std::string& name, const shared::DeviceCamera& c) {
        (*this)(name + ".position", c.position);
        (*this)(name + ".width", c.width);
        (*this)(name + ".forward", c.forward);
        (*this)(name + ".height", c.height);
        (*this)(name + ".right", c.right);
        (*this)(name + ".area", c.area);
        (*this)(name + ".up", c.up);
        (*this)(name + ".startDepth", c.startDepth);
        (*this)(name + ".start", c.start);
    }
    void operator()(const std::string& name, const shared::DeviceLightMatrix& m) {
        (*this)(name + ".m00", m.m00);
        (*this)(name + ".m01", m.m01);
        (*this)(name + ".m10", m.m10);
        (*this)(name + ".m11", m.m11);
    }

    std::vector<LayoutWord> words;

  private:
    void add(const std::string& name, bool isFloat, const void* at) {
        const auto offset = static_cast<std::size_t>(static_cast<const std::byte*>(at) - base_);
        words.push_back({name, isFloat, offset});
    }

    const std::byte* base_;
};

#define DUOLUX_FIELD(field) list(#field, s.field)
inline void listFields(const shared::PathParams& s, WordList& list) {
    DUOLUX_FIELD(camera);
    DUOLUX_FIELD(seed);
    DUOLUX_FIELD(bounces);
    DUOLUX_FIELD(opaque);
    DUOLUX_FIELD(transparent);
    DUOLUX_FIELD(rowWeight);
    DUOLUX_FIELD(display);
    DUOLUX_FIELD(emitterCount);
    DUOLUX_FIELD(emittingTriangles);
    DUOLUX_FIELD(emitterRoot);
    DUOLUX_FIELD(emitterLower);
    DUOLUX_FIELD(emitterUpper);
}
inline void listFields(const shared::DeviceLightMatrix& s, WordList& list) {
    DUOLUX_FIELD(m00);
    DUOLUX_FIELD(m01);
    DUOLUX_FIELD(m10);
    DUOLUX_FIELD(m11);
}
inline void listFields(const shared::DispatchParams& s, WordList& list) {
    DUOLUX_FIELD(firstPixel);
    DUOLUX_FIELD(pixelCount);
    DUOLUX_FIELD(firstSample);
    DUOLUX_FIELD(sampleCount);
    DUOLUX_FIELD(teamPixels);
    DUOLUX_FIELD(firstResult);
    DUOLUX_FIELD(firstTeam);
    DUOLUX_FIELD(inverseQuantum);
}
inline void listFields(const shared::LightDispatch& s, WordList& list) {
    DUOLUX_FIELD(firstLow);
    DUOLUX_FIELD(firstHigh);
    DUOLUX_FIELD(count);
    DUOLUX_FIELD(teamPaths);
    DUOLUX_FIELD(firstResult);
    DUOLUX_FIELD(firstTeam);
    DUOLUX_FIELD(inverseQuantum);
}
inline void listFields(const shared::TeamProgress& s, WordList& list) {
    DUOLUX_FIELD(taken);
    DUOLUX_FIELD(finished);
}
inline void listFields(const shared::PixelResult& s, WordList& list) {
    DUOLUX_FIELD(invisible);
    DUOLUX_FIELD(visible);
    DUOLUX_FIELD(nonFinite);
    DUOLUX_FIELD(clamped);
    DUOLUX_FIELD(cameraRays);
    DUOLUX_FIELD(bounceRays);
    DUOLUX_FIELD(shadowRays);
    DUOLUX_FIELD(emitterRays);
    DUOLUX_FIELD(lastBounce);
    DUOLUX_FIELD(previousBounce);
}
inline void listFields(const shared::LaneResult& s, WordList& list) {
    DUOLUX_FIELD(nonFinite);
    DUOLUX_FIELD(clamped);
    DUOLUX_FIELD(lightRays);
    DUOLUX_FIELD(bounceRays);
    DUOLUX_FIELD(shadowRays);
    DUOLUX_FIELD(lastBounce);
    DUOLUX_FIELD(previousBounce);
    DUOLUX_FIELD(invisible);
    DUOLUX_FIELD(visible);
}
inline void listFields(const shared::TraceRay& s, WordList& list) {
    DUOLUX_FIELD(origin);
    DUOLUX_FIELD(tMin);
    DUOLUX_FIELD(direction);
    DUOLUX_FIELD(tMax);
}
inline void listFields(const shared::TraceHit& s, WordList& list) {
    DUOLUX_FIELD(t);
    DUOLUX_FIELD(normal);
}
inline void listFields(const shared::TraceCounts& s, WordList& list) {
    DUOLUX_FIELD(nodes);
    DUOLUX_FIELD(pairs);
    DUOLUX_FIELD(nodeSteps);
    DUOLUX_FIELD(pairSteps);
}
inline void listFields(const shared::TraceDispatch& s, WordList& list) {
    DUOLUX_FIELD(rays);
    DUOLUX_FIELD(blockRays);
}
inline void listFields(const shared::DeviceMaterial& s, WordList& list) {
    DUOLUX_FIELD(baseColor);
    DUOLUX_FIELD(flags);
    DUOLUX_FIELD(metallic);
    DUOLUX_FIELD(roughness);
    DUOLUX_FIELD(unused);
    DUOLUX_FIELD(opaque);
    DUOLUX_FIELD(transparent);
}
inline void listFields(const shared::DeviceEmitter& s, WordList& list) {
    DUOLUX_FIELD(v0);
    DUOLUX_FIELD(flags);
    DUOLUX_FIELD(v1);
    DUOLUX_FIELD(positionError);
    DUOLUX_FIELD(v2);
    DUOLUX_FIELD(triangle);
    DUOLUX_FIELD(invisible);
    DUOLUX_FIELD(density);
    DUOLUX_FIELD(visible);
    DUOLUX_FIELD(unused);
    DUOLUX_FIELD(threshold);
    DUOLUX_FIELD(alias);
    DUOLUX_FIELD(padding);
}
inline void listFields(const shared::DevicePair& s, WordList& list) {
    DUOLUX_FIELD(v0);
    DUOLUX_FIELD(primitive0);
    DUOLUX_FIELD(v1);
    DUOLUX_FIELD(materialFlags1);
    DUOLUX_FIELD(v2);
    DUOLUX_FIELD(materialFlags0);
    DUOLUX_FIELD(v3);
    DUOLUX_FIELD(primitive1);
}
#undef DUOLUX_FIELD

template <typename S>
std::vector<LayoutWord> layoutWords() {
    const S structure{};
    WordList list(&structure);
    listFields(structure, list);
    return list.words;
}

/// A value that no other word has; as a float it is between 1 and 2.
inline std::uint32_t sentinel(std::size_t structure, std::size_t word) {
    return 0x3f800001u + static_cast<std::uint32_t>(structure << 12 | word << 1);
}

/// Structures of which every word holds the sentinel of its number.
template <typename S>
std::vector<S> sentinels(std::size_t count) {
    const std::vector<LayoutWord> words = layoutWords<S>();
    std::vector<S> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t w = 0; w < words.size(); ++w) {
            const std::uint32_t value = sentinel(i, w);
            std::memcpy(reinterpret_cast<std::byte*>(&out[i]) + words[w].offset, &value, sizeof(value));
        }
    }
    return out;
}

}  // namespace duolux::test
