#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shaders/shared/film_layers.h"

namespace duolux {

/// An optional layer of a film: the means over samples of some value, in a few channels.
struct FilmLayer {
    std::string_view name;
    std::string_view channels;  ///< a letter each
    float lowest, largest;      ///< of a sample; clamped

    /// The unit of the layer's sums.
    constexpr double quantum() const {
        return static_cast<double>(std::max({lowest, -lowest, largest, -largest})) /
               static_cast<double>(shared::kLayerQuanta);
    }
};

/// All layers that there are: DUOLUX_FILM_LAYERS.
#define DUOLUX_LAYER(id, Id, index, channels, count, lowest, largest) \
    FilmLayer{#id, #channels, lowest, largest},
inline constexpr std::array kFilmLayers{DUOLUX_FILM_LAYERS(DUOLUX_LAYER)};
#undef DUOLUX_LAYER

/// A set of layers: bit i stands for kFilmLayers[i].
using FilmLayerSet = std::uint32_t;
static_assert(kFilmLayers.size() <= 32);

/// The sets of one layer: kLayerNormal ...
#define DUOLUX_LAYER(id, Id, index, channels, count, lowest, largest)                          \
    inline constexpr FilmLayerSet kLayer##Id = FilmLayerSet{1} << (index);                     \
    static_assert(kFilmLayers.at(index).name == #id && (lowest) < (largest) && (count) <= 3 && \
                  std::string_view(#channels).size() == (count));
DUOLUX_FILM_LAYERS(DUOLUX_LAYER)
#undef DUOLUX_LAYER

/// The layers of a set, in the order of kFilmLayers.
std::vector<const FilmLayer*> layersOf(FilmLayerSet set);

/// The number of channels of all layers of a set.
std::uint32_t channelsOf(FilmLayerSet set);

/// The names of the layers of a set.
std::vector<std::string> namesOf(FilmLayerSet set);

/// The set of the one layer with this name; empty if there is none.
std::optional<FilmLayerSet> layerNamed(std::string_view name);

}  // namespace duolux
