// Tables of directional albedos, which shaders/lib/bsdf/albedo.glsl reads and host/albedo computes.
#ifndef DUOLUX_SHADERS_SHARED_ALBEDO_LAYOUT_H
#define DUOLUX_SHADERS_SHARED_ALBEDO_LAYOUT_H

#include "shaders/shared/types.h"

DUOLUX_BEGIN

// A table has values at knots 0, 1/n, ..., 1 of each of its axes, where n is the number of cells of an axis.
// Axes: the square root of the cosine between a direction and the normal; roughness; and for glass the cube
// root of (ior - 1) / (ior + 1) (the square root of the reflectance at normal incidence) divided by
// kAlbedoLargestIor, or for anisotropic microfacets |cos| of the direction's azimuth to the tangent, and the
// anisotropy. A texel (4 x uint32) holds a cell: two functions at its four corners, as unorm16. Words 0
// and 1: the first function at (cosine, roughness) (0, 0), (1, 0) and (0, 1), (1, 1); words 2 and 3: the
// second.
DUOLUX_CONST uint kAlbedoCells = 32u;       // of each axis of kAlbedoReflection and kAlbedoSheen
DUOLUX_CONST uint kAlbedoGlassCells = 24u;  // of cosine and roughness of kAlbedoGlass
DUOLUX_CONST uint kAlbedoIors = 17u;        // knots of its third axis, which has a slice of cells each
DUOLUX_CONST uint kAlbedoStretchedCells = 16u;   // of cosine and roughness of kAlbedoStretched
DUOLUX_CONST uint kAlbedoAzimuthCells = 8u;
DUOLUX_CONST uint kAlbedoAnisotropyCells = 8u;
DUOLUX_CONST float kAlbedoLargestIor = 0.8181818f;  // (ior - 1) / (ior + 1) of ior 10

// GGX reflection by single scattering, without Fresnel reflectance: the parts that Schlick's approximation
// weights by f0 and by f90.
DUOLUX_CONST uint kAlbedoReflection = 0u;
// Half of that of sheen of colour 1, which exceeds 1 at grazing directions; the second function is 0.
DUOLUX_CONST uint kAlbedoSheen = kAlbedoReflection + kAlbedoCells * kAlbedoCells;
// Rough glass, reflection and refraction by single scattering: from outside and from inside.
DUOLUX_CONST uint kAlbedoGlass = kAlbedoSheen + kAlbedoCells * kAlbedoCells;
// GGX reflection as above, but stretched along the tangent: the alphas are (mix(roughness^2, 1, anisotropy^2),
// roughness^2). A slice of cells of cosine and roughness for each knot of azimuth, for each of anisotropy.
DUOLUX_CONST uint kAlbedoStretched = kAlbedoGlass + kAlbedoIors * kAlbedoGlassCells * kAlbedoGlassCells;
DUOLUX_CONST uint kAlbedoStretchedSlices = (kAlbedoAzimuthCells + 1u) * (kAlbedoAnisotropyCells + 1u);
// The means of these functions over the hemisphere, weighted by the cosine: a texel for each cell of the
// roughness, whose two corners are (0, 0) and (0, 1); the others are unused.
DUOLUX_CONST uint kAlbedoReflectionMean =
    kAlbedoStretched + kAlbedoStretchedSlices * kAlbedoStretchedCells * kAlbedoStretchedCells;
DUOLUX_CONST uint kAlbedoGlassMean = kAlbedoReflectionMean + kAlbedoCells;
DUOLUX_CONST uint kAlbedoStretchedMean = kAlbedoGlassMean + kAlbedoIors * kAlbedoGlassCells;
DUOLUX_CONST uint kAlbedoTexels =
    kAlbedoStretchedMean + (kAlbedoAnisotropyCells + 1u) * kAlbedoStretchedCells;

DUOLUX_END
#endif
