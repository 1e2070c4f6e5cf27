#include "host/tools/peers/embree_path_tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "host/base/error.h"
#include "host/base/parallel.h"
#include "host/base/random.h"
#include "host/render/pixel_order.h"
#include "host/scene/emitters.h"
#include "host/scene/image_plane.h"
#include "shaders/shared/bvh_layout.h"

namespace duolux {

namespace {

using glm::vec2;
using glm::vec3;

constexpr float kPi = 3.14159265358979f;

float largest(const vec3& v) {
    return std::max({v.x, v.y, v.z});
}

float balance(float a, float b) {
    return a > 0.0f ? a / (a + b) : 0.0f;
}

class PathTracer {
  public:
    PathTracer(const EmbreeScene& embree, const Scene& scene, const RenderSettings& settings,
               const EmitterTable& emitters)
        : embree_(embree),
          scene_(scene),
          settings_(settings),
          emitters_(emitters),
          emittingTriangles_(emittingTriangles(scene)),
          plane_(imagePlane(scene.camera, settings.width, settings.height)) {}

    vec3 pixel(std::uint32_t pixel) const {
        vec3 sum(0.0f);
        Random random(settings_.seed, pixel);
        for (std::uint32_t s = 0; s < settings_.spp; ++s)
            sum += sample(pixel, random);
        return sum / static_cast<float>(settings_.spp);
    }

  private:
    struct Vertex {
        vec3 position, normal;  // moved off the surface, to the side of the ray
        vec3 albedo;
    };

    vec3 sample(std::uint32_t pixel, Random& random) const {
        const vec2 size(settings_.width, settings_.height);
        const float x = static_cast<float>(pixel % settings_.width) + random.uniform();
        const float y = static_cast<float>(pixel / settings_.width) + random.uniform();
        auto [origin, direction] =
            cameraRay(scene_.camera, plane_, {x / size.x * 2.0f - 1.0f, 1.0f - y / size.y * 2.0f});
        vec3 radiance(0.0f);
        vec3 throughput(1.0f);
        float pdf = 0.0f;
        for (std::uint32_t scatterings = 0;; ++scatterings) {
            const EmbreeScene::Hit hit = embree_.nearest(origin, direction, shared::kInfinity);
            if (hit.triangle == EmbreeScene::Hit::kNone) return radiance;
            const Material& material = scene_.materials[scene_.geometry.materials[hit.triangle]];
            const glm::uvec3 corner = scene_.geometry.triangles[hit.triangle];
            const vec3& a = scene_.geometry.positions[corner.x];
            const vec3& b = scene_.geometry.positions[corner.y];
            const vec3& c = scene_.geometry.positions[corner.z];
            vec3 normal = glm::normalize(glm::cross(b - a, c - a));
            const float cosine = glm::dot(normal, direction);
            const bool front = cosine < 0.0f;
            const shared::DeviceEmitter* const light = emitterOf(hit.triangle);
            if (light && (light->flags & (front ? shared::kEmitterFront : shared::kEmitterBack)) != 0u) {
                const vec3& emission = scatterings == 0 ? light->visible : light->invisible;
                const float ofLight = light->density * hit.t * hit.t / std::max(std::abs(cosine), 1e-12f);
                radiance += throughput * emission * (scatterings > 0 ? balance(pdf, ofLight) : 1.0f);
            }
            const bool scatters = front || material.sides == Sides::kBoth;
            if (scatterings >= settings_.bounces || !scatters || !(largest(material.baseColor) > 0.0f))
                return radiance;
            if (!front) normal = -normal;
            const vec3 extent = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
            const vec3 position = origin + direction * hit.t + normal * (largest(extent) * 0x1p-19f);
            throughput *= material.baseColor;
            radiance += throughput * directLight({position, normal, material.baseColor}, random);
            const float weight = largest(throughput);
            const float survival =
                scatterings >= 2 && weight < 1.0f ? std::min(std::sqrt(weight), 0.95f) : 1.0f;
            if (random.uniform() >= survival) return radiance;
            throughput /= survival;
            origin = position;
            direction = cosineDirection(normal, random);
            pdf = glm::dot(normal, direction) / kPi;
        }
    }

    /// The record of a triangle that emits, otherwise null.
    const shared::DeviceEmitter* emitterOf(std::uint32_t triangle) const {
        const std::uint32_t rank = TriangleRanks(emittingTriangles_).rankOf(triangle);
        return rank < emittingTriangles_.size() ? &emitters_.records[rank] : nullptr;
    }

    /// Of one emitter, on a surface of albedo 1.
    vec3 directLight(const Vertex& vertex, Random& random) const {
        if (emitters_.choices == 0) return vec3(0.0f);
        const std::uint64_t count = emitters_.choices;
        auto index = static_cast<std::size_t>(random.bits() * count >> 32);
        if (random.uniform() >= emitters_.records[index].threshold) index = emitters_.records[index].alias;
        const shared::DeviceEmitter& sampled = emitters_.records[index];
        float u = random.uniform();
        float v = random.uniform();
        if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
        const vec3 edge1 = sampled.v1 - sampled.v0;
        const vec3 edge2 = sampled.v2 - sampled.v0;
        const vec3 normal = glm::normalize(glm::cross(edge1, edge2));
        vec3 toLight = sampled.v0 + u * edge1 + v * edge2 - vertex.position;
        const bool front = glm::dot(normal, toLight) < 0.0f;
        toLight += normal * (front ? sampled.positionError : -sampled.positionError);
        const float cosAtVertex = glm::dot(vertex.normal, toLight);
        if (cosAtVertex <= 0.0f || !(front || (sampled.flags & shared::kEmitterBack) != 0u))
            return vec3(0.0f);
        const float distance = glm::length(toLight);
        const vec3 direction = toLight / distance;
        const float cosine = cosAtVertex / distance;
        const float pdf =
            sampled.density * distance * distance / std::max(std::abs(glm::dot(normal, direction)), 1e-12f);
        if (embree_.occluded(vertex.position, direction, distance)) return vec3(0.0f);
        return sampled.invisible * (cosine / kPi * balance(pdf, cosine / kPi) / pdf);
    }

    const EmbreeScene& embree_;
    const Scene& scene_;
    const RenderSettings& settings_;
    const EmitterTable& emitters_;
    std::vector<std::uint32_t> emittingTriangles_;  // the emitter of each has the same index
    ImagePlane plane_;
};

/// Whether the path tracer leaves out nothing of the scene. All fields by name: a further one does not
/// compile until it is handled here.
bool isSupported(const Scene& scene) {
    const auto& [source, camera, display, reflectance, materials, geometry, pointEmitters, images, origin,
                 content] = scene;
    const auto& [positions, triangles, materialIndices, normals, normalIndices, colours, alphas, uvs,
                 secondUvs, tangents, uvIndices] = geometry;
    static_cast<void>(
        std::tie(alphas, uvs, secondUvs, tangents, uvIndices, images));  // of images and coverage
    static_cast<void>(std::tie(source, camera, origin, content, positions, triangles, materialIndices));
    static_cast<void>(display);        // the picture is the visible component
    static_cast<void>(normalIndices);  // there are none without normals
    const auto isPlain = [](const Material& material) {
        return isPlainDiffuse(material) && !material.reflectance;
    };
    return reflectance == *presetReflectance("global") && normals.empty() && colours.empty() &&
           pointEmitters.empty() && std::ranges::all_of(materials, isPlain);
}

}  // namespace

RadianceImage renderByEmbree(const EmbreeScene& embree, const Scene& scene, const RenderSettings& settings,
                             const EmitterTable& emitters) {
    if (!isSupported(scene)) {
        throw UsageError(fmt::format(
            "{}: Embree's path tracer supports only flat normals, diffuse surfaces without colours "
            "of vertices, emitting triangles and `global`",
            scene.source.string()));
    }
    const PathTracer tracer(embree, scene, settings, emitters);
    RadianceImage image{settings.width, settings.height, {}, {}};
    const std::size_t pixels = std::size_t{image.width} * image.height;
    image.invisible.resize(pixels);
    image.visible.resize(pixels);
    const std::vector<std::uint32_t> order = pixelOrder(image.width, image.height);
    parallelFor(pixels, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            image.visible[order[i]] = tracer.pixel(order[i]);
    });
    return image;
}

}  // namespace duolux
