// The radiance that a sample receives, and the sums over the samples of a pixel.
#ifndef DUOLUX_LIB_PIXEL_SUMS_GLSL
#define DUOLUX_LIB_PIXEL_SUMS_GLSL

#include "shaders/lib/film.glsl"
#include "shaders/lib/reflectance_matrix.glsl"
#include "shaders/shared/path_tracer_layout.h"

struct SampleRadiance {
    Radiance2 radiance;
    float lastBounce;
    float previousBounce;
};

// Adds the contribution of a path with `scatterings` scattering events. The displayed radiance (by the row `display`)
// of paths with the largest number of events, and of those with one fewer, is also summed separately.
void addRadiance(inout SampleRadiance g, Radiance2 arriving, uint scatterings, uint bounces, vec2 display) {
    g.radiance.invisible += arriving.invisible;
    g.radiance.visible += arriving.visible;
    vec3 displayed = display.x * arriving.invisible + display.y * arriving.visible;
    float mean = (displayed.x + displayed.y + displayed.z) * (1.0 / 3.0);
    g.lastBounce += scatterings == bounces ? mean : 0.0;
    g.previousBounce += scatterings + 1u == bounces ? mean : 0.0;
}

SampleRadiance noRadiance() { return SampleRadiance(Radiance2(vec3(0.0), vec3(0.0)), 0.0, 0.0); }

// The sums of a lane over the samples of a pixel.
struct PixelSums {
    FilmSum invisible;
    FilmSum visible;
    uint nonFinite;
    uint clamped;
    uint cameraRays;
    uint bounceRays;
    uint shadowRays;
    uint emitterRays;
    float lastBounce;
    float previousBounce;
};

PixelSums emptyPixelSums() { return PixelSums(filmZero(), filmZero(), 0u, 0u, 0u, 0u, 0u, 0u, 0.0, 0.0); }

void addSample(inout PixelSums sums, SampleRadiance received, float inverseQuantum, FilmRounding u) {
    vec3 total = received.radiance.invisible + received.radiance.visible;
    float sum = total.x + total.y + total.z;
    if (sum < kLargestSample) {
        sums.invisible = filmAccumulate(sums.invisible, received.radiance.invisible, inverseQuantum, u.invisible);
        sums.visible = filmAccumulate(sums.visible, received.radiance.visible, inverseQuantum, u.visible);
        sums.lastBounce += received.lastBounce;
        sums.previousBounce += received.previousBounce;
        sums.clamped += sum * inverseQuantum >= kFilmLargest ? 1u : 0u;
    } else {
        sums.nonFinite += 1u;
    }
}

uint[6] words(FilmSum sum) { return uint[6](sum.r.x, sum.r.y, sum.g.x, sum.g.y, sum.b.x, sum.b.y); }

PixelResult pixelResult(PixelSums sums) {
    PixelResult result;
    result.invisible = words(sums.invisible);
    result.visible = words(sums.visible);
    result.nonFinite = sums.nonFinite;
    result.clamped = sums.clamped;
    result.cameraRays = sums.cameraRays;
    result.bounceRays = sums.bounceRays;
    result.shadowRays = sums.shadowRays;
    result.emitterRays = sums.emitterRays;
    result.lastBounce = sums.lastBounce;
    result.previousBounce = sums.previousBounce;
    return result;
}

#endif
