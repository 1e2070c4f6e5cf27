#include "tests/reference/tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "host/base/parallel.h"
#include "tests/reference/triangles.h"

namespace duolux::reference {

namespace {

/// A material as the transport equation (eq. 16) needs it.
struct Surface {
    ChannelMatrix scatter;   ///< albedo times O: f_opaque = scatter / pi
    ChannelMatrix transmit;  ///< T
    ChannelLight emission;
    bool scattersFromBack = false, emitsFromBack = false;
};

/// A possible scattering event.
struct Vertex {
    Vec3 position, normal;  ///< unit normal on the side of the outgoing direction
    std::uint32_t triangle;
    ChannelMatrix
        weight;  ///< product of all matrices from the camera to here, this vertex's albedo O included
};

/// The state of one thread.
struct Walker {
    std::mt19937_64 random;
    std::uniform_real_distribution<double> uniform{0.0, 1.0};
    std::vector<Crossing> crossings;
    std::vector<Vertex> vertices;

    double next() { return uniform(random); }
};

class Tracer {
  public:
    Tracer(const LoadedScene& scene, const Settings& settings)
        : triangles_(scene.geometry), materialOf_(scene.geometry.materials), settings_(settings) {
        for (const Material& material : scene.materials) {
            const Reflectance& reflectance = scene.reflectanceOf(material);
            surfaces_.push_back({scaled(material.baseColor, channelsOf(reflectance.opaque)),
                                 channelsOf(reflectance.transparent),
                                 channelsOf(material.emission.invisible, material.emission.visible),
                                 material.sides == Sides::kBoth, material.emission.sides == Sides::kBoth});
        }
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            if (!scene.materials[materialOf_[i]].emission.any() || triangles_.area(i) == 0.0) continue;
            emitters_.push_back(i);
            emitterArea_ += triangles_.area(i);
            areaBelow_.push_back(emitterArea_);
        }
    }

    ChannelLight radiance(const Ray& ray, Walker& walker) const {
        ChannelLight light{};
        gather(ray, Triangles::kNone, identityPerChannel(), 0, walker, &light);
        // Every vertex of the camera ray is followed. The list is copied because a walk reuses it.
        const std::vector<Vertex> first = walker.vertices;
        for (const Vertex& vertex : first)
            follow(vertex, walker, light);
        return light;
    }

  private:
    const Surface& surfaceOf(std::uint32_t triangle) const { return surfaces_[materialOf_[triangle]]; }

    /// Follows a ray with the row weights M: each surface adds M E, may scatter by M O, and transmits M T to
    /// the surfaces behind. Stores the possible scattering vertices in walker.vertices.
    void gather(const Ray& ray, std::uint32_t from, ChannelMatrix weight, std::uint32_t bouncesSoFar,
                Walker& walker, ChannelLight* light) const {
        walker.vertices.clear();
        triangles_.crossings(ray, std::numeric_limits<double>::infinity(), from, Triangles::kNone,
                             walker.crossings);
        for (const Crossing& crossing : walker.crossings) {
            const Surface& surface = surfaceOf(crossing.triangle);
            if (light != nullptr && (crossing.front || surface.emitsFromBack)) {
                *light = *light + weight * surface.emission;
            }
            if (bouncesSoFar < settings_.bounces && (crossing.front || surface.scattersFromBack)) {
                const ChannelMatrix scattered = weight * surface.scatter;
                const Vec3 normal = triangles_.normal(crossing.triangle) * (crossing.front ? 1.0 : -1.0);
                if (!isZero(scattered)) {
                    walker.vertices.push_back({ray.origin + crossing.distance * ray.direction, normal,
                                               crossing.triangle, scattered});
                }
            }
            weight = weight * surface.transmit;
            if (isZero(weight)) return;
        }
    }

    void follow(Vertex vertex, Walker& walker, ChannelLight& light) const {
        for (std::uint32_t bounce = 1; bounce <= settings_.bounces; ++bounce) {
            const bool byArea = settings_.search == LightSearch::kArea;
            if (byArea) {
                addDirect(vertex, walker, light);
                if (bounce == settings_.bounces) return;
            }
            const Ray ray{vertex.position, cosineDirection(vertex.normal, walker)};
            // f cos / pdf = scatter / pi * cos / (cos / pi): the weight is already right.
            gather(ray, vertex.triangle, vertex.weight, bounce, walker, byArea ? nullptr : &light);
            if (walker.vertices.empty()) return;
            // One of the vertices, all equally likely: unbiased whatever their weights.
            const double count = static_cast<double>(walker.vertices.size());
            const auto chosen =
                std::min(static_cast<std::size_t>(walker.next() * count), walker.vertices.size() - 1);
            vertex = walker.vertices[chosen];
            vertex.weight = count * vertex.weight;
        }
    }

    /// The direct term of eq. 16 as an integral over the area of the emitters: scatter / pi, times the
    /// transmittance matrix of the segment, times E cos cos' / r^2.
    void addDirect(const Vertex& vertex, Walker& walker, ChannelLight& light) const {
        if (emitters_.empty()) return;
        const double at = walker.next() * emitterArea_;
        const auto index = static_cast<std::size_t>(
            std::upper_bound(areaBelow_.begin(), areaBelow_.end(), at) - areaBelow_.begin());
        const std::uint32_t emitter = emitters_[std::min(index, emitters_.size() - 1)];
        double u = walker.next(), v = walker.next();
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        if (emitter == vertex.triangle) return;
        const Vec3 offset = triangles_.point(emitter, u, v) - vertex.position;
        const double distance = glm::length(offset);
        const Ray ray{vertex.position, offset / distance};
        const double cosReceiver = glm::dot(vertex.normal, ray.direction);
        double cosEmitter = -glm::dot(triangles_.normal(emitter), ray.direction);
        if (surfaceOf(emitter).emitsFromBack) cosEmitter = std::abs(cosEmitter);
        if (cosReceiver <= 0.0 || cosEmitter <= 0.0) return;
        ChannelMatrix weight = vertex.weight;
        triangles_.crossings(ray, distance * (1.0 - 1e-12), vertex.triangle, emitter, walker.crossings);
        for (const Crossing& crossing : walker.crossings) {
            weight = weight * surfaceOf(crossing.triangle).transmit;
            if (isZero(weight)) return;
        }
        const double geometry =
            cosReceiver * cosEmitter * emitterArea_ / (std::numbers::pi * distance * distance);
        light = light + geometry * (weight * surfaceOf(emitter).emission);
    }

    /// Uniform points on the unit sphere tangent to the surface have cosine-distributed directions.
    static Vec3 cosineDirection(const Vec3& normal, Walker& walker) {
        for (;;) {
            const Vec3 inCube{2.0 * walker.next() - 1.0, 2.0 * walker.next() - 1.0,
                              2.0 * walker.next() - 1.0};
            const double square = glm::dot(inCube, inCube);
            if (square > 1.0 || square < 1e-12) continue;
            const Vec3 sum = normal + inCube / std::sqrt(square);
            const double length = glm::length(sum);
            if (length > 1e-9) return sum / length;
        }
    }

    Triangles triangles_;
    std::vector<std::uint32_t> materialOf_;
    std::vector<Surface> surfaces_;
    std::vector<std::uint32_t> emitters_;
    std::vector<double> areaBelow_;  ///< running sum over emitters_
    double emitterArea_ = 0.0;
    Settings settings_;
};

/// Mean and variance of the mean by Welford's recurrence (Technometrics 4, 1962).
class Moments {
  public:
    void add(const ChannelLight& light) {
        ++count_;
        for (int component = 0; component < 2; ++component) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                double& mean = estimate_.mean[component][channel];
                const double value = light[channel][component];
                const double delta = value - mean;
                mean += delta / count_;
                estimate_.variance[component][channel] += delta * (value - mean);
            }
        }
    }

    Estimate estimate() const {
        Estimate result = estimate_;
        for (auto& row : result.variance) {
            for (double& v : row)
                v /= count_ * (count_ - 1.0);
        }
        return result;
    }

  private:
    double count_ = 0.0;
    Estimate estimate_;
};

}  // namespace

Estimates trace(const LoadedScene& scene, const Settings& settings) {
    const Tracer tracer(scene, settings);
    const Pinhole pinhole(scene.camera, settings.width, settings.height);
    Estimates result{settings.width, settings.height, settings.samples, {}};
    result.pixels.resize(std::size_t{settings.width} * settings.height);
    parallelFor(settings.height, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            Walker walker;
            std::seed_seq seeds{static_cast<std::uint32_t>(settings.seed),
                                static_cast<std::uint32_t>(settings.seed >> 32),
                                static_cast<std::uint32_t>(y)};
            walker.random.seed(seeds);
            for (std::size_t x = 0; x < settings.width; ++x) {
                Moments moments;
                for (std::uint32_t s = 0; s < settings.samples; ++s) {
                    const double px = static_cast<double>(x) + walker.next();
                    const double py = static_cast<double>(y) + walker.next();
                    moments.add(tracer.radiance(pinhole.ray(px, py), walker));
                }
                result.pixels[y * settings.width + x] = moments.estimate();
            }
        }
    });
    return result;
}

}  // namespace duolux::reference
