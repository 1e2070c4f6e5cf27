#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/app/commands.h"
#include "host/app/info_json.h"
#include "host/app/machine_options.h"
#include "host/app/options.h"
#include "host/app/view_options.h"
#include "host/base/printable.h"
#include "host/base/utf8.h"
#include "host/cli/json.h"
#include "host/loaders/scene_file.h"
#include "host/scene/energy.h"
#include "host/scene/hash.h"
#include "host/view/load.h"

namespace duolux {

namespace {

std::string toText(const glm::dvec3& v) {
    return fmt::format("{:.6g}, {:.6g}, {:.6g}", v.x, v.y, v.z);
}

/// A place in the coordinates of the file.
std::string toText(const Scene& scene, const glm::vec3& place) {
    if (scene.origin == glm::dvec3(0.0)) return toText(place);
    const glm::dvec3 v = placeInFile(scene, place);
    return fmt::format("{}, {}, {}", v.x, v.y, v.z);
}

/// A single number if all channels are equal.
std::string colour(const glm::dvec3& c, int digits = 4) {
    if (c.x == c.y && c.y == c.z) return fmt::format("{:.{}g}", c.x, digits);
    return fmt::format("{0:.{3}g}, {1:.{3}g}, {2:.{3}g}", c.x, c.y, c.z, digits);
}

std::string withSeparators(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t at = digits.size(); at > 3; at -= 3)
        digits.insert(at - 3, ",");
    return digits;
}

std::string bytes(std::size_t count) {
    constexpr double kMebibyte = 1024.0 * 1024.0;
    const auto size = static_cast<double>(count);
    return size < 0.1 * kMebibyte ? fmt::format("{:.1f} KiB", size / 1024.0)
                                  : fmt::format("{:.1f} MiB", size / kMebibyte);
}

void printField(std::string_view name, std::string_view value) {
    fmt::print("{:<13}{}\n", name, value);
}

/// Prints a table whose columns are as wide as their widest cells. The first row is the heading.
void printTable(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], decodeUtf8(row[i]).size());
    }
    for (const auto& row : rows) {
        std::string line = " ";
        for (std::size_t i = 0; i < row.size(); ++i)
            line += fmt::format(" {:<{}} ", row[i], widths[i]);
        line.erase(line.find_last_not_of(' ') + 1);
        fmt::print("{}\n", line);
    }
}

std::string describe(const glm::vec3& value) {
    return colour(value);
}

std::string describe(const float& value) {
    return fmt::format("{:g}", value);
}

std::string describe(bool value) {
    return value ? "yes" : "no";
}

std::string describe(const Alpha& alpha) {
    return alpha.mode == AlphaMode::kMask ? fmt::format("mask {:g} at {:g}", alpha.value, alpha.cutoff)
                                          : fmt::format("{} {:g}", nameOf(alpha.mode), alpha.value);
}

std::string describe(const std::vector<MaterialTexture>& textures) {
    std::string names;
    for (const MaterialTexture& texture : textures)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", nameOf(texture.input));
    return names.empty() ? "-" : names;
}

std::string describe(const Sides& sides) {
    return nameOf(sides);
}

std::string describe(const Emission& emission) {
    if (!emission.any()) return "-";
    return fmt::format("inv {}; vis {}{}", colour(emission.invisible), colour(emission.visible),
                       emission.sides == Sides::kBoth ? "; both sides" : "");
}

std::string describe(const std::optional<Reflectance>& reflectance) {
    return reflectance ? describeReflectance(*reflectance) : "the scene's";
}

void printGeometry(const Scene& scene) {
    const Geometry& geometry = scene.geometry;
    const Bounds bounds = boundsOf(geometry);
    printField("triangles", withSeparators(geometry.triangles.size()));
    printField("vertices", withSeparators(geometry.positions.size()));
    if (!geometry.normals.empty()) {
        printField("smooth", fmt::format("{} triangles have shading normals",
                                         withSeparators(smoothTriangles(geometry))));
    }
    printField("bounds", fmt::format("{}  to  {}", toText(scene, bounds.lower), toText(scene, bounds.upper)));
    if (scene.origin != glm::dvec3(0.0)) {
        printField("origin", fmt::format("{}, {}, {}", scene.origin.x, scene.origin.y, scene.origin.z));
    }
    printField("memory", fmt::format("{} of geometry on the host", bytes(memoryOf(geometry))));
}

void printView(const LoadedScene& scene) {
    printField("camera", onOneLine(cameraOf(scene)));
    printField("picture",
               fmt::format("{}x{}, {} spp, {} bounces, seed {}", scene.settings.width, scene.settings.height,
                           scene.settings.spp, scene.settings.bounces, scene.settings.seed));
    printField("display", fmt::format("[{:g}, {:g}]", scene.display.x, scene.display.y));
    printField("reflectance", describeReflectance(scene.reflectance));
}

void printLights(const Scene& scene, const nlohmann::ordered_json& lamp) {
    const EmitterSummary lights = summariseEmitters(scene);
    const std::string points =
        lights.points > 0 ? fmt::format("; {} point{}", lights.points, lights.points == 1 ? "" : "s") : "";
    printField("lights",
               fmt::format("{} emitting triangle{}, area {:.6g}{}", withSeparators(lights.triangles),
                           lights.triangles == 1 ? "" : "s", lights.area, points));
    printField("power", fmt::format("invisible {}; visible {} (W in scene units)",
                                    colour(lights.invisiblePower, 6), colour(lights.visiblePower, 6)));
    if (!lamp.is_null()) printField("added lamp", onOneLine(lamp));
}

/// Shows the fields in which any of the materials differs from the default, and always the base colour.
void printMaterials(const Scene& scene) {
    std::vector<std::vector<std::string>> rows{{"material", "triangles"}};
    std::vector<std::string> defaults;
    forEachField(Material(), [&](const char* name, const auto& field) {
        rows.front().emplace_back(name);
        defaults.push_back(describe(field));
    });
    const std::vector<std::size_t> triangles = trianglesOfMaterials(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        std::vector<std::string>& row =
            rows.emplace_back(std::vector{shortened(material.name), withSeparators(triangles[i])});
        forEachField(material, [&](const char*, const auto& field) { row.push_back(describe(field)); });
    }
    constexpr std::size_t kAlways = 3;
    for (std::size_t column = rows.front().size(); column-- > kAlways;) {
        const bool isDefault = std::all_of(rows.begin() + 1, rows.end(), [&](const auto& row) {
            return row[column] == defaults[column - 2];
        });
        if (!isDefault) continue;
        for (std::vector<std::string>& row : rows)
            row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
    }
    fmt::print("\n");
    printTable(rows);
}

/// Prints which material returns the largest fraction of the light that it receives, and in which channel.
void printEnergy(const LoadedScene& scene) {
    const LargestFactor largest = largestFactor(scene);
    fmt::print("\n");
    printField("energy", fmt::format("mean albedo {} by area", colour(meanAlbedo(scene))));
    printField(
        "", fmt::format("one interaction returns at most {:.4g} of what arrives ({} in {}){}", largest.factor,
                        inQuotes(largest.material), largest.channel, largest.mayGrow ? "," : ""));
    if (largest.mayGrow) {
        printField("",
                   fmt::format("which may make light grow with every bounce; the picture shows {} bounces",
                               scene.settings.bounces));
    }
}

void printInfo(const LoadedScene& scene, const nlohmann::ordered_json& lamp) {
    printField("scene", printable(scene.source.string()));
    printField("hash", hashScene(scene));
    printGeometry(scene);
    printView(scene);
    printLights(scene, lamp);
    printMaterials(scene);
    printEnergy(scene);
    if (!scene.warnings.empty()) fmt::print("\n");
    for (const Warning& warning : scene.warnings)
        printField("warning", warning.text);
}

}  // namespace

void addInfoCommand(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("info", "Show what a scene file holds: triangles, materials, lights, energy");
    struct Options {
        std::string scene;
        ViewOptions view;
        bool json = false, strict = false;
    };
    const auto options = std::make_shared<Options>();
    command->add_option("SCENE", options->scene, fmt::format("The scene: {}", sceneExtensions()))->required();
    addViewOptions(*command, options->view);
    addStrictOption(*command, options->strict);
    addThreadsOption(*command);
    command->add_flag("--json", options->json, "As JSON, for scripts");
    command->callback([options] {
        SceneChoices choices = options->view.choices();
        if (options->strict) choices.reading = Reading::kStrict;
        LoadedScene scene = loadScene(options->scene, choices);
        const nlohmann::ordered_json lamp = addedLamp(scene);
        removeLamp(scene);
        if (options->json) {
            fmt::print("{}", jsonText(infoJson(scene, lamp)));
        } else {
            printInfo(scene, lamp);
        }
    });
}

}  // namespace duolux
