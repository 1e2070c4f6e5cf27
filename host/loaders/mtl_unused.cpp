#include "host/loaders/mtl_unused.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "host/base/printable.h"
#include "host/base/text.h"

namespace duolux {

namespace {

/// Statements that do not affect an image by path tracing.
constexpr std::string_view kNeutral[] = {"Ka", "sharpness", "map_aat"};

/// Images that are not used, and another spelling; all other statements that begin with "map_" are too.
struct ImageName {
    std::string_view keyword, other;
};
constexpr ImageName kUnusedImages[] = {{"disp", "map_disp"}, {"decal", "map_decal"}, {"refl", "map_refl"}};

/// The correct spelling of statements with an effect.
constexpr std::string_view kSpellings[] = {"newmtl", "Kd", "Ke", "Ks", "map_Kd", "map_d"};

}  // namespace

void MtlUnused::note(Group group, std::string_view keyword, std::size_t offset) {
    constexpr std::size_t kMost = 64;  // per material
    if (statements_.size() >= kMost) return;
    const auto same = [&](const Statement& statement) { return statement.keyword == keyword; };
    if (std::none_of(statements_.begin(), statements_.end(), same))
        statements_.push_back({group, keyword, offset});
}

void MtlUnused::add(std::string_view keyword, std::size_t offset) {
    if (std::find(std::begin(kNeutral), std::end(kNeutral), keyword) != std::end(kNeutral)) return;
    for (const auto& [name, other] : kUnusedImages) {
        if (keyword == name || keyword == other) return note(kImages, name, offset);
    }
    note(lowerCase(keyword.substr(0, 4)) == "map_" ? kImages : kUnknown, keyword, offset);
}

void MtlUnused::finishMaterial(bool counts) {
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
    statements_.clear();
}

void MtlUnused::warn(const SourceText& text, std::vector<std::string>& warnings) const {
    constexpr const char* kWhat[kGroups] = {"images of these kinds are not used",
                                            "does not apply to the material",
                                            "options of images are not used", "not known"};
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
        if (group == kUnknown || group == kImages) {
            for (const std::string_view spelling : kSpellings) {
                if (lowerCase(found.keywords.front().keyword) == lowerCase(spelling))
                    warning += fmt::format("; did you mean {}?", spelling);
            }
        }
        warnings.push_back(std::move(warning));
    }
}

}  // namespace duolux
