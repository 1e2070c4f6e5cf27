#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/device_scene/tuning.h"
#include "host/tools/bench/benchmark.h"
#include "host/vk/device_info.h"

namespace duolux {

/// A table for human readers: rates by wall time (lowest, median, highest) and by device time, the duration
/// of a run in seconds, and the notes.
std::string benchTable(std::span<const BenchResult> results);

/// The number of cores and the processor, as in "2 x AMD EPYC", which determine the speed of CPU devices and
/// of the host.
std::string hostProcessor();

/// All results as JSON with a "version". `settings`: values on which rates depend, and the number of runs.
/// `tunings`: by the names of scenes.
std::string benchJson(std::span<const BenchResult> results, const DeviceInfo& device,
                      const std::map<std::string, double>& settings,
                      const std::map<std::string, Tuning>& tunings);

/// The medians of wall rates by name, from a file written by benchJson.
struct Baseline {
    std::string device, driver, host, commit;
    std::map<std::string, double> settings, medians;
};
/// Throws InputError.
Baseline readBaseline(const std::filesystem::path& file);

struct BaselineComparison {
    std::string table;
    std::vector<std::string> regressions;  ///< names of benchmarks that are slower by more than the threshold
    std::size_t compared = 0;
};
/// Ratios to a baseline, above 1 if the new result is better; `threshold`: the fraction by which it may be
/// worse.
BaselineComparison compareWithBaseline(std::span<const BenchResult> results, const Baseline& baseline,
                                       double threshold);

}  // namespace duolux
