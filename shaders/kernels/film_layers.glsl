// The optional layers of the film in a kernel: their values in the current sample, and their sums over the samples of a
// pixel. What is generated here for every layer of the list vanishes if kFilmLayers lacks the layer.
#include "shaders/lib/film.glsl"
#include "shaders/shared/film_layers.h"

layout(constant_id = kSpecFilmLayers) const uint kFilmLayers = 0u;

layout(binding = kBindingLayers, scalar) writeonly buffer LayersBlock { uvec2 layerResults[]; };

// Whether a layer is accumulated: kLayerNormal ...
#define DUOLUX_LAYER_WANTED(id, Id, index, channels, count, lowest, largest) \
    const bool kLayer##Id = (kFilmLayers & (1u << index)) != 0u;
DUOLUX_FILM_LAYERS(DUOLUX_LAYER_WANTED)

// The values of the current sample; 0 unless set.
#define DUOLUX_LAYER_VALUE(id, Id, index, channels, count, lowest, largest) vec3 id;
struct LayerValues {
    DUOLUX_FILM_LAYERS(DUOLUX_LAYER_VALUE)
};
LayerValues layers;

#define DUOLUX_LAYER_SUM(id, Id, index, channels, count, lowest, largest) FilmSum id;
struct LayerSums {
    DUOLUX_FILM_LAYERS(DUOLUX_LAYER_SUM)
};
LayerSums layerSums;

// Begins a pixel.
void emptyLayers() {
#define DUOLUX_LAYER_EMPTY(id, Id, index, channels, count, lowest, largest) \
    layers.id = vec3(0.0);                                                  \
    layerSums.id = filmZero();
    DUOLUX_FILM_LAYERS(DUOLUX_LAYER_EMPTY)
}

// Adds the values of the current sample, and begins the next sample.
void addLayers() {
#define DUOLUX_LAYER_ADD(id, Id, index, channels, count, lowest, largest)                                \
    if (kLayer##Id) {                                                                                    \
        layerSums.id = filmAccumulateSigned(layerSums.id, clamp(layers.id, vec3(lowest), vec3(largest)), \
                                            kLayerQuanta / max(abs(lowest), abs(largest)));              \
    }                                                                                                    \
    layers.id = vec3(0.0);
    DUOLUX_FILM_LAYERS(DUOLUX_LAYER_ADD)
}

// Stores the sums of a pixel as the result with this index.
void storeLayers(uint result) {
#define DUOLUX_LAYER_COUNT(id, Id, index, channels, count, lowest, largest) +(kLayer##Id ? count : 0u)
    uint next = result * (0u DUOLUX_FILM_LAYERS(DUOLUX_LAYER_COUNT));
#define DUOLUX_LAYER_STORE(id, Id, index, channels, count, lowest, largest) \
    if (kLayer##Id) {                                                       \
        layerResults[next] = layerSums.id.r;                                \
        if (count > 1u) layerResults[next + 1u] = layerSums.id.g;           \
        if (count > 2u) layerResults[next + 2u] = layerSums.id.b;           \
        next += count;                                                      \
    }
    DUOLUX_FILM_LAYERS(DUOLUX_LAYER_STORE)
}
