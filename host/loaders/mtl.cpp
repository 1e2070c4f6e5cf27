#include "host/loaders/mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host/base/printable.h"
#include "host/loaders/mtl_images.h"
#include "host/loaders/mtl_map.h"
#include "host/loaders/mtl_material.h"
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
    kSpectrum,
    kColourCount,
    kNegative,
    kAboveOne,
    kNumber,
    kRange,
    kUnnamedImage,
    kMissingImage,
    kCount
};

constexpr OddityText<Oddity> kMtlOddities[] = {
    {Oddity::kBeforeMaterial, "a statement before any newmtl", "ignored"},
    {Oddity::kUnnamed, "newmtl without a name", "what follows it is ignored"},
    {Oddity::kColour, "a colour that is not finite", "read as if it were absent"},
    {Oddity::kSpectrum, "a colour as a spectrum or in CIE XYZ", "not supported; read as if it were absent"},
    {Oddity::kColourCount, "a colour that is not three numbers",
     "one number is grey, further ones are 0, a fourth is ignored"},
    {Oddity::kNegative, "a colour below 0", "read as 0"},
    {Oddity::kNumber, "a value that is not a finite number", "read as if it were absent"},
    {Oddity::kRange, "a value out of its range", "clamped"},
    {Oddity::kUnnamedImage, "an image without a name", "ignored"},
};

struct MtlColour {
    std::string_view keyword;
    std::optional<glm::dvec3> MtlValues::*value;
    double largest;
    bool mayBeOneNumber;
};
constexpr MtlColour kMtlColours[] = {
    {"Kd", &MtlValues::diffuse, kLargestRadiance, false},
    {"Ke", &MtlValues::emission, kLargestRadiance, false},
    {"Ks", &MtlValues::specular, 1.0, false},
    {"Tf", &MtlValues::filter, 1.0, false},
    {"Ps", &MtlValues::sheen, 1.0, true},
};

struct MtlNumber {
    std::string_view keyword;
    std::optional<double> MtlValues::*value;
    double smallest, largest;
};
constexpr MtlNumber kMtlNumbers[] = {
    {"Ns", &MtlValues::exponent, 0.0, 1e6},
    {"d", &MtlValues::dissolve, 0.0, 1.0},
    {"Tr", &MtlValues::transparency, 0.0, 1.0},
    {"Ni", &MtlValues::ior, 1.0, static_cast<double>(Material::kLargestIor)},
    {"illum", &MtlValues::illumination, 0.0, 10.0},
    {"Pr", &MtlValues::roughness, 0.0, 1.0},
    {"Pm", &MtlValues::metallic, 0.0, 1.0},
    {"Pc", &MtlValues::clearcoat, 0.0, 1.0},
    {"Pcr", &MtlValues::clearcoatRoughness, 0.0, 1.0},
    {"aniso", &MtlValues::anisotropy, -1.0, 1.0},
    {"anisor", &MtlValues::anisotropyRotation, -1e3, 1e3},
};

struct MtlImageStatement {
    std::string_view keyword;
    MtlImage image;
    ColourSpace colourSpace;  ///< of colours; numbers are linear
};
constexpr MtlImageStatement kMtlImages[] = {
    {"map_Kd", MtlImage::kDiffuse, ColourSpace::kSrgb},
    {"map_Ks", MtlImage::kSpecular, ColourSpace::kSrgb},
    {"map_Ke", MtlImage::kEmission, ColourSpace::kSrgb},
    {"map_d", MtlImage::kDissolve, ColourSpace::kLinear},
    {"map_Pr", MtlImage::kRoughness, ColourSpace::kLinear},
    {"map_Pm", MtlImage::kMetallic, ColourSpace::kLinear},
    {"map_Pc", MtlImage::kClearcoat, ColourSpace::kLinear},
    {"map_Pcr", MtlImage::kClearcoatRoughness, ColourSpace::kLinear},
    {"map_Ps", MtlImage::kSheen, ColourSpace::kSrgb},
    {"norm", MtlImage::kNormal, ColourSpace::kLinear},
    {"map_bump", MtlImage::kBump, ColourSpace::kLinear},
    {"map_Bump", MtlImage::kBump, ColourSpace::kLinear},
    {"bump", MtlImage::kBump, ColourSpace::kLinear},
    {"Bump", MtlImage::kBump, ColourSpace::kLinear},
    {"map_Ns", MtlImage::kExponent, ColourSpace::kLinear},
};

/// The statement of this keyword; null if there is none in the list.
template <typename Statement, std::size_t kCount>
const Statement* findStatement(const Statement (&statements)[kCount], std::string_view keyword) {
    const auto* const found =
        std::find_if(std::begin(statements), std::end(statements),
                     [&](const Statement& statement) { return statement.keyword == keyword; });
    return found == std::end(statements) ? nullptr : found;
}

class MtlReader {
  public:
    MtlReader(const std::filesystem::path& path, FileFinder& finder, Reading reading)
        : text_(path, "a Wavefront MTL file"), images_(path.parent_path(), finder), reading_(reading) {}

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
        library_.images = std::move(images_.sources());
        return std::move(library_);
    }

  private:
    void readLine(std::string_view line) {
        const std::string_view keyword = firstWord(line);
        const std::string_view arguments = trimmed(line.substr(keyword.size()));
        if (keyword.empty() || keyword.front() == '#') return;
        if (keyword == "newmtl") return begin(line, arguments);
        const auto* const colour = findStatement(kMtlColours, keyword);
        const auto* const number = findStatement(kMtlNumbers, keyword);
        const auto* const image = findStatement(kMtlImages, keyword);
        if (!inMaterial_) {
            const bool matters = keyword == "Kd" || keyword == "Ke" || keyword == "map_Kd";
            if (anyMaterial_) return;  // it belongs to a material without a name
            if (reading_ == Reading::kLenient || matters) {
                tolerate(Oddity::kBeforeMaterial, line, fmt::format("{} before any newmtl", keyword),
                         "expected \"newmtl NAME\" first");
            }
            return;
        }
        if (colour != nullptr) {
            readColour(line, *colour, arguments);
        } else if (number != nullptr) {
            readValue(line, *number, arguments);
        } else if (image != nullptr) {
            readImage(line, *image, arguments);
        } else {
            return unused_.add(keyword, offsetOf(line));
        }
        places_[keyword] = offsetOf(line);
    }

    void begin(std::string_view line, std::string_view name) {
        finishMaterial();
        anyMaterial_ = true;
        inMaterial_ = !name.empty();
        material_ = Material();
        values_ = MtlValues();
        places_.clear();
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
        for (const std::string_view keyword : mapMtl(values_, material_, images_)) {
            const auto place = places_.find(keyword);
            if (place != places_.end()) unused_.addInapplicable(keyword, place->second);
        }
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

    void readColour(std::string_view line, const MtlColour& statement, std::string_view arguments) {
        const std::string_view keyword = statement.keyword;
        const std::string remedy = fmt::format("expected \"{} r g b\"", keyword);
        const std::string_view kind = firstWord(arguments);
        if (kind == "spectral" || kind == "xyz") {
            return tolerate(Oddity::kSpectrum, line,
                            fmt::format("{}: \"{}\" colours are not supported", keyword, kind), remedy);
        }
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
        if (count != 3 && !(count == 1 && statement.mayBeOneNumber)) {
            tolerate(count == 0 ? Oddity::kColour : Oddity::kColourCount, line,
                     fmt::format("{}: {} numbers", keyword, count), remedy);
        }
        if (count == 0) return;
        if (count == 1) colour = glm::dvec3(colour.x);
        if (glm::all(glm::lessThanEqual(colour, glm::dvec3(statement.largest)))) {
            values_.*statement.value = colour;
        } else if (statement.largest > 1.0) {
            const TextProblem problem{offsetOf(line), fmt::format("{}: too large", keyword),
                                      fmt::format("expected numbers from 0 to {:g}", statement.largest)};
            if (reading_ == Reading::kStrict) text_.fail(problem);
            if (!tooLarge_) tooLarge_ = problem;
            return;
        } else {
            tolerateRange(line, keyword, 0.0, statement.largest);
            values_.*statement.value = glm::min(colour, glm::dvec3(statement.largest));
        }
        if (keyword == "Kd" && glm::any(glm::greaterThan(colour, glm::dvec3(1.0)))) {
            if (oddities_[Oddity::kAboveOne].count == 0) aboveOne_ = material_.name;
            oddities_.add(Oddity::kAboveOne, offsetOf(line));
        }
    }

    void readValue(std::string_view line, const MtlNumber& statement, std::string_view arguments) {
        constexpr std::string_view kHalo = "-halo";
        if (firstWord(arguments) == kHalo) {
            unused_.addOption(kHalo, offsetOf(line));
            arguments = trimmed(arguments.substr(kHalo.size()));
        }
        const std::string_view word = firstWord(arguments);
        const char* const end = word.data() + word.size();
        const auto [past, value] = readNumber(word.data(), end);
        if (past == nullptr || (past != end && *past != '#') || !std::isfinite(value)) {
            return tolerate(Oddity::kNumber, line,
                            fmt::format("{}: {} is not a finite number", statement.keyword, inQuotes(word)),
                            fmt::format("expected \"{} NUMBER\"", statement.keyword));
        }
        if (value < statement.smallest || value > statement.largest)
            tolerateRange(line, statement.keyword, statement.smallest, statement.largest);
        values_.*statement.value = std::clamp(value, statement.smallest, statement.largest);
    }

    void readImage(std::string_view line, const MtlImageStatement& statement, std::string_view arguments) {
        const MtlMap map = readMtlMap(arguments);
        for (const std::string_view option : map.unused)
            unused_.addOption(option, offsetOf(line));
        const bool isNormal = statement.image == MtlImage::kNormal;
        const bool isNumber = statement.colourSpace == ColourSpace::kLinear && !isNormal;
        const bool hasScale = isNormal || statement.image == MtlImage::kBump;
        if (map.hasChannel && !isNumber) unused_.addOption("-imfchan", offsetOf(line));
        if (map.scale != 1.0 && !hasScale) unused_.addOption("-bm", offsetOf(line));
        if (plainName(map.file).empty()) {
            return tolerate(Oddity::kUnnamedImage, line, fmt::format("{} names no image", statement.keyword),
                            fmt::format("expected \"{} FILE\"", statement.keyword));
        }
        const std::optional<std::uint32_t> image = images_.fileOf(map.file);
        if (!image) {
            if (oddities_[Oddity::kMissingImage].count == 0) missing_ = withSlashes(plainName(map.file));
            return tolerate(Oddity::kMissingImage, line,
                            fmt::format("there is no image {}", inQuotes(map.file)),
                            "expected the path of an image, relative to the MTL file");
        }
        MtlImageUse use;
        use.texture.image = *image;
        use.texture.colourSpace = statement.colourSpace;
        use.texture.wrapU = use.texture.wrapV = map.wrap;
        use.texture.filter = map.filter;
        use.texture.transform = map.transform;
        use.channel = isNumber ? map.channel : 0;
        use.hasChannel = map.hasChannel;
        use.scale = map.scale;
        use.base = map.base;
        use.gain = map.gain;
        values_.image(statement.image) = use;
    }

    void tolerateRange(std::string_view line, std::string_view keyword, double smallest, double largest) {
        tolerate(Oddity::kRange, line, fmt::format("{}: out of range", keyword),
                 fmt::format("expected {:g} to {:g}", smallest, largest));
    }

    void warn() {
        for (const auto& [kind, what, consequence] : kMtlOddities)
            warn(kind, what, consequence);
        warn(Oddity::kDefinedAgain, fmt::format("material {} is defined again", inQuotes(definedAgain_)),
             "the first one counts");
        warn(Oddity::kAboveOne, fmt::format("Kd of {} is above 1", inQuotes(aboveOne_)),
             "the surface reflects more light than it receives");
        warn(Oddity::kMissingImage, fmt::format("there is no image {}", inQuotes(missing_)),
             "materials are without it");
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
    MtlImages images_;
    const Reading reading_;
    MaterialLibrary library_;
    Tally<Oddity> oddities_;
    std::string definedAgain_, aboveOne_, missing_;  ///< the first of their kind
    MtlUnused unused_;
    Material material_;                               ///< the current one
    MtlValues values_;                                ///< of the current material
    std::map<std::string_view, std::size_t> places_;  ///< of the current material: offsets by keyword
    std::size_t definedAt_ = 0;                       ///< offset of the current material
    std::optional<TextProblem> tooLarge_;             ///< a colour of the current material that is too large
    bool inMaterial_ = false, anyMaterial_ = false;
};

}  // namespace

MaterialLibrary loadMtl(const std::filesystem::path& path, FileFinder& finder, Reading reading) {
    return MtlReader(path, finder, reading).run();
}

}  // namespace duolux
