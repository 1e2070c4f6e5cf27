#include "host/loaders/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "host/base/error.h"
#include "host/base/printable.h"
#include "host/loaders/file_kind.h"
#include "host/loaders/source_text.h"

namespace duolux {

namespace {

struct TypeName {
    std::string_view name, alternative;
    PlyType type;
    std::size_t size;
    double unit;
};
constexpr TypeName kTypes[] = {
    {"char", "int8", PlyType::kInt8, 1, 127.0},         {"uchar", "uint8", PlyType::kUint8, 1, 255.0},
    {"short", "int16", PlyType::kInt16, 2, 32767.0},    {"ushort", "uint16", PlyType::kUint16, 2, 65535.0},
    {"int", "int32", PlyType::kInt32, 4, 2147483647.0}, {"uint", "uint32", PlyType::kUint32, 4, 4294967295.0},
    {"float", "float32", PlyType::kFloat, 4, 1.0},      {"double", "float64", PlyType::kDouble, 8, 1.0},
};

class HeaderReader {
  public:
    HeaderReader(const std::filesystem::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

    PlyHeader run() {
        if (!nextLine() || trimmed(line_) != "ply")
            fail("does not begin with \"ply\"", "expected a PLY file");
        bool hasFormat = false;
        while (true) {
            if (!nextLine()) fail("the header ends here", "expected \"end_header\"");
            const std::string_view keyword = takeWord();
            if (keyword == "end_header") break;
            if (keyword == "format") {
                readFormat();
                hasFormat = true;
            } else if (keyword == "element") {
                readElement();
            } else if (keyword == "property") {
                readProperty();
            } else if (keyword == "comment") {
                if (takeWord() == "TextureFile" && !trimmed(rest_).empty())
                    header_.textures.emplace_back(trimmed(rest_));
            } else if (!keyword.empty() && keyword != "obj_info" && !header_.unknownLine) {
                header_.unknownLine = keyword;
            }
        }
        if (!hasFormat) fail("the header has no format", "expected \"format ascii 1.0\" or a binary one");
        header_.bodyOffset = next_;
        return std::move(header_);
    }

  private:
    /// Lines end in "\n", "\r\n" or "\r". If the first one ends in "\r" alone, a "\n" behind that is data.
    bool nextLine() {
        const std::size_t end = bytes_.find_first_of("\r\n", next_);
        // The start of a binary file of another kind may be one long line.
        constexpr std::size_t kLongest = 1 << 16;
        if (end == std::string_view::npos || end - next_ > kLongest) return false;
        line_ = rest_ = bytes_.substr(next_, end - next_);
        const bool isPair = bytes_.substr(end).starts_with("\r\n");
        if (header_.lines++ == 0) endsByReturn_ = bytes_[end] == '\r' && !isPair;
        next_ = end + (isPair && !endsByReturn_ ? 2 : 1);
        return true;
    }

    std::string_view takeWord() {
        rest_ = trimmed(rest_);
        const std::string_view word = firstWord(rest_);
        rest_.remove_prefix(word.size());
        return word;
    }

    void readFormat() {
        const std::string_view name = takeWord();
        if (name == "ascii") {
            header_.format = PlyFormat::kAscii;
        } else if (name == "binary_little_endian") {
            header_.format = PlyFormat::kLittleEndian;
        } else if (name == "binary_big_endian") {
            header_.format = PlyFormat::kBigEndian;
        } else {
            fail(fmt::format("unknown format {}", inQuotes(name)),
                 "expected ascii, binary_little_endian or binary_big_endian");
        }
    }

    void readElement() {
        PlyElement element;
        element.name = takeWord();
        const std::string_view count = takeWord();
        const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (count.empty() || error != std::errc() || end != count.data() + count.size()) {
            fail(fmt::format("{} is not a count", inQuotes(count)), "expected \"element NAME COUNT\"");
        }
        if (header_.find(element.name) != nullptr) {
            fail(fmt::format("element {} is defined again", inQuotes(element.name)),
                 "expected names that differ");
        }
        header_.elements.push_back(std::move(element));
    }

    void readProperty() {
        if (header_.elements.empty())
            fail("a property before any element", "expected \"element NAME COUNT\"");
        PlyProperty property;
        const std::string_view word = takeWord();
        if (word == "list") {
            property.countType = typeOf(takeWord());
            if (*property.countType == PlyType::kFloat || *property.countType == PlyType::kDouble)
                fail("the length of a list is not an integer", "expected an integer type");
            property.type = typeOf(takeWord());
        } else {
            property.type = typeOf(word);
        }
        property.name = takeWord();
        if (property.name.empty()) fail("a property without a name", "expected \"property TYPE NAME\"");
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType typeOf(std::string_view word) const {
        for (const auto& [name, alternative, type, size, unit] : kTypes) {
            if (word == name || word == alternative) return type;
        }
        fail(fmt::format("unknown type {}", inQuotes(word)),
             "expected char, uchar, short, ushort, int, uint, float or double");
    }

    [[noreturn]] void fail(std::string_view problem, std::string_view remedy) const {
        throw InputError(path_.string(), fmt::format("line {}", std::max<std::size_t>(header_.lines, 1)),
                         problem, remedy);
    }

    const std::filesystem::path& path_;
    std::string_view bytes_;
    std::string_view line_, rest_;
    std::size_t next_ = 0;
    bool endsByReturn_ = false;
    PlyHeader header_;
};

}  // namespace

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const PlyProperty& candidate) { return candidate.name == property; });
    if (found == properties.end()) return std::nullopt;
    return static_cast<std::size_t>(found - properties.begin());
}

const PlyElement* PlyHeader::find(std::string_view element) const {
    const auto found = std::find_if(elements.begin(), elements.end(),
                                    [&](const PlyElement& candidate) { return candidate.name == element; });
    return found == elements.end() ? nullptr : &*found;
}

PlyHeader readPlyHeader(const std::filesystem::path& path, std::string_view bytes) {
    expectNoForeignFormat(path, bytes, "a PLY file");
    return HeaderReader(path, bytes).run();
}

std::size_t sizeOf(PlyType type) {
    return kTypes[static_cast<std::size_t>(type)].size;
}

double unitOf(PlyType type) {
    return kTypes[static_cast<std::size_t>(type)].unit;
}

}  // namespace duolux
