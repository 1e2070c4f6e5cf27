// Model files that nobody here wrote: those of Debian's package assimp-testmodels.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/view/load.h"
#include "tests/support/run_program.h"

namespace duolux::test {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = "/usr/share/assimp/models";

/// The output of a program about the package.
std::string dpkgQuery(std::vector<std::string> arguments) {
    arguments.emplace_back("assimp-testmodels");
    const ProgramResult result = runProgram("/usr/bin/dpkg-query", "/", std::move(arguments));
    EXPECT_EQ(result.status, 0) << result.err
                                << "expected the package assimp-testmodels, as ./quickstart installs it";
    return result.out;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

/// Major and minor version of the models.
using Version = std::pair<int, int>;

Version versionOf(const std::string& text) {
    std::istringstream in(text);
    Version version;
    char dot = 0;
    in >> version.first >> dot >> version.second;
    EXPECT_EQ(dot, '.') << text;
    return version;
}

bool isModel(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    static const std::set<std::string> kExtensions{".gltf", ".glb", ".obj", ".ply", ".stl"};
    return kExtensions.contains(extension);
}

/// Of the files in the package, relative to kModels.
std::set<std::string> modelsOfPackage() {
    std::set<std::string> models;
    for (const std::string& file : linesOf(dpkgQuery({"-L"}))) {
        if (isModel(file)) models.insert(fs::path(file).lexically_relative(kModels).string());
    }
    return models;
}

/// What becomes of files, as in assimp_models.txt, by the path. The lines after the first are indented.
using Outcomes = std::map<std::string, std::vector<std::string>>;

/// The outcomes that the list gives for this version of the package.
Outcomes listedOutcomes(const Version& version) {
    std::ifstream in(DUOLUX_ASSIMP_MODELS);
    EXPECT_TRUE(in.is_open());
    Outcomes outcomes;
    std::vector<std::string>* current = nullptr;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line.front() == '#') continue;
        if (line.front() == ' ') {
            if (current != nullptr) current->push_back(line);
            continue;
        }
        const std::size_t colon = line.find(": ");
        std::string name = line.substr(0, colon);
        const std::string since = " (since ";
        current = nullptr;
        if (const std::size_t at = name.find(since); at != std::string::npos) {
            if (version < versionOf(name.substr(at + since.size()))) continue;
            name.resize(at);
        }
        const auto [entry, isNew] = outcomes.try_emplace(name);
        EXPECT_TRUE(isNew) << name << " is listed twice";
        current = &entry->second;
        current->push_back(line.substr(colon + 2));
    }
    return outcomes;
}

/// Without the path of the file or its folder.
std::string withoutFolder(std::string message, const fs::path& file) {
    for (const std::string& prefix : {file.string() + ": ", file.parent_path().string() + "/"}) {
        for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
            message.erase(at, prefix.size());
    }
    return message;
}

std::vector<std::string> outcomeOf(const fs::path& file) {
    try {
        const LoadedScene scene = loadScene(file, {.lamp = Lamp::kNever});
        std::vector<std::string> lines{fmt::format("{} triangles", scene.content.triangles)};
        for (const Warning& warning : scene.warnings) {
            if (warning.kind != WarningKind::kBlackPicture)
                lines.push_back("  " + withoutFolder(warning.text, file));
        }
        return lines;
    } catch (const InputError& error) {
        return {"refused: " + withoutFolder(error.what(), file)};
    }
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += line + "\n";
    return text;
}

TEST(AssimpModels, HaveTheListedOutcomes) {
    const std::set<std::string> models = modelsOfPackage();
    const Version version = versionOf(dpkgQuery({"-W", "-f", "${Version}"}));
    const Outcomes outcomes = listedOutcomes(version);
    for (const auto& [name, outcome] : outcomes) {
        if (!models.contains(name)) ADD_FAILURE() << name << " is listed, but not in the package";
    }
    for (const std::string& name : models) {
        const std::string actual = name + ": " + joined(outcomeOf(kModels / name));
        const auto listed = outcomes.find(name);
        if (listed == outcomes.end()) {
            ADD_FAILURE() << "is in the package, but not listed:\n" << actual;
        } else {
            EXPECT_EQ(actual, name + ": " + joined(listed->second));
        }
    }
    EXPECT_GT(models.size(), 90u);
}

}  // namespace
}  // namespace duolux::test
