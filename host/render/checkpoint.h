#pragma once

#include <filesystem>
#include <string>

#include "host/render/render.h"

namespace duolux {

/// What a film depends on: films with the same of all but the range of samples can be added.
struct FilmOrigin {
    std::string sceneFile;  ///< noted for people; what counts is the hash
    std::string sceneHash;
    std::string reflectance;  ///< described; the hash covers it
    RenderSettings settings;
    DirectLight directLight = DirectLight::kSampled;  ///< as it was found; kPath only
    glm::vec2 display{0.0f, 1.0f};                    ///< the hash covers it
    std::uint32_t firstSample = 0;                    ///< the range was [firstSample, settings.spp)
};

/// A render as it stands, exactly: another can go on from it, or add others to it.
struct Checkpoint {
    FilmOrigin origin;
    RenderState state;
};

/// `directLightInClosedForm`: as RenderStatistics tells.
FilmOrigin originOf(const Scene& scene, std::uint32_t firstSample, bool directLightInClosedForm);

/// Writes it so that a reader sees the old file or the complete new one. Throws MachineError.
void writeCheckpoint(const std::filesystem::path& path, const FilmOrigin& origin, const Film& film,
                     const RenderStatistics& statistics);

/// The file begins as a checkpoint does, of any version.
bool isCheckpoint(const std::filesystem::path& path);

/// Throws InputError if the file cannot be read, is no checkpoint, is of another version or damaged.
Checkpoint readCheckpoint(const std::filesystem::path& path);

/// Samples of a pixel, or light paths per pixel, that a film holds, the most of any pixel.
std::uint32_t samplesTaken(const Film& film);

/// Throws InputError naming `file` if what was rendered there is not the same as `wanted`, but for the range
/// of samples, which `wantedFrom` ("this render", another checkpoint) has.
void requireSameOrigin(const std::filesystem::path& file, const FilmOrigin& origin, const FilmOrigin& wanted,
                       const std::string& wantedFrom);

}  // namespace duolux
