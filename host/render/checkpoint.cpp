#include "host/render/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/hash.h"
#include "host/base/memory.h"
#include "host/base/named.h"
#include "host/base/version.h"
#include "host/scene/hash.h"

namespace duolux {

namespace {

// The file: kMagic, whose last letter is the version; the length of the header as uint32; the header (JSON);
// samples per pixel (uint32); sums of pixels, and sums of light paths if there are any (six int64 per pixel
// each); sums of the layers (an int64 per pixel and channel); and a checksum of everything before it
// (uint64). All numbers are little-endian, as on all hosts.
constexpr char kMagic[9] = "DUOLUXC4";
constexpr std::size_t kMagicBytes = 8;

template <typename T>
std::string_view bytesOf(std::span<const T> items) {
    return {reinterpret_cast<const char*>(items.data()), items.size_bytes()};
}

/// Removes items from the front of the bytes and returns them.
template <typename Items>
Items take(std::string_view& bytes, std::size_t count) {
    Items items(count);
    std::memcpy(items.data(), bytes.data(), count * sizeof items[0]);
    bytes.remove_prefix(count * sizeof items[0]);
    return items;
}

/// Throws an InputError that names the file.
using Fail = std::function<void(const std::string& problem)>;

constexpr const char* kPartsDoNotFit = "is damaged: its parts do not fit";

std::string listOf(FilmLayerSet layers) {
    return layers == 0 ? "none" : fmt::format("{}", fmt::join(namesOf(layers), ","));
}

/// A field of an origin: its place in the header, and its name in messages, or null if it may differ between
/// films that are added.
struct Field {
    const char *part, *key, *name;
};

/// Calls visit(field, value) for every field of an origin: what writes, reads or compares origins goes by
/// this list. A field that is missing here does not compile.
template <typename Origin, typename Visit>
void forEachField(Origin& origin, Visit&& visit) {
    auto& [sceneFile, sceneHash, reflectance, settings, directLight, display, samples] = origin;
    auto& [width, height, spp, bounces, seed, sampler, integrator, layers] = settings;
    auto& [begin, end] = samples;
    static_cast<void>(spp);     // `samples` takes its place
    static_cast<void>(layers);  // the film has them
    visit(Field{"scene", "file", nullptr}, sceneFile);
    visit(Field{"scene", "hash", "scene hash"}, sceneHash);
    visit(Field{"scene", "reflectance", "reflectance"}, reflectance);
    visit(Field{"scene", "display", nullptr}, display);  // the hash covers it
    visit(Field{"settings", "width", "width"}, width);
    visit(Field{"settings", "height", "height"}, height);
    visit(Field{"settings", "bounces", "bounces"}, bounces);
    visit(Field{"settings", "seed", "seed"}, seed);
    visit(Field{"settings", "sampler", "sampler"}, sampler);
    visit(Field{"settings", "integrator", "integrator"}, integrator);
    visit(Field{"settings", "direct_light", "direct light"}, directLight);
    visit(Field{"settings", "first_sample", nullptr}, begin);
    visit(Field{"settings", "end_sample", nullptr}, end);
}

template <typename T>
nlohmann::ordered_json toJson(const T& value) {
    if constexpr (std::is_enum_v<T>) {
        return nameOf(value);
    } else if constexpr (std::is_same_v<T, glm::vec2>) {
        return {value.x, value.y};
    } else {
        return value;
    }
}

template <typename T>
void fromJson(const nlohmann::json& json, const Field& field, const Fail& fail, T& value) {
    if constexpr (std::is_enum_v<T>) {
        const auto name = json.get<std::string>();
        const auto found = named<T>(name);
        if (!found) fail(fmt::format("has the {} '{}', which this version does not know", field.name, name));
        value = *found;
    } else if constexpr (std::is_same_v<T, glm::vec2>) {
        value = {json.at(0).get<float>(), json.at(1).get<float>()};
    } else {
        json.get_to(value);
    }
}

std::string headerOf(const FilmOrigin& origin, const Film& film, const RenderStatistics& statistics) {
    nlohmann::ordered_json header;
    header["program"] = fmt::format("duolux {} ({})", versionString(), commitString());
    forEachField(origin, [&](const Field& field, const auto& value) {
        header[field.part][field.key] = toJson(value);
    });
    header["film"] = {{"quantum", film.quantum()},
                      {"light_paths", film.lightPaths()},
                      {"light_sums", !film.lightPathSums().empty()},
                      {"carries", film.carries()},
                      {"layers", namesOf(film.layers())},
                      {"overflowed", statistics.filmOverflowed || film.overflowed()},
                      {"last_bounce", statistics.lastBounceRadiance},
                      {"previous_bounce", statistics.previousBounceRadiance}};
    // Paths need not be UTF-8.
    return header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Without the layers.
FilmOrigin originFrom(const nlohmann::json& header, const Fail& fail) {
    FilmOrigin origin;
    forEachField(origin, [&](const Field& field, auto& value) {
        fromJson(header.at(field.part).at(field.key), field, fail, value);
    });
    if (origin.directLight == DirectLight::kAuto) fail(kPartsDoNotFit);  // a render has chosen one
    origin.settings.spp = origin.samples.size();
    return origin;
}

/// The fields that must be equal in all films of a sum, as pairs of name and text. A mismatch is reported by
/// the first field that differs, so the size and the reflectance come first.
std::vector<std::pair<std::string, std::string>> identityOf(const FilmOrigin& origin) {
    const RenderSettings& settings = origin.settings;
    std::vector<std::pair<std::string, std::string>> identity{
        {"size", fmt::format("{}x{}", settings.width, settings.height)}, {"reflectance", origin.reflectance}};
    forEachField(origin, [&](const Field& field, const auto& value) {
        if (field.name == nullptr) return;
        const nlohmann::ordered_json json = toJson(value);
        identity.emplace_back(field.name, json.is_string() ? json.get<std::string>() : json.dump());
    });
    identity.emplace_back("layers", listOf(settings.layers));
    return identity;
}

/// The layers with these names.
FilmLayerSet layersNamed(const nlohmann::json& names, const Fail& fail) {
    FilmLayerSet layers = 0;
    for (const auto& name : names) {
        const auto layer = layerNamed(name.get<std::string>());
        if (!layer)
            fail(fmt::format("has a layer '{}', which this version does not know", name.get<std::string>()));
        layers |= *layer;
    }
    if (names != namesOf(layers)) fail(kPartsDoNotFit);  // duplicates, or another order
    return layers;
}

Checkpoint parse(std::string_view bytes, const Fail& fail) {
    std::uint32_t headerBytes = 0;
    std::memcpy(&headerBytes, bytes.data() + kMagicBytes, sizeof headerBytes);
    bytes.remove_prefix(kMagicBytes + sizeof headerBytes);
    bytes.remove_suffix(sizeof(std::uint64_t));
    if (headerBytes > bytes.size()) fail(kPartsDoNotFit);
    const nlohmann::json header = nlohmann::json::parse(bytes.substr(0, headerBytes));
    bytes.remove_prefix(headerBytes);
    FilmOrigin origin = originFrom(header, fail);
    const nlohmann::json& film = header.at("film");
    Film::Contents contents;
    contents.width = origin.settings.width;
    contents.height = origin.settings.height;
    contents.layers = origin.settings.layers = layersNamed(film.at("layers"), fail);
    film.at("quantum").get_to(contents.quantum);
    film.at("light_paths").get_to(contents.lightPaths);
    film.at("carries").get_to(contents.carries);
    const std::size_t pixels = std::size_t{contents.width} * contents.height;
    const bool hasLightPaths = film.at("light_sums").get<bool>();
    const std::size_t channels = channelsOf(contents.layers);
    if (bytes.size() != pixels * (sizeof(std::uint32_t) + (hasLightPaths ? 2 : 1) * sizeof(Film::PixelSum) +
                                  channels * sizeof(std::int64_t)))
        fail(kPartsDoNotFit);
    contents.samples = take<Film::Samples>(bytes, pixels);
    contents.sums = take<Film::Sums>(bytes, pixels);
    if (hasLightPaths) contents.lightPathSums = take<Film::Sums>(bytes, pixels);
    contents.layerSums = take<Film::LayerSums>(bytes, pixels * channels);
    return {std::move(origin),
            {Film(std::move(contents)), film.at("last_bounce").get<double>(),
             film.at("previous_bounce").get<double>(), film.at("overflowed").get<bool>()}};
}

}  // namespace

FilmOrigin originOf(const Scene& scene, const RenderSettings& settings, SampleRange samples,
                    bool directLightInClosedForm) {
    return {scene.source.string(),
            hashScene(scene),
            describeReflectance(scene.reflectance),
            settings,
            directLightInClosedForm ? DirectLight::kClosedForm : DirectLight::kSampled,
            scene.display,
            samples};
}

void writeCheckpoint(const std::filesystem::path& path, const FilmOrigin& origin, const Film& film,
                     const RenderStatistics& statistics) {
    const std::string header = headerOf(origin, film, statistics);
    const auto headerBytes = static_cast<std::uint32_t>(header.size());
    writeFileAtomically(path, [&](FileWriter& file) {
        Hasher checksum;
        for (const std::string_view part :
             {std::string_view(kMagic, kMagicBytes), bytesOf(std::span(&headerBytes, 1)),
              std::string_view(header), bytesOf(film.samples()), bytesOf(film.sums()),
              bytesOf(film.lightPathSums()), bytesOf(film.layerSums())}) {
            checksum.add(part);
            file.write(part);
        }
        const std::uint64_t sum = checksum.digest();
        file.write(bytesOf(std::span(&sum, 1)));
    });
}

namespace {

Checkpoint read(const std::filesystem::path& path) {
    const std::string bytes = readFile(path);
    const Fail fail = [&](const std::string& problem) {
        throw InputError(path.string(), "", problem, "expected a checkpoint");
    };
    std::uint64_t sum = 0;
    if (bytes.size() < kMagicBytes + sizeof(std::uint32_t) + sizeof sum ||
        bytes.compare(0, kMagicBytes - 1, kMagic, kMagicBytes - 1) != 0) {
        fail("is no checkpoint");
    }
    if (bytes[kMagicBytes - 1] != kMagic[kMagicBytes - 1]) fail("is a checkpoint of another version");
    const std::string_view content(bytes.data(), bytes.size() - sizeof sum);
    std::memcpy(&sum, bytes.data() + content.size(), sizeof sum);
    Hasher checksum;
    checksum.add(content);
    if (sum != checksum.digest()) fail("is damaged or incomplete: its checksum is wrong");
    try {
        return parse(bytes, fail);
    } catch (const nlohmann::json::exception&) {
        fail("is damaged: its header cannot be read");
        throw;
    }
}

}  // namespace

bool isCheckpoint(const std::filesystem::path& path) {
    constexpr std::string_view kAnyVersion(kMagic, kMagicBytes - 1);
    std::array<char, kAnyVersion.size()> start{};
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    return std::string_view(start.data(), start.size()) == kAnyVersion;
}

Checkpoint readCheckpoint(const std::filesystem::path& path) {
    return withMemoryToRead(path, [&] { return read(path); });
}

std::uint32_t samplesTaken(const Film& film) {
    const std::uint64_t pixels = std::uint64_t{film.width()} * film.height();
    const std::uint64_t pathsPerPixel = (film.lightPaths() + pixels - 1) / pixels;
    return std::max(static_cast<std::uint32_t>(pathsPerPixel), std::ranges::max(film.samples()));
}

void requireSameOrigin(const std::filesystem::path& file, const FilmOrigin& origin, const FilmOrigin& wanted,
                       const std::string& wantedFrom) {
    const auto here = identityOf(origin), there = identityOf(wanted);
    for (std::size_t i = 0; i < here.size(); ++i) {
        if (here[i] == there[i]) continue;
        throw InputError(file.string(), here[i].first,
                         fmt::format("is {}, but {} in {}", here[i].second, there[i].second, wantedFrom),
                         "expected the same scene and settings");
    }
}

}  // namespace duolux
