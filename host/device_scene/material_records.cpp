#include "host/device_scene/material_records.h"

#include <tuple>

namespace duolux {

namespace {

void storeMatrix(const ReflectanceMatrix& m, glm::vec4 (&out)[4]) {
    out[0] = glm::vec4(m.m00, 0.0f);
    out[1] = glm::vec4(m.m01, 0.0f);
    out[2] = glm::vec4(m.m10, 0.0f);
    out[3] = glm::vec4(m.m11, 0.0f);
}

}  // namespace

std::vector<shared::DeviceMaterial> makeMaterialRecords(const Scene& scene) {
    std::vector<shared::DeviceMaterial> out;
    for (const Material& material : scene.materials) {
        // All fields by name: a further one does not compile until it is handled here.
        const auto& [name, baseColor, metallic, roughness, sides, emission, ownReflectance] = material;
        static_cast<void>(std::tie(name, emission, ownReflectance));  // elsewhere, or resolved below
        shared::DeviceMaterial d{};
        d.baseColor = baseColor;
        d.metallic = metallic;
        d.roughness = roughness;
        d.flags = sides == Sides::kBoth ? shared::kMaterialTwoSided : 0u;
        const Reflectance& reflectance = scene.reflectanceOf(material);
        storeMatrix(reflectance.opaque, d.opaque);
        storeMatrix(reflectance.transparent, d.transparent);
        out.push_back(d);
    }
    return out;
}

}  // namespace duolux
