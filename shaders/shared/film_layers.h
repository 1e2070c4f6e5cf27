// The optional layers of the film, each declared once, for C++ and GLSL. (Radiance, the layers "invisible"
// and "visible", is always there; its quantum is that of the film, which a first look at the image
// determines.)
//
// To add a layer, add a line to DUOLUX_FILM_LAYERS, and one to the path tracer's kernel that sets
// layers.NAME. Sums, checkpoints, merging and EXR files iterate over the list.
#ifndef DUOLUX_SHADERS_SHARED_FILM_LAYERS_H
#define DUOLUX_SHADERS_SHARED_FILM_LAYERS_H

#include "shaders/shared/kernel_interface.h"

// LAYER(id, Id, index, channels, count, lowest, largest): `id` is the layer's name on the command line, in
// files and in kernels (layers.id), `Id` the same in constants (kLayerId); `index` is its place in the list;
// `channels` are `count` letters, up to three. A sample's value is clamped to [lowest, largest] in every
// channel.
#define DUOLUX_FILM_LAYERS(LAYER)                                                                     \
    /* shading normal of the first surface that is there: unit, world space, on the camera's side; 0: none */ \
    LAYER(normal, Normal, 0u, XYZ, 3u, -1.0f, 1.0f)

DUOLUX_BEGIN

// A value is rounded to the nearest multiple of the layer's quantum, which is fixed: 2^-30 of the larger of
// |lowest| and |largest|. The sum of 2^32 samples, more than a pixel can have, then fits into 63 bits.
DUOLUX_CONST float kLayerQuanta = 1073741824.0f;

// The sums of the layers of each pixel of a dispatch (kBindingLayers) are 64-bit two's complement numbers,
// one channel after the other.

DUOLUX_END
#endif
