#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "host/base/file.h"
#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

using testing::HasSubstr;

class BenchCommand : public testing::Test {
  protected:
    ProgramResult bench(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"bench", "--device", "cpu"});
        return runDuolux(folder_.path(), std::move(arguments));
    }
    TemporaryFolder folder_;
};

TEST_F(BenchCommand, MeasuresEverythingOnASmallScene) {
    const ProgramResult result =
        bench({"cornell", "--size", "16x16", "--spp", "1", "--repeat", "2", "--json", "a.json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const nlohmann::json json = nlohmann::json::parse(contentsOf(folder_ / "a.json"));
    std::vector<std::string> names;
    for (const nlohmann::json& r : json["results"]) {
        names.push_back(r["name"]);
        EXPECT_EQ(r["wall_seconds"].size(), 2u);
        EXPECT_GT(r["wall"]["median"].get<double>(), 0.0) << names.back();
        EXPECT_THAT(result.out, HasSubstr(names.back()));
        EXPECT_THAT(result.err, HasSubstr(names.back()));
    }
    EXPECT_THAT(
        names,
        testing::UnorderedElementsAre(
            "cornell/rays/primary", "cornell/rays/diffuse", "cornell/rays/shadow", "cornell/rays/crossings",
            "cornell/render/global/path", "cornell/render/global/light", "cornell/render/shadowless/path",
            "cornell/render/shadowless/light", "cornell/render/one-bounce/path",
            "cornell/render/one-bounce/light", "cornell/render/local/path", "cornell/render/local/light",
            "cornell/film/path", "cornell/film/light", "cornell/load", "cornell/build", "cornell/upload",
            "cornell/start/warm", "cornell/start/cold"));
    const auto of = [&](const std::string& name) {
        const auto at = std::find(names.begin(), names.end(), name);
        return json["results"][static_cast<std::size_t>(at - names.begin())];
    };
    EXPECT_GT(of("cornell/rays/primary")["notes"]["nodes_per_ray"].get<double>(), 1.0);
    // At least half a pair for each triangle, and the root.
    const double bytes = of("cornell/upload")["notes"]["bytes_per_triangle"];
    EXPECT_GT(bytes, 32.0 + 80.0 / 38.0);
    EXPECT_NEAR(bytes * 38.0 * 1e-6, of("cornell/upload")["work"], 1e-9);
    EXPECT_EQ(of("cornell/load")["unit"], "MB/s");
    EXPECT_NEAR(of("cornell/load")["work"].get<double>() * 1e6,
                static_cast<double>(std::filesystem::file_size(DUOLUX_ASSETS "/cornell/cornell.obj")), 1.0);
    EXPECT_EQ(of("cornell/film/path")["unit"], "Mpixels/s");
    EXPECT_THAT(json["device"]["driver"], HasSubstr("llvmpipe"));
    EXPECT_EQ(json["device"]["kind"], "cpu");
    EXPECT_NE(json["device"]["name"], "");
    EXPECT_NE(json["program"]["version"], "");
    EXPECT_NE(json["program"]["commit"], "");
    EXPECT_EQ(json["settings"],
              nlohmann::json::parse(R"({"width": 16, "height": 16, "spp": 1, "bounces": 16, "repeat": 2})"));
    EXPECT_EQ(json["tuning"]["cornell"]["layout"], "texel");
    EXPECT_EQ(json["tuning"]["cornell"]["kernel"], "refilling");
}

TEST_F(BenchCommand, MeasuresTheLayoutAndKernelAskedFor) {
    const ProgramResult result = bench({"cornell", "--size", "16x16", "--only", "rays/primary", "--repeat",
                                        "1", "--layout", "storage", "--kernel", "plain", "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const nlohmann::json json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["tuning"]["cornell"]["layout"], "storage");
    EXPECT_EQ(json["tuning"]["cornell"]["kernel"], "plain");
    EXPECT_EQ(json["tuning"]["cornell"]["leave_traversal"], 0);
}

TEST_F(BenchCommand, ComparesWithABaseline) {
    const std::vector<std::string> arguments{"cornell",   "--size", "16x16",        "--repeat",
                                             "1",         "--only", "rays/primary", "--only",
                                             "film/path", "--only", "cornell/load", "--quiet"};
    std::vector<std::string> first = arguments;
    first.insert(first.end(), {"--json", "a.json"});
    const ProgramResult written = bench(first);
    ASSERT_EQ(written.status, 0) << written.err;
    EXPECT_EQ(written.err, "");
    nlohmann::json json = nlohmann::json::parse(contentsOf(folder_ / "a.json"));
    ASSERT_EQ(json["results"].size(), 3u);
    const auto compare = [&](double factor) {
        nlohmann::json changed = json;
        for (nlohmann::json& result : changed["results"])
            result["wall"]["median"] = factor * result["wall"]["median"].get<double>();
        writeFile(folder_ / "b.json", changed.dump());
        std::vector<std::string> second = arguments;
        second.insert(second.end(), {"--baseline", "b.json"});
        return bench(second);
    };
    const ProgramResult faster = compare(1e-3);
    EXPECT_EQ(faster.status, 0) << faster.err;
    std::vector<std::string> others = arguments;
    others.insert(others.end(), {"--spp", "3", "--baseline", "b.json"});
    const ProgramResult refused = bench(others);
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("--baseline b.json: was measured with spp 16, not 3"));
    const ProgramResult slower = compare(1e3);
    EXPECT_EQ(slower.status, 1);
    EXPECT_THAT(slower.err,
                HasSubstr("3 of 3 benchmarks are more than 10 % slower than in b.json: cornell/rays/primary, "
                          "cornell/film/path, cornell/load"));
}

TEST_F(BenchCommand, GivesJsonAloneOnStandardOutput) {
    const ProgramResult result = bench({"--only", "rays/primary", "--only", "build", "cornell", "--size",
                                        "16x16", "--repeat", "1", "--json", "-", "--quiet"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out)["results"].size(), 2u);
}

TEST_F(BenchCommand, RefusesWhatItCannotMeasure) {
    ProgramResult result = bench({"nowhere.json"});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("nowhere.json is neither a file nor a built-in scene"));
    result = bench({"cornell", "--only", "nothing", "--quiet", "--size", "16x16"});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("no benchmark's name contains nothing"));
    EXPECT_THAT(result.err, HasSubstr("rays/{primary"));
    result = bench({"cornell", DUOLUX_ASSETS "/cornell/cornell.json"});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("two scenes are called cornell"));
    EXPECT_THAT(bench({"two-spheres-1"}).err, HasSubstr("N from 100 to 50000000"));
    writeFile(folder_ / "bad.json", "{}");
    result = bench({"cornell", "--baseline", "bad.json"});
    EXPECT_EQ(result.status, 3);
    EXPECT_EQ(bench({"cornell", "--baseline", "none.json"}).status, 3);
    EXPECT_EQ(bench({"cornell", "--repeat", "0"}).status, 2);
}

}  // namespace
}  // namespace duolux::test
