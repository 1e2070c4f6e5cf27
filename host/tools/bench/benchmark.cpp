#include "host/tools/bench/benchmark.h"

#include <algorithm>
#include <cassert>

#include "host/base/clock.h"

namespace duolux {

namespace {

Spread spreadOfRates(const BenchResult& result, double BenchTimes::*seconds) {
    std::vector<double> values;
    for (const BenchTimes& t : result.times) {
        if (t.*seconds > 0.0) values.push_back(result.isTime() ? t.*seconds : result.work / (t.*seconds));
    }
    return values.empty() ? Spread{} : spreadOf(std::move(values));
}

}  // namespace

double secondsOf(const std::function<void()>& work) {
    const Clock::time_point start = Clock::now();
    work();
    return secondsSince(start);
}

bool isChosen(const std::string& name, const std::vector<std::string>& only) {
    return only.empty() || std::ranges::any_of(only, [&](const std::string& part) {
               return name.find(part) != std::string::npos;
           });
}

Spread spreadOf(std::vector<double> values) {
    assert(!values.empty());
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    const double median =
        values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
    return {values.front(), median, values.back()};
}

Spread BenchResult::wall() const {
    return spreadOfRates(*this, &BenchTimes::wall);
}

Spread BenchResult::device() const {
    return spreadOfRates(*this, &BenchTimes::device);
}

double BenchResult::seconds() const {
    std::vector<double> values;
    for (const BenchTimes& t : times)
        values.push_back(t.wall);
    return values.empty() ? 0.0 : spreadOf(std::move(values)).median;
}

std::vector<BenchResult> runBenchmarks(const std::vector<Benchmark>& benchmarks, std::uint32_t repeats,
                                       const std::function<void(const std::string&)>& onRun) {
    std::vector<BenchResult> results;
    for (const Benchmark& b : benchmarks) {
        onRun(b.name);
        b.run();
        results.push_back({b.name, b.unit, b.work, b.notes, {}});
    }
    for (std::uint32_t repeat = 0; repeat < repeats; ++repeat) {
        for (std::size_t i = 0; i < benchmarks.size(); ++i) {
            onRun(benchmarks[i].name);
            results[i].times.push_back(benchmarks[i].run());
        }
    }
    return results;
}

}  // namespace duolux
