#include "host/render/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/hash.h"
#include "host/base/memory.h"
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

const char* nameOf(DirectLight directLight) {
    return directLight == DirectLight::kClosedForm ? "closed-form" : "sampled";
}

std::string headerOf(const FilmOrigin& origin, const Film& film, const RenderStatistics& statistics) {
    const RenderSettings& settings = origin.settings;
    nlohmann::ordered_json header;
    header["program"] = fmt::format("duolux {} ({})", versionString(), commitString());
    header["scene"] = {{"file", origin.sceneFile},
                       {"hash", origin.sceneHash},
                       {"reflectance", origin.reflectance},
                       {"display", {origin.display.x, origin.display.y}}};
    header["settings"] = {{"width", settings.width},
                          {"height", settings.height},
                          {"bounces", settings.bounces},
                          {"seed", settings.seed},
                          {"sampler", nameOf(settings.sampler)},
                          {"integrator", nameOf(settings.integrator)},
                          {"direct_light", nameOf(origin.directLight)},
                          {"first_sample", origin.firstSample},
                          {"end_sample", settings.spp}};
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

FilmOrigin originFrom(const nlohmann::json& header) {
    const nlohmann::json& scene = header.at("scene");
    const nlohmann::json& settings = header.at("settings");
    FilmOrigin origin;
    origin.sceneFile = scene.at("file").get<std::string>();
    origin.sceneHash = scene.at("hash").get<std::string>();
    origin.reflectance = scene.at("reflectance").get<std::string>();
    origin.display = {scene.at("display").at(0).get<float>(), scene.at("display").at(1).get<float>()};
    settings.at("width").get_to(origin.settings.width);
    settings.at("height").get_to(origin.settings.height);
    settings.at("bounces").get_to(origin.settings.bounces);
    settings.at("seed").get_to(origin.settings.seed);
    settings.at("end_sample").get_to(origin.settings.spp);
    settings.at("first_sample").get_to(origin.firstSample);
    origin.settings.sampler =
        settings.at("sampler") == nameOf(Sampler::kIndependent) ? Sampler::kIndependent : Sampler::kSobol;
    origin.settings.integrator = settings.at("integrator") == nameOf(Integrator::kLightTracer)
                                     ? Integrator::kLightTracer
                                     : Integrator::kPathTracer;
    origin.directLight = settings.at("direct_light") == nameOf(DirectLight::kClosedForm)
                             ? DirectLight::kClosedForm
                             : DirectLight::kSampled;
    return origin;
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
    FilmOrigin origin = originFrom(header);
    const nlohmann::json& film = header.at("film");
    const auto& [width, height] = std::pair(origin.settings.width, origin.settings.height);
    const std::size_t pixels = std::size_t{width} * height;
    const bool light = film.at("light_sums").get<bool>();
    origin.settings.layers = layersNamed(film.at("layers"), fail);
    const std::size_t channels = channelsOf(origin.settings.layers);
    if (bytes.size() != pixels * (sizeof(std::uint32_t) + (light ? 2 : 1) * sizeof(Film::PixelSum) +
                                  channels * sizeof(std::int64_t)))
        fail(kPartsDoNotFit);
    auto samples = take<Film::Samples>(bytes, pixels);
    auto sums = take<Film::Sums>(bytes, pixels);
    auto lightPathSums = light ? take<Film::Sums>(bytes, pixels) : Film::Sums();
    auto layerSums = take<Film::LayerSums>(bytes, pixels * channels);
    const FilmLayerSet layers = origin.settings.layers;
    return {std::move(origin),
            {Film(width, height, film.at("quantum").get<float>(), std::move(sums), std::move(samples),
                  std::move(lightPathSums), film.at("light_paths").get<std::uint64_t>(),
                  film.at("carries").get<Film::Carries>(), layers, std::move(layerSums)),
             film.at("last_bounce").get<double>(), film.at("previous_bounce").get<double>(),
             film.at("overflowed").get<bool>()}};
}

}  // namespace

FilmOrigin originOf(const Scene& scene, const RenderSettings& settings, std::uint32_t firstSample,
                    bool directLightInClosedForm) {
    return {scene.source.string(),
            hashScene(scene),
            describeReflectance(scene.reflectance),
            settings,
            directLightInClosedForm ? DirectLight::kClosedForm : DirectLight::kSampled,
            scene.display,
            firstSample};
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
    const std::uint64_t light = (film.lightPaths() + pixels - 1) / pixels;
    return std::max(static_cast<std::uint32_t>(light), std::ranges::max(film.samples()));
}

void requireSameOrigin(const std::filesystem::path& file, const FilmOrigin& origin, const FilmOrigin& wanted,
                       const std::string& wantedFrom) {
    const auto require = [&](const char* what, const auto& here, const auto& there) {
        if (here == there) return;
        throw InputError(file.string(), what, fmt::format("is {}, but {} of {}", here, there, wantedFrom),
                         "expected the same scene and settings");
    };
    const RenderSettings &a = origin.settings, &b = wanted.settings;
    require("size", fmt::format("{}x{}", a.width, a.height), fmt::format("{}x{}", b.width, b.height));
    require("reflectance", origin.reflectance, wanted.reflectance);
    require("scene hash", origin.sceneHash, wanted.sceneHash);
    require("integrator", std::string(nameOf(a.integrator)), std::string(nameOf(b.integrator)));
    require("bounces", a.bounces, b.bounces);
    require("seed", a.seed, b.seed);
    require("sampler", std::string(nameOf(a.sampler)), std::string(nameOf(b.sampler)));
    require("layers", listOf(a.layers), listOf(b.layers));
    require("direct light", std::string(nameOf(origin.directLight)), std::string(nameOf(wanted.directLight)));
}

}  // namespace duolux
