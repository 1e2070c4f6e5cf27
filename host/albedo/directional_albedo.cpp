#include "host/albedo/directional_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace duolux {

namespace {

constexpr double kPi = std::numbers::pi;

struct Vector {
    double x, y, z;
};

double dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector directionOf(double cosine) {
    return {std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), 0.0, cosine};
}

/// Of GGX, along and across the tangent.
struct Alpha {
    double x, y;
};

/// Smith's Lambda of GGX.
double lambda(double alpha, double cosine) {
    const double tangent2 = (1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

/// The mean over visible normals of visit(normal, cosine between direction and normal), with the density of
/// Dupuy and Benyoub (2023), by the midpoint rule. Normals near the horizon are rare, but steep: the polar
/// samples are dense there.
template <typename Visit>
double meanOverVisibleNormals(const Alpha& alpha, const Vector& direction, const Visit& visit) {
    constexpr int kPolar = 128, kAzimuthal = 16;
    const double length =
        std::sqrt(alpha.x * alpha.x * direction.x * direction.x +
                  alpha.y * alpha.y * direction.y * direction.y + direction.z * direction.z);
    const Vector stretched{alpha.x * direction.x / length, alpha.y * direction.y / length,
                           direction.z / length};
    // In the plane of the tangent all is symmetric in y: half of the circle.
    const int azimuths = direction.y == 0.0 ? kAzimuthal : 2 * kAzimuthal;
    double sum = 0.0;
    for (int i = 0; i < kPolar; ++i) {
        const double root = (i + 0.5) / kPolar, weight = 2.0 * root;
        const double z = root * root * (1.0 + stretched.z) - stretched.z;
        const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
        for (int k = 0; k < azimuths; ++k) {
            const double phi = kPi * (k + 0.5) / kAzimuthal;
            Vector h{(r * std::cos(phi) + stretched.x) * alpha.x, (r * std::sin(phi) + stretched.y) * alpha.y,
                     std::max(z + stretched.z, 0.0)};
            const double scale = 1.0 / std::sqrt(dot(h, h));
            h = {h.x * scale, h.y * scale, h.z * scale};
            sum += weight * visit(h, dot(direction, h));
        }
    }
    return sum / (kPolar * azimuths);
}

/// Masking and shadowing of both directions over the masking of one, where `other` is on the same side.
double shadowing(double alpha, double cosine, double other) {
    if (other <= 0.0) return 0.0;
    const double first = lambda(alpha, cosine);
    return (1.0 + first) / (1.0 + first + lambda(alpha, other));
}

/// The exact Fresnel reflectance of unpolarised light. `eta`: as in glassAlbedo.
double fresnel(double cosine, double eta) {
    const double sine2 = (1.0 - cosine * cosine) / (eta * eta);
    if (sine2 >= 1.0) return 1.0;
    const double refracted = std::sqrt(1.0 - sine2);
    const double parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
    const double perpendicular = (cosine - eta * refracted) / (cosine + eta * refracted);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

double alphaOf(double roughness) {
    return std::max(roughness * roughness, 1e-4);
}

}  // namespace

ReflectionAlbedo reflectionAlbedo(double cosine, double roughness) {
    const double alpha = alphaOf(roughness);
    const Vector wo = directionOf(cosine);
    const auto mean = [&](bool grazing) {
        return meanOverVisibleNormals({alpha, alpha}, wo, [&](const Vector& h, double c) {
            const double m = std::clamp(1.0 - c, 0.0, 1.0);
            return shadowing(alpha, cosine, 2.0 * c * h.z - cosine) * (grazing ? m * m * m * m * m : 1.0);
        });
    };
    const double all = mean(false), atGrazing = mean(true);
    return {all - atGrazing, atGrazing};
}

ReflectionAlbedo stretchedAlbedo(double cosine, double azimuth, double roughness, double anisotropy) {
    const double across = alphaOf(roughness);
    const Alpha alpha{across + (1.0 - across) * anisotropy * anisotropy, across};
    const double sine = directionOf(cosine).x;
    const Vector wo{sine * azimuth, azimuth < 1.0 ? sine * std::sqrt(1.0 - azimuth * azimuth) : 0.0, cosine};
    const auto lambdaOf = [&](const Vector& w) {
        const double x = alpha.x * w.x / w.z, y = alpha.y * w.y / w.z;
        return 0.5 * (std::sqrt(1.0 + x * x + y * y) - 1.0);
    };
    const double first = lambdaOf(wo);
    const auto mean = [&](bool grazing) {
        return meanOverVisibleNormals(alpha, wo, [&](const Vector& h, double c) {
            const Vector wi{2.0 * c * h.x - wo.x, 2.0 * c * h.y - wo.y, 2.0 * c * h.z - wo.z};
            if (wi.z <= 0.0) return 0.0;
            const double m = std::clamp(1.0 - c, 0.0, 1.0);
            return (1.0 + first) / (1.0 + first + lambdaOf(wi)) * (grazing ? m * m * m * m * m : 1.0);
        });
    };
    const double all = mean(false), atGrazing = mean(true);
    return {all - atGrazing, atGrazing};
}

double glassAlbedo(double cosine, double roughness, double eta) {
    const double alpha = alphaOf(roughness);
    const Vector wo = directionOf(cosine);
    return meanOverVisibleNormals({alpha, alpha}, wo, [&](const Vector& h, double c) {
        const double reflected = fresnel(c, eta);
        const double byReflection = shadowing(alpha, cosine, 2.0 * c * h.z - cosine);
        if (reflected >= 1.0) return byReflection;
        // The z of the refracted direction, which is on the other side.
        const double inner = std::sqrt(1.0 - (1.0 - c * c) / (eta * eta));
        const double below = -((c / eta - inner) * h.z - cosine / eta);
        return reflected * byReflection + (1.0 - reflected) * shadowing(alpha, cosine, below);
    });
}

double sheenAlbedo(double cosine, double roughness) {
    // As in shaders/lib/bsdf/sheen.glsl.
    const double alpha = std::max(roughness * roughness, 0.04);
    const double blend = (1.0 - alpha) * (1.0 - alpha);
    const auto parameter = [&](double smooth, double rough) {
        return blend * smooth + (1.0 - blend) * rough;
    };
    const double a = parameter(25.3245, 21.5473), b = parameter(3.32435, 3.82987),
                 c = parameter(0.16801, 0.19823), d = parameter(-1.27393, -1.97760),
                 e = parameter(-4.85967, -4.32054);
    const auto curve = [&](double x) { return a / (1.0 + b * std::pow(x, c)) + d * x + e; };
    const auto shadow = [&](double x) {
        return x < 0.5 ? std::exp(curve(x)) : std::exp(2.0 * curve(0.5) - curve(1.0 - x));
    };
    const Vector wo = directionOf(cosine);
    const double outer = shadow(cosine);
    constexpr int kPolar = 256, kAzimuthal = 256;
    double sum = 0.0;
    for (int i = 0; i < kPolar; ++i) {
        const double z = (i + 0.5) / kPolar, r = std::sqrt(1.0 - z * z);
        const double visibility = 1.0 / ((1.0 + outer + shadow(z)) * 4.0 * cosine);  // times the cosine z
        for (int k = 0; k < kAzimuthal; ++k) {
            const double phi = kPi * (k + 0.5) / kAzimuthal;
            const Vector h{wo.x + r * std::cos(phi), r * std::sin(phi), wo.z + z};
            const double cos2 = h.z * h.z / dot(h, h);
            sum += visibility * (2.0 + 1.0 / alpha) * std::pow(std::max(1.0 - cos2, 0.0), 0.5 / alpha);
        }
    }
    // The density's 1 / (2 pi), over a hemisphere of 2 pi.
    return sum / (kPolar * kAzimuthal);
}

}  // namespace duolux
