#include "host/loaders/stl_read.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <utility>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/printable.h"
#include "host/base/text.h"
#include "host/loaders/file_kind.h"
#include "host/loaders/source_text.h"

namespace duolux {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStlFile = "an STL file";

/// "1 facet", "2 facets".
std::string facetsOf(std::size_t count) {
    return fmt::format("{} facet{}", count, count == 1 ? "" : "s");
}

/// A header of 80 bytes, the number of facets, and 50 bytes for each facet (3D Systems, "StereoLithography
/// Interface Specification", 1988).
class BinaryStl {
  public:
    static constexpr std::size_t kHeader = 80, kFirst = 84, kFacet = 50;

    BinaryStl(const fs::path& path, std::string_view bytes, Reading reading)
        : path_(path), bytes_(bytes), strict_(reading == Reading::kStrict) {}

    static std::uint32_t statedCount(std::string_view bytes) {
        std::uint32_t count = 0;
        std::memcpy(&count, bytes.data() + kHeader, sizeof count);
        return count;
    }

    /// Whether the size is that of the facets that the header states.
    static bool hasItsSize(std::string_view bytes) {
        return bytes.size() >= kFirst && bytes.size() - kFirst == std::uint64_t{kFacet} * statedCount(bytes);
    }

    StlFacets run() {
        const std::size_t count = facetCount();
        facets_.corners.reserve(3 * count);
        facets_.normals.reserve(count);
        facets_.attributes.reserve(count);
        for (std::size_t i = 0; i < count; ++i)
            readFacet(i, count);
        readHeader();
        return std::move(facets_);
    }

  private:
    /// The count that the file states; if that is 0, the number of facets in the file.
    std::size_t facetCount() {
        if (bytes_.size() < kFirst) {
            throw InputError(path_.string(), "", fmt::format("is {} bytes", bytes_.size()),
                             "expected a text that begins with \"solid\", or at least 84 bytes");
        }
        const std::size_t stated = statedCount(bytes_), rest = bytes_.size() - kFirst;
        const std::size_t present = rest / kFacet;
        if (rest == kFacet * stated) return stated;
        const std::string problem =
            fmt::format("the header says {}, the file has room for {}", facetsOf(stated), present);
        const bool isUnstated = stated == 0 && rest % kFacet == 0;
        if (strict_ || (stated > present)) {
            throw InputError(path_.string(), "", problem, "expected 84 bytes and 50 for each facet");
        }
        facets_.warnings.push_back(fmt::format("{}: {}: {}", path_.string(), problem,
                                               isUnstated ? "all are read" : "the rest is ignored"));
        return isUnstated ? present : stated;
    }

    void readFacet(std::size_t index, std::size_t count) {
        std::array<float, 12> numbers{};
        std::uint16_t attribute = 0;
        const char* const at = bytes_.data() + kFirst + kFacet * index;
        std::memcpy(numbers.data(), at, sizeof numbers);
        std::memcpy(&attribute, at + sizeof numbers, sizeof attribute);
        facets_.normals.emplace_back(numbers[0], numbers[1], numbers[2]);
        for (std::size_t i = 3; i < numbers.size(); i += 3) {
            const glm::dvec3 corner(glm::vec3(numbers[i], numbers[i + 1], numbers[i + 2]));
            if (!(std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.z))) {
                throw InputError(path_.string(), fmt::format("facet {} of {}", index + 1, count),
                                 "a coordinate is not finite", "expected finite coordinates");
            }
            facets_.corners.push_back(corner);
        }
        facets_.attributes.push_back(attribute);
    }

    void readHeader() {
        const std::string_view header = bytes_.substr(0, kHeader);
        constexpr std::string_view kColour = "COLOR=", kMaterial = "MATERIAL=";
        const std::size_t at = header.find(kColour);
        if (at != std::string_view::npos && at + kColour.size() + 4 <= kHeader) {
            std::array<std::uint8_t, 3> colour{};
            std::memcpy(colour.data(), header.data() + at + kColour.size(), colour.size());
            facets_.colour = colour;
        }
        if (header.find(kMaterial) != std::string_view::npos) {
            facets_.warnings.push_back(
                fmt::format("{}: MATERIAL= in the header is not supported: ignored", path_.string()));
        }
    }

    const fs::path& path_;
    std::string_view bytes_;
    bool strict_;
    StlFacets facets_;
};

enum class StlOddity { kCorners, kNumber, kUnknown, kNoEnd, kCount };

constexpr OddityText<StlOddity> kStlOddities[] = {
    {StlOddity::kCorners, "a facet that does not have three vertices", "left out"},
    {StlOddity::kNumber, "a normal that is not three numbers", "ignored"},
    {StlOddity::kUnknown, "not a word of the format", "the rest of the line is ignored"},
    {StlOddity::kNoEnd, "the file ends without \"endsolid\"", "read as if it were complete"},
};

/// facet normal x y z, outer loop, vertex x y z (three times), endloop, endfacet; between solid and endsolid.
class TextStl {
  public:
    TextStl(const fs::path& path, Reading reading) : text_(path, kStlFile), reading_(reading) {}

    StlFacets run() {
        rest_ = text_.view();
        while (skipBlanks()) {
            const std::size_t at = offset();
            readWord(lowerCase(takeWord()), at);
        }
        const std::size_t end = text_.view().size() - 1;
        if (inFacet_) text_.fail({end, "the file ends within a facet", "expected \"endfacet\""});
        if (inSolid_) tolerate(StlOddity::kNoEnd, end, "the file ends here", "expected \"endsolid\"");
        for (const auto& [kind, what, consequence] : kStlOddities) {
            const auto& [count, first] = oddities_[kind];
            if (count == 0) continue;
            facets_.warnings.push_back(fmt::format("{}: line {}: {}{}: {}", text_.file(), text_.lineOf(first),
                                                   what, andMore(count), consequence));
        }
        return std::move(facets_);
    }

  private:
    std::size_t offset() const { return text_.view().size() - rest_.size(); }

    bool skipBlanks() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
        return !rest_.empty();
    }

    std::string_view takeWord() {
        const std::string_view word = firstWord(rest_);
        rest_.remove_prefix(word.size());
        return word;
    }

    void skipLine() { rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); }

    void readWord(const std::string& word, std::size_t at) {
        if (word == "vertex") {
            readVertex(at);
        } else if (word == "facet") {
            finishFacet();
            inFacet_ = true;
            facetAt_ = at;
            normal_ = glm::vec3(0.0f);
        } else if (word == "normal") {
            readNormal(at);
        } else if (word == "endfacet") {
            finishFacet();
        } else if (word == "solid" || word == "endsolid") {
            finishFacet();
            inSolid_ = word == "solid";
            skipLine();
        } else if (word != "outer" && word != "loop" && word != "endloop") {
            tolerate(StlOddity::kUnknown, at, fmt::format("{} is not a word of the format", inQuotes(word)),
                     "expected \"facet\", \"vertex\" ...");
            skipLine();
        }
    }

    /// Reads three numbers on this line, up to the first word that is none. Returns how many there are.
    int readNumbers(glm::dvec3& numbers) {
        int count = 0;
        for (; count < 3; ++count) {
            rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r"), rest_.size()));
            const std::string_view word = firstWord(rest_);
            const auto [past, value] = readNumber(word.data(), word.data() + word.size());
            if (word.empty() || past != word.data() + word.size()) break;
            numbers[count] = value;
            rest_.remove_prefix(word.size());
        }
        return count;
    }

    void readVertex(std::size_t at) {
        glm::dvec3 corner(0.0);
        const int count = readNumbers(corner);
        const char* const remedy = "expected \"vertex x y z\"";
        if (!inFacet_) text_.fail({at, "a vertex outside of a facet", "expected \"facet\" first"});
        if (count < 3) text_.fail({at, fmt::format("{} numbers", count), remedy});
        if (!(std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.z)))
            text_.fail({at, "a coordinate is not finite", remedy});
        corners_.push_back(corner);
    }

    void readNormal(std::size_t at) {
        glm::dvec3 normal(0.0);
        if (readNumbers(normal) == 3) {
            normal_ = glm::vec3(normal);
            return;
        }
        tolerate(StlOddity::kNumber, at, "the normal is not three numbers", "expected \"normal x y z\"");
        skipLine();
    }

    void finishFacet() {
        if (!inFacet_) return;
        inFacet_ = false;
        if (corners_.size() == 3) {
            facets_.corners.insert(facets_.corners.end(), corners_.begin(), corners_.end());
            facets_.normals.push_back(normal_);
        } else {
            tolerate(StlOddity::kCorners, facetAt_, fmt::format("a facet of {} vertices", corners_.size()),
                     "expected 3");
        }
        corners_.clear();
    }

    void tolerate(StlOddity oddity, std::size_t at, const std::string& problem, const char* remedy) {
        if (reading_ == Reading::kStrict) text_.fail({at, problem, remedy});
        oddities_.add(oddity, at);
    }

    const SourceText text_;
    const Reading reading_;
    std::string_view rest_;
    StlFacets facets_;
    Tally<StlOddity> oddities_;
    bool inSolid_ = false, inFacet_ = false;
    std::size_t facetAt_ = 0;
    glm::vec3 normal_{0.0f};
    std::vector<glm::dvec3> corners_;
};

/// Whether a file that does not have the size of a binary one begins as a text does.
bool isTextStl(std::string_view bytes) {
    constexpr std::size_t kHead = 1024;
    std::string_view head = bytes.substr(0, kHead);
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
    return lowerCase(trimmed(head)).starts_with("solid") && head.find('\0') == std::string_view::npos;
}

}  // namespace

StlFacets readStl(const fs::path& path, Reading reading) {
    {
        const std::string bytes = readFile(path);
        if (BinaryStl::hasItsSize(bytes)) return BinaryStl(path, bytes, reading).run();
        if (!isTextStl(bytes)) {
            expectNoForeignFormat(path, bytes, kStlFile);
            return BinaryStl(path, bytes, reading).run();
        }
    }
    return TextStl(path, reading).run();
}

}  // namespace duolux
