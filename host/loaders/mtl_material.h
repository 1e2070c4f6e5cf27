#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "host/loaders/mtl_images.h"
#include "host/scene/material.h"

namespace duolux {

/// The images of an MTL material that are used.
enum class MtlImage : std::uint8_t {
    kDiffuse,
    kSpecular,
    kEmission,
    kDissolve,
    kRoughness,
    kMetallic,
    kClearcoat,
    kClearcoatRoughness,
    kSheen,
    kNormal,
    kBump,
    kExponent
};

struct MtlImageUse {
    Texture texture;  ///< its image is an index into the files of MtlImages
    std::uint32_t channel = 0;
    bool hasChannel = false;        ///< whether the file chooses it
    double scale = 1.0;             ///< of bumps and normals
    double base = 0.0, gain = 1.0;  ///< of values
};

/// What an MTL file says of one material; colours and numbers are in their ranges.
struct MtlValues {
    std::optional<glm::dvec3> diffuse, specular, emission, filter, sheen;      ///< Kd, Ks, Ke, Tf, Ps
    std::optional<double> exponent;                                            ///< Ns
    std::optional<double> dissolve, transparency, ior;                         ///< d, Tr, Ni
    std::optional<double> roughness, metallic, clearcoat, clearcoatRoughness;  ///< Pr, Pm, Pc, Pcr
    std::optional<double> anisotropy, anisotropyRotation;  ///< aniso, anisor; the latter in full turns
    std::optional<double> illumination;                    ///< illum
    std::array<std::optional<MtlImageUse>, 12> images;     ///< by MtlImage

    std::optional<MtlImageUse>& image(MtlImage image) { return images[static_cast<std::size_t>(image)]; }
    const std::optional<MtlImageUse>& image(MtlImage image) const {
        return images[static_cast<std::size_t>(image)];
    }
};

/// Fills in a material (except for its name) by the table in README.md. The images that it uses are added to
/// `images`. Returns the keywords of statements that have no effect on it although they would have one
/// elsewhere.
std::vector<std::string_view> mapMtl(const MtlValues& values, Material& material, MtlImages& images);

/// Dissolves from this on are opaque.
inline constexpr double kMtlOpaque = 0.999;

}  // namespace duolux
