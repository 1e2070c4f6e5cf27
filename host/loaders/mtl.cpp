#include "host/loaders/mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/printable.h"
#include "host/loaders/mtl_unused.h"
#include "host/loaders/source_text.h"
#include "host/loaders/tally.h"
#include "host/scene/mesh.h"

namespace duolux {

namespace {

/// Errors that do not prevent a file from being loaded.
enum class Oddity {
    kBeforeMaterial,
    kUnnamed,
    kDefinedAgain,
    kColour,
    kColourCount,
    kNegative,
    kAboveOne,
    kCount
};

constexpr OddityText<Oddity> kMtlOddities[] = {
    {Oddity::kBeforeMaterial, "a statement before any newmtl", "ignored"},
    {Oddity::kUnnamed, "newmtl without a name", "what follows it is ignored"},
    {Oddity::kColour, "a colour that is not finite", "read as if it were absent"},
    {Oddity::kColourCount, "a colour that is not three numbers",
     "one number is grey, further ones are 0, a fourth is ignored"},
    {Oddity::kNegative, "a colour below 0", "read as 0"},
};

class MtlReader {
  public:
    MtlReader(const std::filesystem::path& path, Reading reading)
        : text_(path, "a Wavefront MTL file"), reading_(reading) {}

    MaterialLibrary run() {
        const std::string_view all = text_.view();
        for (std::size_t begin = 0; begin < all.size();) {
            const std::size_t end = all.find('\n', begin);
            readLine(trimmed(all.substr(begin, end - begin)));
            begin = end + 1;
        }
        finishMaterial();
        if (!anyMaterial_) library_.warnings.push_back(fmt::format("{}: defines no material", text_.file()));
        warn();
        return std::move(library_);
    }

  private:
    void readLine(std::string_view line) {
        const std::string_view keyword = firstWord(line);
        const std::string_view arguments = trimmed(line.substr(keyword.size()));
        if (keyword.empty() || keyword.front() == '#') return;
        if (keyword == "newmtl") return begin(line, arguments);
        const bool isColour = keyword == "Kd" || keyword == "Ke";
        if (!inMaterial_) {
            const bool matters = isColour || keyword == "map_Kd";
            if (anyMaterial_) return;  // it belongs to a material without a name
            if (reading_ == Reading::kLenient || matters) {
                tolerate(Oddity::kBeforeMaterial, line, fmt::format("{} before any newmtl", keyword),
                         "expected \"newmtl NAME\" first");
            }
        } else if (isColour) {
            readColour(line, keyword, arguments);
        } else {
            unused_.add(keyword, arguments, offsetOf(line));
        }
    }

    void begin(std::string_view line, std::string_view name) {
        finishMaterial();
        anyMaterial_ = true;
        inMaterial_ = !name.empty();
        material_ = Material();
        tooLarge_.reset();
        material_.name = name;
        definedAt_ = offsetOf(line);
        if (name.empty()) tolerate(Oddity::kUnnamed, line, "names no material", "expected \"newmtl NAME\"");
    }

    void finishMaterial() {
        if (!inMaterial_) return;
        inMaterial_ = false;
        const auto index = static_cast<std::uint32_t>(library_.materials.size());
        const bool isNew = library_.byName.try_emplace(material_.name, index).second;
        unused_.finishMaterial(isNew);
        if (isNew) {
            library_.byPlainName.try_emplace(std::string(plainName(material_.name)), index);
            if (tooLarge_) library_.unusable.emplace(index, text_.error(*tooLarge_));
            library_.materials.push_back(std::move(material_));
            return;
        }
        if (oddities_[Oddity::kDefinedAgain].count == 0) definedAgain_ = material_.name;
        tolerate(Oddity::kDefinedAgain, text_.view().substr(definedAt_),
                 fmt::format("material {} is defined again", inQuotes(material_.name)),
                 "expected names that differ");
    }

    void readColour(std::string_view line, std::string_view keyword, std::string_view arguments) {
        const std::string remedy = fmt::format("expected \"{} r g b\"", keyword);
        glm::dvec3 colour(0.0);
        int count = 0;
        for (std::string_view rest = arguments; !rest.empty() && rest.front() != '#';) {
            const std::string_view word = firstWord(rest);
            const char* const end = word.data() + word.size();
            const auto [past, value] = readNumber(word.data(), end);
            const bool isLast = past != nullptr && past != end && *past == '#';
            if (!(past == end || isLast) || !std::isfinite(value)) {
                return tolerate(Oddity::kColour, line,
                                fmt::format("{}: {} is not a finite number", keyword, inQuotes(word)),
                                remedy);
            }
            if (value < 0.0) {
                tolerate(Oddity::kNegative, line, fmt::format("{}: {} is negative", keyword, shortened(word)),
                         "expected numbers >= 0");
            }
            if (count < 3) colour[count] = std::max(value, 0.0);
            ++count;
            if (isLast) break;
            rest = trimmed(rest.substr(word.size()));
        }
        if (count != 3) {
            tolerate(count == 0 ? Oddity::kColour : Oddity::kColourCount, line,
                     fmt::format("{}: {} numbers", keyword, count), remedy);
        }
        if (count == 0) return;
        if (count == 1) colour = glm::dvec3(colour.x);
        setColour(line, keyword == "Kd", colour);
    }

    void setColour(std::string_view line, bool diffuse, const glm::dvec3& colour) {
        if (!glm::all(glm::lessThanEqual(colour, glm::dvec3(kLargestRadiance)))) {
            const TextProblem problem{offsetOf(line), diffuse ? "Kd: too large" : "Ke: too large",
                                      fmt::format("expected numbers from 0 to {:g}", kLargestRadiance)};
            if (reading_ == Reading::kStrict) text_.fail(problem);
            if (!tooLarge_) tooLarge_ = problem;
            return;
        }
        if (!diffuse) {
            material_.emission = {glm::vec3(colour), glm::vec3(colour), Sides::kFront};
            return;
        }
        material_.baseColor = glm::vec3(colour);
        if (glm::any(glm::greaterThan(material_.baseColor, glm::vec3(1.0f)))) {
            if (oddities_[Oddity::kAboveOne].count == 0) aboveOne_ = material_.name;
            oddities_.add(Oddity::kAboveOne, offsetOf(line));
        }
    }

    void warn() {
        for (const auto& [kind, what, consequence] : kMtlOddities)
            warn(kind, what, consequence);
        warn(Oddity::kDefinedAgain, fmt::format("material {} is defined again", inQuotes(definedAgain_)),
             "the first one counts");
        warn(Oddity::kAboveOne, fmt::format("Kd of {} is above 1", inQuotes(aboveOne_)),
             "the surface reflects more light than it receives");
        unused_.warn(text_, library_.warnings);
    }

    void warn(Oddity kind, std::string_view what, std::string_view consequence) {
        const auto& [count, first] = oddities_[kind];
        if (count == 0) return;
        library_.warnings.push_back(fmt::format("{}: line {}: {}{}: {}", text_.file(), text_.lineOf(first),
                                                what, andMore(count), consequence));
    }

    void tolerate(Oddity oddity, std::string_view line, const std::string& problem,
                  const std::string& remedy) {
        if (reading_ == Reading::kStrict) text_.fail({offsetOf(line), problem, remedy});
        oddities_.add(oddity, offsetOf(line));
    }

    std::size_t offsetOf(std::string_view line) const {
        return static_cast<std::size_t>(line.data() - text_.view().data());
    }

    const SourceText text_;
    const Reading reading_;
    MaterialLibrary library_;
    Tally<Oddity> oddities_;
    std::string definedAgain_, aboveOne_;  ///< the first of their kind
    MtlUnused unused_;
    Material material_;                    ///< the current one
    std::size_t definedAt_ = 0;            ///< offset of the current material
    std::optional<TextProblem> tooLarge_;  ///< a colour of the current material that is too large
    bool inMaterial_ = false, anyMaterial_ = false;
};

}  // namespace

MaterialLibrary loadMtl(const std::filesystem::path& path, Reading reading) {
    return MtlReader(path, reading).run();
}

}  // namespace duolux
