#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace duolux {

enum class PlyFormat : std::uint8_t { kAscii, kLittleEndian, kBigEndian };

enum class PlyType : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> countType = std::nullopt;  ///< an integer type: the property is a list

    bool isList() const { return countType.has_value(); }
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// The index of a property; empty if there is none. The first of several with the same name.
    std::optional<std::size_t> find(std::string_view property) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::kAscii;
    std::vector<PlyElement> elements;  ///< with unique names
    std::size_t bodyOffset = 0;        ///< bytes before the first element
    std::size_t lines = 0;
    std::vector<std::string> textures;       ///< named by comments, as VCG and MeshLab write
    std::optional<std::string> unknownLine;  ///< the first with an unknown keyword

    const PlyElement* find(std::string_view element) const;
};

/// Throws InputError if this is not the header of a PLY file.
PlyHeader readPlyHeader(const std::filesystem::path& path, std::string_view bytes);

/// In bytes.
std::size_t sizeOf(PlyType type);

/// The value that stands for 1 in a colour: the largest one of an integer type, 1 of the others.
double unitOf(PlyType type);

}  // namespace duolux
