#include "host/tools/bench/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/parallel.h"
#include "host/base/version.h"
#include "host/cli/json.h"
#include "host/cli/processor.h"
#include "host/device_scene/json.h"

namespace duolux {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 2;

std::string number(double value) {
    if (value == 0.0) return "-";
    return fmt::format("{:.{}f}", value, value >= 100.0 ? 0 : value >= 10.0 ? 1 : value >= 1.0 ? 2 : 3);
}

std::size_t widestName(std::span<const BenchResult> results) {
    std::size_t width = 9;
    for (const BenchResult& r : results)
        width = std::max(width, r.name.size());
    return width;
}

Json spreadJson(const Spread& spread) {
    return {{"low", spread.low}, {"median", spread.median}, {"high", spread.high}};
}

}  // namespace

std::string benchTable(std::span<const BenchResult> results) {
    const std::size_t width = widestName(results);
    std::string table = fmt::format("{:<{}} {:>8} {:>8} {:>8}  {:<13} {:>8} {:>8}\n", "benchmark", width,
                                    "low", "median", "high", "unit", "device", "seconds");
    std::string perRay, perItem;
    for (const BenchResult& r : results) {
        const Spread wall = r.wall();
        table += fmt::format("{:<{}} {:>8} {:>8} {:>8}  {:<13} {:>8} {:>8}\n", r.name, width,
                             number(wall.low), number(wall.median), number(wall.high), r.unit,
                             number(r.device().median), number(r.seconds()));
        if (r.notes.contains("nodes_per_ray")) {
            perRay += fmt::format("{:<{}} {:>8.1f} {:>8.1f} {:>8.0f}   {:.0f} %, {:.0f} %\n", r.name, width,
                                  r.notes.at("nodes_per_ray"), r.notes.at("pairs_per_ray"),
                                  r.notes.at("node_bytes_per_ray") + r.notes.at("pair_bytes_per_ray"),
                                  100.0 * r.notes.at("lanes_in_nodes"), 100.0 * r.notes.at("lanes_in_pairs"));
            continue;
        }
        for (const auto& [note, value] : r.notes)
            perItem += fmt::format("{:<{}} {:>8.1f}   {}\n", r.name, width, value, note);
    }
    if (!perRay.empty()) {
        table += fmt::format("\n{:<{}} {:>8} {:>8} {:>8}   lanes busy in nodes, pairs\n{}", "per ray", width,
                             "nodes", "pairs", "bytes", perRay);
    }
    if (!perItem.empty()) table += "\n" + perItem;
    return table;
}

std::string benchJson(std::span<const BenchResult> results, const DeviceInfo& device,
                      const std::map<std::string, double>& settings,
                      const std::map<std::string, Tuning>& tunings) {
    Json report;
    report["version"] = kVersion;
    report["program"] = {{"name", "duolux"}, {"version", versionString()}, {"commit", commitString()}};
    report["device"] = toJson(device);
    report["device"]["host"] = hostProcessor();
    report["settings"] = settings;
    for (const auto& [scene, tuning] : tunings)
        report["tuning"][scene] = toJson(tuning);
    report["results"] = Json::array();
    for (const BenchResult& r : results) {
        Json wall = Json::array();
        Json onDevice = Json::array();
        for (const BenchTimes& t : r.times) {
            wall.push_back(t.wall);
            onDevice.push_back(t.device);
        }
        report["results"].push_back({{"name", r.name},
                                     {"unit", r.unit},
                                     {"work", r.work},
                                     {"wall", spreadJson(r.wall())},
                                     {"device", spreadJson(r.device())},
                                     {"wall_seconds", wall},
                                     {"device_seconds", onDevice},
                                     {"notes", r.notes}});
    }
    return jsonText(report);
}

std::string hostProcessor() {
    return fmt::format("{} x {}", workerCount(), processorName());
}

Baseline readBaseline(const std::filesystem::path& file) {
    const std::string text = readFile(file);
    const auto fail = [&](std::string_view place, std::string_view what) {
        throw InputError(file.string(), place, what, "expected a file that `duolux bench --json` wrote");
    };
    Baseline baseline;
    try {
        const Json json = Json::parse(text);
        if (json.at("version") != kVersion) fail("version", fmt::format("is {}", json.at("version").dump()));
        baseline.device = json.at("device").at("name");
        baseline.driver = json.at("device").at("driver");
        baseline.host = json.at("device").at("host");
        baseline.commit = json.at("program").at("commit");
        baseline.settings = json.at("settings");
        for (const Json& result : json.at("results")) {
            const std::string name = result.at("name");
            const double median = result.at("wall").at("median");
            if (!(median > 0.0)) fail(name, fmt::format("has a median of {:g}", median));
            baseline.medians[name] = median;
        }
    } catch (const Json::parse_error& e) {
        fail(fmt::format("byte {}", e.byte), "is not JSON");
    } catch (const Json::exception& e) {
        const std::string_view what = e.what();  // [json.exception...] what is wrong
        fail("", what.substr(what.find("] ") + 2));
    }
    return baseline;
}

BaselineComparison compareWithBaseline(std::span<const BenchResult> results, const Baseline& baseline,
                                       double threshold) {
    BaselineComparison out;
    const std::size_t width = widestName(results);
    out.table = fmt::format(
        "against the baseline, of commit {}; ratios above 1 are faster\n{:<{}} {:>8} {:>8} {:>8}\n",
        baseline.commit, "benchmark", width, "then", "now", "ratio");
    for (const BenchResult& r : results) {
        const auto then = baseline.medians.find(r.name);
        const double now = r.wall().median;
        if (then == baseline.medians.end()) {
            out.table +=
                fmt::format("{:<{}} {:>8} {:>8}  not in the baseline\n", r.name, width, "-", number(now));
            continue;
        }
        const double ratio = r.isTime() ? then->second / now : now / then->second;
        const bool worse = ratio < 1.0 - threshold;
        out.table += fmt::format("{:<{}} {:>8} {:>8} {:>8.3f}{}\n", r.name, width, number(then->second),
                                 number(now), ratio, worse ? "  slower" : "");
        if (worse) out.regressions.push_back(r.name);
        ++out.compared;
    }
    return out;
}

}  // namespace duolux
