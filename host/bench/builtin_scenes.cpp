#include "host/bench/builtin_scenes.h"

#include <charconv>
#include <optional>
#include <string_view>

#include "host/base/file.h"
#include "host/scene/two_spheres.h"

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
    return {"cornell", "spot", "two-spheres-N"};
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

}  // namespace duolux
