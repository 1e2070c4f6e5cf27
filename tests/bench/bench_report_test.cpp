#include "host/tools/bench/bench_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/cli/temporary_folder.h"

namespace duolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Benchmark, RunsAllInTurnsAndDoesNotCountTheFirst) {
    std::string order;
    int runs = 0;
    std::vector<Benchmark> benchmarks;
    for (const char* name : {"a", "b"}) {
        benchmarks.push_back({name,
                              "items/s",
                              6.0,
                              [&order, &runs, name] {
                                  order += name;
                                  return BenchTimes{static_cast<double>(++runs), 0.5};
                              },
                              {}});
    }
    const std::vector<BenchResult> results = runBenchmarks(benchmarks, 3, [](const std::string&) {});
    EXPECT_EQ(order, "abababab");
    ASSERT_EQ(results[0].times.size(), 3u);
    // a took 3, 5 and 7 seconds.
    EXPECT_DOUBLE_EQ(results[0].wall().low, 6.0 / 7.0);
    EXPECT_DOUBLE_EQ(results[0].wall().median, 6.0 / 5.0);
    EXPECT_DOUBLE_EQ(results[0].wall().high, 2.0);
    EXPECT_DOUBLE_EQ(results[1].device().median, 12.0);
}

TEST(Benchmark, SpreadOfEvenlyManyValuesHasTheMeanOfTheTwoInTheMiddle) {
    const Spread spread = spreadOf({4.0, 1.0, 3.0, 10.0});
    EXPECT_EQ(spread.low, 1.0);
    EXPECT_EQ(spread.median, 3.5);
    EXPECT_EQ(spread.high, 10.0);
}

std::vector<BenchResult> sample(double rate, double seconds) {
    return {{"cornell/rays/primary", "Mrays/s", rate, {}, {{1.0, 0.0}}},
            {"cornell/start", "s", 1.0, {}, {{seconds, 0.0}}}};
}

TEST(Baseline, SurvivesItsFileAndKnowsWhatIsBetter) {
    const TemporaryFolder folder;
    DeviceInfo device;
    device.name = "a device";
    device.driver = "a driver";
    writeFile(folder / "old.json", benchJson(sample(10.0, 2.0), device, {{"spp", 16.0}}, {}));
    const nlohmann::json json = nlohmann::json::parse(readFile(folder / "old.json"));
    EXPECT_EQ(json["version"], 2);
    EXPECT_EQ(json["settings"]["spp"], 16.0);
    EXPECT_EQ(json["results"][0]["wall_seconds"][0], 1.0);
    const Baseline baseline = readBaseline(folder / "old.json");
    EXPECT_EQ(baseline.device, "a device");
    EXPECT_EQ(baseline.driver, "a driver");
    EXPECT_EQ(baseline.host, hostProcessor());
    EXPECT_EQ(baseline.settings, (std::map<std::string, double>{{"spp", 16.0}}));
    EXPECT_THAT(compareWithBaseline(sample(9.1, 2.1), baseline, 0.1).regressions, ElementsAre());
    EXPECT_THAT(compareWithBaseline(sample(8.9, 2.1), baseline, 0.1).regressions,
                ElementsAre("cornell/rays/primary"));
    EXPECT_THAT(compareWithBaseline(sample(20.0, 2.3), baseline, 0.1).regressions,
                ElementsAre("cornell/start"));
    EXPECT_THAT(compareWithBaseline(sample(5.0, 2.0), baseline, 0.1).table,
                HasSubstr("cornell/rays/primary     10.0     5.00    0.500  slower"));
    EXPECT_EQ(compareWithBaseline({}, baseline, 0.1).compared, 0u);
    std::vector<BenchResult> others = sample(10.0, 2.0);
    others[0].name = "spot/load";
    const BaselineComparison partial = compareWithBaseline(others, baseline, 0.1);
    EXPECT_EQ(partial.compared, 1u);
    EXPECT_THAT(partial.table, HasSubstr("not in the baseline"));
}

TEST(Baseline, WhatIsNoneIsRefused) {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& text) -> std::string {
        writeFile(folder / "x.json", text);
        try {
            readBaseline(folder / "x.json");
        } catch (const InputError& e) {
            return e.what();
        }
        return "accepted";
    };
    EXPECT_THAT(message("{"), HasSubstr("x.json: byte 2: is not JSON; expected a file that"));
    EXPECT_THAT(message(R"({"version": 1})"), HasSubstr("x.json: version: is 1; expected"));
    EXPECT_THAT(message(R"({"version": 2})"), HasSubstr("x.json: key 'device' not found; expected a file"));
}

}  // namespace
}  // namespace duolux::test
