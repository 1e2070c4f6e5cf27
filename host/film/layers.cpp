#include "host/film/layers.h"

namespace duolux {

std::vector<const FilmLayer*> layersOf(FilmLayerSet set) {
    std::vector<const FilmLayer*> layers;
    for (std::size_t i = 0; i < kFilmLayers.size(); ++i) {
        if ((set >> i & 1u) != 0) layers.push_back(&kFilmLayers[i]);
    }
    return layers;
}

std::uint32_t channelsOf(FilmLayerSet set) {
    std::size_t channels = 0;
    for (const FilmLayer* layer : layersOf(set))
        channels += layer->channels.size();
    return static_cast<std::uint32_t>(channels);
}

std::vector<std::string> namesOf(FilmLayerSet set) {
    std::vector<std::string> names;
    for (const FilmLayer* layer : layersOf(set))
        names.emplace_back(layer->name);
    return names;
}

std::optional<FilmLayerSet> layerNamed(std::string_view name) {
    const auto* const found = std::ranges::find(kFilmLayers, name, &FilmLayer::name);
    if (found == kFilmLayers.end()) return std::nullopt;
    return FilmLayerSet{1} << (found - kFilmLayers.begin());
}

}  // namespace duolux
