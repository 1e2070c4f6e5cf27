#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/tools/compare/compare.h"

namespace duolux {

struct ExperimentSetup {
    std::filesystem::path duolux, duoluxGl;  ///< the programs
    std::filesystem::path folder;            ///< for all output
    std::uint32_t triangles = 500'000;
    std::uint32_t size = 512;                           ///< of the pictures, in pixels
    std::vector<std::uint32_t> spp{16, 64, 256, 1024};  ///< of the transport
    std::uint32_t passes = 64;                          ///< of OpenGL
    std::vector<std::uint32_t> crossing{1000,    5000,    20'000,
                                        100'000, 500'000, 2'000'000};  ///< triangles, for speed
    int repetitions = 3;                                               ///< of timed runs
    bool quick = false;                                                ///< for tests: few lights and samples
};

/// One comparison of `local` by transport with OpenGL.
struct Cell {
    std::string lights, lighting, estimator;
    std::uint32_t spp = 0;
    Comparison all, smooth, silhouettes;  ///< of all pixels; away from silhouettes; at them
};

/// Durations in seconds of the same image with both renderers.
struct Race {
    std::uint64_t triangles = 0;
    std::vector<double> transport, sampled, openGl;  ///< rendering alone; of each repetition, run in turns
    std::vector<double> transportAll, openGlAll;     ///< from start to end of the program
    double median(const std::vector<double>& seconds) const;
};

/// The fewest samples with which a picture is within an error of another, and the seconds they take.
struct TimeToError {
    std::uint32_t samples = 0;
    double eps = 0.0, seconds = 0.0;
};

struct Experiment {
    std::string device, openGl;  ///< what ran them
    std::vector<Cell> cells;
    /// The residual with five lights taken apart: mean eps of `local` in closed form at the most samples
    /// against OpenGL...
    std::vector<std::pair<std::string, double>> residual;
    std::vector<Race> races;
    TimeToError transportTo, openGlTo;
    double silhouetteFraction = 0.0;  ///< of the pixels
};

/// eps of the paper's result: 0.4 %.
inline constexpr double kPaperEps = 0.004;

/// Creates the scenes and all images in setup.folder, and compares them. Throws MachineError.
Experiment runExperiment(const ExperimentSetup& setup);

}  // namespace duolux
