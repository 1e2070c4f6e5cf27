#include "host/loaders/mtl_unused.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "host/base/printable.h"
#include "host/base/text.h"

namespace duolux {

namespace {

struct Name {
    std::string_view keyword;
    std::string_view other;  ///< spelling
};

// All statements that begin with "map_" are also textures.
constexpr Name kTextureNames[] = {
    {"map_Kd", ""},           {"map_Ks", ""},       {"map_Ke", ""},       {"map_Ns", ""},
    {"map_d", "map_Tr"},      {"map_Pr", ""},       {"map_Pm", ""},       {"map_Ps", ""},
    {"map_bump", "map_Bump"}, {"bump", ""},         {"norm", "map_norm"}, {"disp", "map_disp"},
    {"decal", "map_decal"},   {"refl", "map_refl"},
};

constexpr double kOpaque = 0.999;

/// Statements of the physically based extensions; 0 has no effect.
constexpr std::string_view kShineNames[] = {"Pm", "Ps", "Pc"};

/// Statements that do not affect a diffuse surface, or that are examined below.
constexpr std::string_view kKnown[] = {"Ka",    "Ks", "Ns",  "Ni",    "d",      "Tr",      "Tf",
                                       "illum", "Pr", "Pcr", "aniso", "anisor", "map_aat", "sharpness"};

/// The correct spelling of statements with an effect.
constexpr std::string_view kSpellings[] = {"newmtl", "Kd", "Ke"};

/// Smallest and largest of up to three numbers; empty if the first word is not a number (as in "spectral
/// FILE").
struct Range {
    double smallest, largest;
};
std::optional<Range> rangeOf(std::string_view arguments) {
    if (arguments.starts_with("-halo")) arguments = trimmed(arguments.substr(5));
    std::optional<Range> range;
    for (int i = 0; i < 3 && !arguments.empty(); ++i) {
        const std::string_view word = firstWord(arguments);
        const auto [past, value] = readNumber(word.data(), word.data() + word.size());
        if (past != word.data() + word.size() || !std::isfinite(value)) break;
        if (!range) range = Range{value, value};
        range = Range{std::min(range->smallest, value), std::max(range->largest, value)};
        arguments = trimmed(arguments.substr(word.size()));
    }
    return range;
}

bool isOneOf(std::string_view word, std::span<const std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool isTransparent(int illumination) {
    return illumination == 4 || illumination == 6 || illumination == 7 || illumination == 9;
}

}  // namespace

void MtlUnused::note(Group group, std::string_view keyword, std::size_t offset) {
    constexpr std::size_t kMost = 64;  // per material
    if (statements_.size() >= kMost) return;
    const auto same = [&](const Statement& statement) { return statement.keyword == keyword; };
    if (std::none_of(statements_.begin(), statements_.end(), same))
        statements_.push_back({group, keyword, offset});
}

void MtlUnused::add(std::string_view keyword, std::string_view arguments, std::size_t offset) {
    for (const auto& [name, other] : kTextureNames) {
        if (keyword == name || keyword == other) return note(kTextures, name, offset);
    }
    if (isOneOf(keyword, kShineNames)) {
        const std::optional<Range> range = rangeOf(arguments);
        if (range && range->largest > 0.0) note(kShine, keyword, offset);
        return;
    }
    if (!isOneOf(keyword, kKnown)) {
        const bool isTexture = lowerCase(keyword.substr(0, 4)) == "map_";
        return note(isTexture ? kTextures : kUnknown, keyword, offset);
    }
    const std::optional<Range> range = rangeOf(arguments);
    if (!range) return;
    const std::optional<double> number = range->largest;
    if (keyword == "d") {
        values_.dissolve = number;
        values_.dissolveAt = offset;
    } else if (keyword == "Tr") {
        values_.transparency = number;
        values_.transparencyAt = offset;
    } else if (keyword == "Tf") {
        values_.filter = number;
        values_.filterIsGrey = range->largest == range->smallest && (*number <= 0.0 || *number >= kOpaque);
        values_.filterAt = offset;
    } else if (keyword == "Ks") {
        values_.specular = number;
        values_.specularAt = offset;
    } else if (keyword == "illum") {
        values_.illumination = static_cast<int>(std::clamp(*number, 0.0, 10.0));
        values_.illuminationAt = offset;
    }
}

void MtlUnused::finishMaterial(bool counts) {
    const Values& v = values_;
    if (v.dissolve && *v.dissolve < kOpaque) note(kTransparency, "d", v.dissolveAt);
    // Some programs write Tr 1 together with d 1 for opaque materials; d takes precedence.
    if (v.transparency && *v.transparency > 1.0 - kOpaque && v.dissolve.value_or(0.0) < kOpaque) {
        note(kTransparency, "Tr", v.transparencyAt);
    }
    // Some programs write Tf 1 1 1 for every material.
    if (v.filter && (!v.filterIsGrey || (isTransparent(v.illumination) && *v.filter > 0.0))) {
        note(kTransparency, "Tf", v.filterAt);
    }
    if (isTransparent(v.illumination)) {
        note(kTransparency, "illum", v.illuminationAt);
    }
    // Blender writes 0.5 for every material. Models 0 and 1 have no highlights; those above 2 have
    // reflections.
    constexpr double kUsual = 0.5;
    const double specular = v.specular.value_or(0.0);
    if (v.illumination > 2 ? specular > 0.0 : v.illumination == 2 && specular > kUsual) {
        note(kShine, "Ks", v.specularAt);
    }
    if (counts) {
        std::array<bool, kGroups> inGroup{};
        for (const auto& [group, keyword, offset] : statements_) {
            Found& found = found_[group];
            if (found.materials == 0 && !inGroup[group]) found.first = offset;
            found.first = std::min(found.first, offset);
            found.materials += inGroup[group] ? 0 : 1;
            inGroup[group] = true;
            auto named = std::find_if(found.keywords.begin(), found.keywords.end(),
                                      [&](const Named& other) { return other.keyword == keyword; });
            constexpr std::size_t kMost = 12;
            found.more = found.more || (named == found.keywords.end() && found.keywords.size() >= kMost);
            if (named == found.keywords.end() && found.keywords.size() >= kMost) continue;
            if (named == found.keywords.end())
                named = found.keywords.insert(named, {std::string(keyword), 0});
            ++named->materials;
        }
    }
    values_ = Values();
    statements_.clear();
}

void MtlUnused::warn(const SourceText& text, std::vector<std::string>& warnings) const {
    constexpr const char* kWhat[kGroups] = {"textures are not read", "surfaces are opaque",
                                            "surfaces are diffuse", "not known"};
    for (std::size_t group = 0; group < kGroups; ++group) {
        const Found& found = found_[group];
        if (found.materials == 0) continue;
        std::string names;
        for (const auto& [keyword, materials] : found.keywords) {
            names += (names.empty() ? "" : ", ") + shortened(keyword);
            if (found.keywords.size() > 1) names += fmt::format(" ({})", materials);
        }
        if (found.more) names += " ...";
        std::string warning =
            fmt::format("{}: line {}: {}: {} of {} material{} ha{} no effect", text.file(),
                        text.lineOf(found.first), kWhat[group], names, found.materials,
                        found.materials == 1 ? "" : "s", found.keywords.size() == 1 ? "s" : "ve");
        if (group == kUnknown) {
            for (const std::string_view spelling : kSpellings) {
                if (lowerCase(found.keywords.front().keyword) == lowerCase(spelling))
                    warning += fmt::format("; did you mean {}?", spelling);
            }
        }
        warnings.push_back(std::move(warning));
    }
}

}  // namespace duolux
