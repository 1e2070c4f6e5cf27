#include "host/loaders/file_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "host/base/text.h"

namespace duolux {

namespace {

using namespace std::string_view_literals;

struct Signature {
    std::string_view bytes;
    std::string_view kind;
};

constexpr std::string_view kLfsRemedy = "expected the file itself, which \"git lfs pull\" fetches";

/// Binary formats, identified by their first bytes.
constexpr std::array kBinary{
    Signature{"PK\x03\x04"sv, "a zip archive"},
    Signature{"\x1F\x8B"sv, "compressed by gzip"},
    Signature{"BZh"sv, "compressed by bzip2"},
    Signature{"\xFD"
              "7zXZ\0"sv,
              "compressed by xz"},
    Signature{"\x28\xB5\x2F\xFD"sv, "compressed by zstd"},
    Signature{"7z\xBC\xAF\x27\x1C"sv, "a 7-Zip archive"},
    Signature{"Rar!\x1A\x07"sv, "a RAR archive"},
    Signature{"glTF"sv, "binary glTF"},
    Signature{"Kaydara FBX Binary"sv, "FBX"},
    Signature{"BLENDER"sv, "a Blender file"},
    Signature{"PXR-USDC"sv, "USD"},
    Signature{"\x89PNG"sv, "a PNG image"},
    Signature{"\xFF\xD8\xFF"sv, "a JPEG image"},
    Signature{"\x76\x2F\x31\x01"sv, "an OpenEXR image"},
    Signature{"%PDF"sv, "a PDF document"},
    Signature{"\x7F"
              "ELF"sv,
              "a compiled object file"},
    Signature{"\x64\x86"sv, "a compiled object file"},
    Signature{"\x4C\x01"sv, "a compiled object file"},
    Signature{"\xFF\xFE"sv, "UTF-16 text"},
    Signature{"\xFE\xFF"sv, "UTF-16 text"},
};

/// Text formats, identified by their first words in lower case, after white space.
constexpr std::array kText{
    Signature{"version https://git-lfs"sv, "a Git LFS pointer"},
    Signature{"<!doctype html"sv, "an HTML page"},
    Signature{"<html"sv, "an HTML page"},
    Signature{"<?xml"sv, "XML"},
    Signature{"<svg"sv, "SVG"},
    Signature{"<collada"sv, "COLLADA"},
    Signature{"#usda"sv, "USD"},
    Signature{"; fbx"sv, "FBX"},
    Signature{"# .pcd v"sv, "a PCD point cloud"},
    Signature{"#vrml v"sv, "VRML"},
};

/// Text formats, identified by a first word that starts no OBJ, MTL or JSON file.
constexpr std::array kWords{
    Signature{"ply"sv, "PLY"},  Signature{"off"sv, "OFF"},   Signature{"coff"sv, "OFF"},
    Signature{"noff"sv, "OFF"}, Signature{"cnoff"sv, "OFF"}, Signature{"stoff"sv, "OFF"},
    Signature{"4off"sv, "OFF"},
};

constexpr std::string_view kBlanks = " \t\r\n";

std::string lowerHead(std::string_view bytes) {
    constexpr std::size_t kHead = 1024;
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    const std::size_t first = bytes.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return lowerCase(bytes.substr(first, kHead));
}

bool isBinaryStl(std::string_view bytes) {
    constexpr std::size_t kHeader = 84, kFacet = 50;
    if (bytes.size() < kHeader) return false;
    std::uint32_t facets = 0;
    std::memcpy(&facets, bytes.data() + kHeader - sizeof facets, sizeof facets);
    return bytes.size() == kHeader + kFacet * facets && bytes.find('\0') != std::string_view::npos;
}

/// The first word: any characters except white space.
std::string_view wordAt(std::string_view text) {
    return text.substr(0, text.find_first_of(kBlanks));
}

std::string_view behind(std::string_view text, std::size_t count) {
    text.remove_prefix(count);
    return text.substr(std::min(text.find_first_not_of(kBlanks), text.size()));
}

/// Whether the file only contains a path to an object of git-annex.
bool isAnnexPointer(std::string_view head) {
    const std::string_view path = wordAt(head);
    return (path.starts_with('/') || path.starts_with('.')) &&
           path.find("annex/objects/") != std::string_view::npos;
}

/// Whether the file is DXF: pairs of a code and a value, starting with a section, possibly after comments.
bool isDxf(std::string_view head) {
    if (wordAt(head) == "999") return head.find("\nsection") != std::string_view::npos;
    return wordAt(head) == "0" && wordAt(behind(head, 1)) == "section";
}

/// Whether the file is glTF: "asset" with a "version", which a material named "asset" does not have.
bool isGltf(std::string_view head) {
    constexpr std::string_view kAsset = "\"asset\"";
    const std::size_t at = head.find(kAsset);
    if (!head.starts_with('{') || at == std::string_view::npos) return false;
    std::string_view rest = behind(head, at + kAsset.size());
    if (!rest.starts_with(':')) return false;
    rest = behind(rest, 1);
    return rest.starts_with('{') &&
           rest.substr(0, rest.find('}')).find("\"version\"") != std::string_view::npos;
}

/// Whether the file is Latin text with 16 bits per character and without a byte order mark.
bool isWideText(std::string_view bytes) {
    constexpr std::size_t kFewest = 8, kMost = 64;
    const std::size_t count = std::min(bytes.size(), kMost) / 2;
    std::size_t zerosFirst = 0, zerosSecond = 0;
    for (std::size_t i = 0; i < count; ++i) {
        zerosFirst += bytes[2 * i] == '\0' ? 1 : 0;
        zerosSecond += bytes[2 * i + 1] == '\0' ? 1 : 0;
    }
    return 2 * count >= kFewest && std::max(zerosFirst, zerosSecond) == count &&
           std::min(zerosFirst, zerosSecond) == 0;
}

/// The kind of the content; empty if it may be what the file's name says.
std::string_view foreignKind(std::string_view bytes, bool jsonExpected) {
    for (const Signature& signature : kBinary) {
        if (bytes.starts_with(signature.bytes)) return signature.kind;
    }
    if (isWideText(bytes)) return "UTF-16 text";
    const std::string head = lowerHead(bytes);
    for (const Signature& signature : kText) {
        if (head.starts_with(signature.bytes)) return signature.kind;
    }
    for (const Signature& signature : kWords) {
        if (wordAt(head) == signature.bytes) return signature.kind;
    }
    if (isAnnexPointer(head)) return "a git-annex pointer";
    if (isDxf(head)) return "DXF";
    if (isBinaryStl(bytes)) return "STL";
    if (head.starts_with("solid") && head.find("facet") != std::string::npos) return "STL";
    if (isGltf(head)) return "glTF";
    if (!jsonExpected && head.starts_with("{")) return "JSON";
    return {};
}

}  // namespace

void expectNoForeignFormat(const std::filesystem::path& path, std::string_view bytes,
                           std::string_view expected) {
    const std::string_view kind = foreignKind(bytes, expected.find("JSON") != std::string_view::npos);
    if (kind.empty() || expected.find(kind) != std::string_view::npos) return;
    const bool lfs = kind == kText.front().kind;
    throw ForeignFile(path.string(), "", fmt::format("is {}", kind),
                      lfs ? std::string(kLfsRemedy) : fmt::format("expected {}", expected));
}

}  // namespace duolux
