#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/bench/benchmark.h"
#include "host/gpu/tuning.h"
#include "host/vk/device.h"

namespace duolux {

/// A table for people: rates of wall time, lowest, median and highest, and of device time; seconds of a run;
/// and the notes.
std::string benchTable(std::span<const BenchResult> results);

/// How many cores of what processor, as in "2 x AMD EPYC": on it depends what CPU devices do, and the host.
std::string hostProcessor();

/// Everything, as JSON with a "version". `settings`: what rates depend on, besides the number of runs.
/// `tunings`: by the names of scenes.
std::string benchJson(std::span<const BenchResult> results, const DeviceInfo& device,
                      const std::map<std::string, double>& settings,
                      const std::map<std::string, Tuning>& tunings);

/// Medians of wall rates by name, of a file that benchJson made.
struct Baseline {
    std::string device, driver, host, commit;
    std::map<std::string, double> settings, medians;
};
/// Throws InputError.
Baseline readBaseline(const std::filesystem::path& file);

struct BaselineComparison {
    std::string table;
    std::vector<std::string> regressions;  ///< names of what is slower by more than the threshold
    std::size_t compared = 0;
};
/// Ratios to a baseline, above 1 where it is better now; `threshold`: the part by which it may be worse.
BaselineComparison compareWithBaseline(std::span<const BenchResult> results, const Baseline& baseline,
                                       double threshold);

}  // namespace duolux
