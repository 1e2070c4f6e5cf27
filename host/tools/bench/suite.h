#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/device_scene/tuning.h"
#include "host/tools/bench/benchmark.h"
#include "host/vk/device.h"

namespace duolux {

/// The last parts of the names of a scene's benchmarks.
inline constexpr const char* kBenchmarkNames =
    "rays/{primary,diffuse,shadow,crossings}, render/PRESET/{path,light}, film/{path,light}, load, build, "
    "upload, start/{warm,cold}";

struct SuiteOptions {
    std::uint32_t width = 512, height = 512;  ///< of pictures, and of ray sets
    std::uint32_t spp = 16;                   ///< of pictures
    std::uint32_t bounces = 16;
    TuningChoice tuning;
    std::string program;            ///< path of duolux itself, for measuring its start; empty: not measured
    std::vector<std::string> only;  ///< only benchmarks whose name contains one of these; empty: all
};

/// All benchmarks of one scene. Throws InputError if it cannot be loaded.
class SceneSuite {
  public:
    /// `name` begins the names of its benchmarks. `folder`: for files that the benchmarks write.
    SceneSuite(Device& device, std::string name, const std::filesystem::path& scene, SuiteOptions options,
               std::filesystem::path folder);
    ~SceneSuite();
    SceneSuite(const SceneSuite&) = delete;
    SceneSuite& operator=(const SceneSuite&) = delete;

    /// The benchmarks; valid during the suite's lifetime. They change its scene, so only one may run at a
    /// time.
    const std::vector<Benchmark>& benchmarks() const;

    const Tuning& tuning() const;

    /// The loaded scene.
    const std::vector<std::filesystem::path>& files() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace duolux
