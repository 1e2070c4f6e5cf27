#include "host/device_scene/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace duolux {

namespace {

using Swizzle = std::array<std::uint32_t, 4>;

/// Where an input is in the values of lookups: its group, and its components from the first on.
struct InputPlace {
    std::uint32_t group, first, components;
};

InputPlace placeOf(MaterialInput input) {
    switch (input) {
        case MaterialInput::kBaseColor:
            return {shared::kGroupBase, 0, 3};
        case MaterialInput::kAlpha:
            return {shared::kGroupBase, 3, 1};
        case MaterialInput::kMetallic:
            return {shared::kGroupSurface, 0, 1};
        case MaterialInput::kRoughness:
            return {shared::kGroupSurface, 1, 1};
        case MaterialInput::kTransmission:
            return {shared::kGroupSurface, 2, 1};
        case MaterialInput::kClearcoat:
            return {shared::kGroupSurface, 3, 1};
        case MaterialInput::kSpecularColor:
            return {shared::kGroupSpecular, 0, 3};
        case MaterialInput::kSpecular:
            return {shared::kGroupSpecular, 3, 1};
        case MaterialInput::kSheenColor:
            return {shared::kGroupSheen, 0, 3};
        case MaterialInput::kSheenRoughness:
            return {shared::kGroupSheen, 3, 1};
        case MaterialInput::kNormal:
            return {shared::kGroupNormal, 0, 3};
        case MaterialInput::kClearcoatRoughness:
            return {shared::kGroupNormal, 3, 1};
        case MaterialInput::kAnisotropy:
            return {shared::kGroupAnisotropy, 0, 3};
        case MaterialInput::kEmission:
            return {shared::kGroupEmission, 0, 3};
        case MaterialInput::kClearcoatNormal:
            return {shared::kGroupCoatNormal, 0, 3};
    }
    return {};
}

/// A lookup of inputs of one group in one image.
struct Lookup {
    Texture texture;
    std::uint32_t group;
    Swizzle swizzle;
    bool onlyAlpha;  ///< nothing but the image's alpha, which has no colour space
};

Lookup lookupOf(const MaterialTexture& entry) {
    const auto [group, first, components] = placeOf(entry.input);
    Lookup lookup{entry.texture, group, {}, components == 1 && entry.channel == 3};
    lookup.swizzle.fill(shared::kNoChannel);
    for (std::uint32_t i = 0; i < components; ++i)
        lookup.swizzle[first + i] = components == 1 ? entry.channel : i;
    return lookup;
}

/// Whether one lookup serves both; `into` becomes that lookup.
bool merge(Lookup& into, const Lookup& other) {
    if (into.group != other.group) return false;
    Texture texture = into.texture;
    if (into.onlyAlpha) texture.colourSpace = other.texture.colourSpace;
    Texture same = other.texture;
    if (other.onlyAlpha) same.colourSpace = texture.colourSpace;
    if (!(texture == same)) return false;
    into.texture = texture;
    into.onlyAlpha = into.onlyAlpha && other.onlyAlpha;
    for (std::size_t i = 0; i < into.swizzle.size(); ++i) {
        if (other.swizzle[i] != shared::kNoChannel) into.swizzle[i] = other.swizzle[i];
    }
    return true;
}

std::uint32_t deviceWrap(Wrap wrap) {
    switch (wrap) {
        case Wrap::kRepeat:
            return shared::kWrapRepeat;
        case Wrap::kClamp:
            return shared::kWrapClamp;
        case Wrap::kMirror:
            return shared::kWrapMirror;
    }
    return shared::kWrapRepeat;
}

shared::DeviceTexture recordOf(const Lookup& lookup, const AtlasImage& image) {
    const auto& [index, colourSpace, wrapU, wrapV, filter, uvSet, transform] = lookup.texture;
    static_cast<void>(index);
    shared::DeviceTexture record{};
    record.firstTexel = image.firstTexel;
    record.width = image.size().x;
    record.height = image.size().y;
    record.flags = lookup.group | deviceWrap(wrapU) << shared::kTextureWrapUShift |
                   deviceWrap(wrapV) << shared::kTextureWrapVShift |
                   (filter == Filter::kNearest ? shared::kTextureNearest : 0u) |
                   (colourSpace == ColourSpace::kSrgb ? shared::kTextureSrgb : 0u) |
                   (image.image->floats.empty() ? 0u : shared::kTextureFloat) |
                   (uvSet == 1 ? shared::kTextureSecondUv : 0u);
    for (std::uint32_t i = 0; i < 4; ++i)
        record.flags |= lookup.swizzle[i] << (shared::kTextureSwizzleShift + i * shared::kTextureSwizzleBits);
    const double angle = glm::radians(static_cast<double>(transform.rotation));
    const double c = std::cos(angle), s = std::sin(angle);
    const glm::dvec2 scale(transform.scale), offset(transform.offset);
    record.rowU = glm::vec3(c * scale.x, s * scale.y, offset.x);
    record.rowV = glm::vec3(-s * scale.x, c * scale.y, offset.y);
    return record;
}

}  // namespace

TextureTable makeTextureTable(const Scene& scene, const AtlasPlan& plan) {
    TextureTable table;
    table.ranges.resize(scene.materials.size());
    const std::vector<bool> used = usedMaterials(scene);
    std::unordered_map<const Image*, const AtlasImage*> places;
    for (const AtlasImage& image : plan.images)
        places.emplace(image.image.get(), &image);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        std::vector<Lookup> lookups;
        for (const MaterialTexture& entry : scene.materials[i].textures) {
            const Lookup lookup = lookupOf(entry);
            const bool merged =
                std::ranges::any_of(lookups, [&](Lookup& into) { return merge(into, lookup); });
            if (!merged) lookups.push_back(lookup);
        }
        table.ranges[i] = {static_cast<std::uint32_t>(table.records.size()),
                           static_cast<std::uint32_t>(lookups.size())};
        for (const Lookup& lookup : lookups) {
            table.records.push_back(recordOf(lookup, *places.at(scene.images[lookup.texture.image].get())));
            table.groups |= 1u << lookup.group;
        }
    }
    return table;
}

}  // namespace duolux
