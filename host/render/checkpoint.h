#pragma once

#include <filesystem>
#include <string>

#include "host/render/render.h"

namespace duolux {

/// Everything that a film depends on. Films whose origins differ only in the range of samples can be added.
struct FilmOrigin {
    std::string sceneFile;  ///< for information; not compared
    std::string sceneHash;
    std::string reflectance;  ///< a description; the hash covers it
    RenderSettings settings;
    DirectLight directLight = DirectLight::kSampled;  ///< the method used; kPath only
    glm::vec2 display{0.0f, 1.0f};                    ///< the hash covers it
    std::uint32_t firstSample = 0;                    ///< the range is [firstSample, settings.spp)
};

/// The exact state of a render. Another render can resume from it, and films of other checkpoints can be
/// added to it.
struct Checkpoint {
    FilmOrigin origin;
    RenderState state;
};

/// `directLightInClosedForm`: see RenderStatistics.
FilmOrigin originOf(const Scene& scene, const RenderSettings& settings, std::uint32_t firstSample,
                    bool directLightInClosedForm);

/// Replaces the file atomically: a reader sees the old file or the complete new one. Throws MachineError.
void writeCheckpoint(const std::filesystem::path& path, const FilmOrigin& origin, const Film& film,
                     const RenderStatistics& statistics);

/// Whether the file begins like a checkpoint of any version.
bool isCheckpoint(const std::filesystem::path& path);

/// Throws InputError if the file cannot be read, is not a checkpoint, has another version, or is damaged.
Checkpoint readCheckpoint(const std::filesystem::path& path);

/// The largest number of samples of any pixel of a film, or the number of light paths per pixel, rounded up.
std::uint32_t samplesTaken(const Film& film);

/// Throws InputError naming `file` if `origin`, read from it, differs from `wanted` in anything but the range
/// of samples. `wantedFrom` says in the message whose origin `wanted` is: "this render" or another
/// checkpoint.
void requireSameOrigin(const std::filesystem::path& file, const FilmOrigin& origin, const FilmOrigin& wanted,
                       const std::string& wantedFrom);

}  // namespace duolux
