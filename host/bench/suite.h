#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/bench/benchmark.h"
#include "host/gpu/tuning.h"
#include "host/vk/device.h"

namespace duolux {

struct SuiteOptions {
    std::uint32_t width = 512, height = 512;  ///< of pictures, and of ray sets
    std::uint32_t spp = 16;                   ///< of pictures
    std::uint32_t bounces = 16;
    TuningChoice tuning;
    std::string program;  ///< path of duolux itself, for start-up; empty: leave that out
};

/// Everything that is measured on one scene. Throws InputError if it cannot be loaded.
class SceneSuite {
  public:
    /// `name` begins the names of its benchmarks. `folder`: for files that the benchmarks write.
    SceneSuite(Device& device, std::string name, const std::filesystem::path& scene, SuiteOptions options,
               std::filesystem::path folder);
    ~SceneSuite();
    SceneSuite(const SceneSuite&) = delete;
    SceneSuite& operator=(const SceneSuite&) = delete;

    /// Those whose name contains one of `only`, or all if that is empty. Valid as long as the suite is.
    std::vector<Benchmark> benchmarks(const std::vector<std::string>& only);

    std::size_t triangles() const;
    const Tuning& tuning() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace duolux
