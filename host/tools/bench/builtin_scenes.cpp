#include "host/tools/bench/builtin_scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <optional>
#include <set>
#include <string_view>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/generators/two_spheres.h"

// The files, as bytes in the program. cmake/EmbedFiles.cmake generates it.
#include "duolux_bench_assets.h"

namespace duolux {

namespace {

constexpr std::string_view kTwoSpheres = "two-spheres-";

std::optional<std::size_t> trianglesOf(std::string_view name) {
    if (!name.starts_with(kTwoSpheres)) return std::nullopt;
    name.remove_prefix(kTwoSpheres.size());
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), count);
    if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
    if (count < kFewestTwoSpheresTriangles || count > kMostTwoSpheresTriangles) return std::nullopt;
    return count;
}

}  // namespace

std::vector<std::string> builtinSceneNames() {
    return {
        "cornell", "spot",
        fmt::format("two-spheres-N (N from {} to {})", kFewestTwoSpheresTriangles, kMostTwoSpheresTriangles)};
}

bool isBuiltinScene(const std::string& name) {
    return name == "cornell" || name == "spot" || trianglesOf(name).has_value();
}

std::filesystem::path writeBuiltinScene(const std::string& name, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    if (const auto triangles = trianglesOf(name)) {
        writeTwoSpheres(folder, *triangles);
        return folder / "two_spheres.json";
    }
    for (const EmbeddedFile& file : embeddedFiles()) {
        if (file.folder == name) writeFile(folder / file.name, file.bytes);
    }
    return folder / (name + ".json");
}

void checkBenchScenes(const std::vector<std::string>& scenes) {
    std::set<std::string> names;
    for (const std::string& scene : scenes) {
        if (!isBuiltinScene(scene) && !std::filesystem::exists(scene)) {
            throw UsageError(
                fmt::format("{} is neither a file nor a built-in scene; expected a scene file or one of {}",
                            scene, fmt::join(builtinSceneNames(), ", ")));
        }
        if (!names.insert(benchName(scene)).second) {
            throw UsageError(fmt::format("two scenes are called {}; expected names that tell results apart",
                                         benchName(scene)));
        }
    }
}

std::string benchName(const std::string& scene) {
    return isBuiltinScene(scene) ? scene : std::filesystem::path(scene).stem().string();
}

std::filesystem::path benchSceneFile(const std::string& scene, const std::filesystem::path& folder) {
    return isBuiltinScene(scene) ? writeBuiltinScene(scene, folder) : std::filesystem::path(scene);
}

}  // namespace duolux
