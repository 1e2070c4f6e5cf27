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
    RenderSettings settings;  ///< with the spp of `samples` if they were read from a checkpoint
    DirectLight directLight = DirectLight::kSampled;  ///< the method used, not kAuto; kPathTracer only
    glm::vec2 display{0.0f, 1.0f};                    ///< the hash covers it
    SampleRange samples;                              ///< asked for; the film may have fewer
};

/// The exact state of a render. Another render can resume from it, and films of other checkpoints can be
/// added to it.
struct Checkpoint {
    FilmOrigin origin;
    RenderState state;
};

/// The origin of a film of these samples. `directLightInClosedForm`: see RenderStatistics.
FilmOrigin originOf(const Scene& scene, const RenderSettings& settings, SampleRange samples,
                    bool directLightInClosedForm);

/// Replaces the file atomically: a reader sees the old file or the complete new one. The film must have the
/// size and the layers of the origin's settings. Throws MachineError if the file cannot be written.
void writeCheckpoint(const std::filesystem::path& path, const FilmOrigin& origin, const Film& film,
                     const RenderStatistics& statistics);

/// Whether the file begins like a checkpoint of any version; false if it cannot be read.
bool isCheckpoint(const std::filesystem::path& path);

/// Throws InputError if the file cannot be read, is not a checkpoint, has another version, or is damaged,
/// and MachineError if memory does not suffice.
Checkpoint readCheckpoint(const std::filesystem::path& path);

/// The largest number of samples of any pixel of a film, or the number of light paths per pixel, rounded up.
std::uint32_t samplesTaken(const Film& film);

/// Throws InputError naming `file` if `origin`, read from it, differs from `wanted` in anything but the range
/// of samples. `wantedFrom` says in the message whose origin `wanted` is: "this render" or another
/// checkpoint.
void requireSameOrigin(const std::filesystem::path& file, const FilmOrigin& origin, const FilmOrigin& wanted,
                       const std::string& wantedFrom);

}  // namespace duolux
