#include "host/scene/mtl.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "host/base/error.h"
#include "host/base/printable.h"
#include "host/scene/mesh.h"
#include "host/scene/source_text.h"

namespace duolux {

namespace {

/// What a check of the text tells about one `newmtl`, beside the values that the parser reads.
struct Definition {
    std::string name;
    std::size_t diffuseAt = 0, emissionAt = 0;  ///< offsets of Kd and Ke
    bool hasDiffuse = false, hasEmission = false, hasTexture = false;
};

void checkColour(const SourceText& text, std::string_view line, std::string_view keyword) {
    const char* const begin = text.view().data();
    const auto offset = static_cast<std::size_t>(line.data() - begin);
    const std::string remedy = fmt::format("expected \"{} r g b\"", keyword);
    std::string_view rest = trimmed(line.substr(keyword.size()));
    int numbers = 0;
    while (!rest.empty() && rest.front() != '#') {
        const std::string_view word = firstWord(rest);
        const char* const end = word.data() + word.size();
        if (skipDecimalNumber(word.data(), end) != end) {
            text.fail(
                {offset, fmt::format("{}: {} is not a finite number", keyword, inQuotes(word)), remedy});
        }
        if (word.front() == '-' && word.find_first_of("123456789") != std::string_view::npos) {
            text.fail({offset, fmt::format("{}: {} is negative", keyword, word), "expected numbers >= 0"});
        }
        rest = trimmed(rest.substr(word.size()));
        ++numbers;
    }
    if (numbers != 3) text.fail({offset, fmt::format("{}: {} numbers", keyword, numbers), remedy});
}

struct Statements {
    std::vector<Definition> definitions;
    std::string text;  ///< the lines that matter
};

/// Checks the statements that are used, so that the parser can only read them one way.
Statements checkStatements(const SourceText& text) {
    Statements statements;
    std::vector<Definition>& definitions = statements.definitions;
    const std::string_view all = text.view();
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = all.find('\n', begin);
        const std::string_view line = trimmed(all.substr(begin, end - begin));
        begin = end + 1;
        const std::string_view keyword = firstWord(line);
        const auto offset = static_cast<std::size_t>(line.data() - all.data());
        if (keyword == "newmtl") {
            definitions.emplace_back().name = trimmed(line.substr(keyword.size()));
            if (definitions.back().name.empty())
                text.fail({offset, "names no material", "expected \"newmtl NAME\""});
        } else if (keyword == "Kd" || keyword == "Ke" || keyword == "map_Kd") {
            if (definitions.empty()) {
                text.fail(
                    {offset, fmt::format("{} before any newmtl", keyword), "expected \"newmtl NAME\" first"});
            }
            Definition& definition = definitions.back();
            if (keyword == "map_Kd") {
                definition.hasTexture = true;
                continue;
            }
            checkColour(text, line, keyword);
            (keyword == "Kd" ? definition.hasDiffuse : definition.hasEmission) = true;
            (keyword == "Kd" ? definition.diffuseAt : definition.emissionAt) = offset;
        } else {
            continue;
        }
        statements.text += fmt::format("{}\n", line);
    }
    return statements;
}

std::vector<tinyobj::material_t> parse(const std::string& text) {
    std::istringstream stream(text);
    std::map<std::string, int> indices;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    tinyobj::LoadMtl(&indices, &materials, &stream, &warning, &error);
    return materials;
}

glm::vec3 toVec3(const tinyobj::real_t (&values)[3]) {
    return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
}

Material toMaterial(const SourceText& text, const Definition& definition, const tinyobj::material_t& parsed) {
    Material material;
    material.name = definition.name;
    if (definition.hasDiffuse) material.diffuse = toVec3(parsed.diffuse);
    // Written so that it fails for what is not a number, too.
    if (!glm::all(glm::lessThanEqual(material.diffuse, glm::vec3(kLargestRadiance)))) {
        text.fail({definition.diffuseAt, "Kd: too large", "expected numbers from 0 to 1"});
    }
    if (definition.hasEmission) {
        const glm::vec3 emission = toVec3(parsed.emission);
        if (!glm::all(glm::lessThanEqual(emission, glm::vec3(kLargestRadiance)))) {
            text.fail({definition.emissionAt, "Ke: too large",
                       fmt::format("expected numbers from 0 to {:g}", kLargestRadiance)});
        }
        material.emission = {emission, emission, Sides::kFront};
    }
    return material;
}

}  // namespace

MaterialLibrary loadMtl(const std::filesystem::path& path) {
    const SourceText text(path);
    const Statements statements = checkStatements(text);
    const std::vector<Definition>& definitions = statements.definitions;
    MaterialLibrary library;
    if (definitions.empty()) {
        library.warnings.push_back(fmt::format("{}: defines no material", text.file()));
        return library;
    }
    const std::vector<tinyobj::material_t> parsed = parse(statements.text);
    if (parsed.size() != definitions.size()) {
        throw InputError(text.file(), "", "was not understood", "expected a Wavefront MTL file");
    }
    std::set<std::string> names;
    std::size_t textures = 0;
    for (std::size_t i = 0; i < definitions.size(); ++i) {
        if (!names.insert(definitions[i].name).second) {
            library.warnings.push_back(fmt::format("{}: material {} is defined again; the first one counts",
                                                   text.file(), inQuotes(definitions[i].name)));
            continue;
        }
        const Material material = toMaterial(text, definitions[i], parsed[i]);
        if (glm::any(glm::greaterThan(material.diffuse, glm::vec3(1.0f)))) {
            library.warnings.push_back(fmt::format(
                "{}: line {}: Kd of {} is above 1: the surface reflects more light than it receives",
                text.file(), text.lineOf(definitions[i].diffuseAt), inQuotes(material.name)));
        }
        textures += definitions[i].hasTexture ? 1 : 0;
        library.materials.push_back(material);
    }
    if (textures > 0) {
        library.warnings.push_back(
            fmt::format("{}: textures are not read: map_Kd of {} material{} has no effect", text.file(),
                        textures, textures == 1 ? "" : "s"));
    }
    return library;
}

}  // namespace duolux
