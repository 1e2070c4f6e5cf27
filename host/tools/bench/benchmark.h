#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace duolux {

/// The duration of a run in seconds.
struct BenchTimes {
    double wall = 0.0;
    double device = 0.0;  ///< by the device's timestamps; 0: not measured, or no timestamps
};

/// Seconds of wall time.
double secondsOf(const std::function<void()>& work);

/// Whether a name contains one of `only`, or `only` is empty.
bool isChosen(const std::string& name, const std::vector<std::string>& only);

/// A workload that can be run repeatedly.
struct Benchmark {
    std::string name;  ///< with parts, as in "cornell/rays/primary"
    std::string unit;  ///< of `work` per second; "s": the time itself is the result
    double work = 1.0;
    std::function<BenchTimes()> run;
    std::map<std::string, double> notes;  ///< further results, for example "nodes_per_ray"
};

/// Lowest, median and highest.
struct Spread {
    double low = 0.0, median = 0.0, high = 0.0;
};
/// Of at least one value.
Spread spreadOf(std::vector<double> values);

struct BenchResult {
    std::string name, unit;
    double work = 1.0;
    std::map<std::string, double> notes;
    std::vector<BenchTimes> times;

    bool isTime() const { return unit == "s"; }
    /// Work per second, or seconds, of wall time; of device time (all 0 where there is none).
    Spread wall() const;
    Spread device() const;
    /// Median of the seconds of wall time that a run took.
    double seconds() const;
};

/// Runs each benchmark once as a warm-up, then all in turns, `repeats` times, so that a temporary disturbance
/// of the machine affects all of them equally. `onRun` is called before each run.
std::vector<BenchResult> runBenchmarks(const std::vector<Benchmark>& benchmarks, std::uint32_t repeats,
                                       const std::function<void(const std::string&)>& onRun);

}  // namespace duolux
