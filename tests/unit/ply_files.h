#pragma once

// PLY files for tests. The bytes are written one by one with shifts, not with the loader's own functions.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "host/loaders/ply.h"
#include "tests/unit/scene_files.h"

namespace duolux::test {

/// Writes values of a binary file.
class Bytes {
  public:
    explicit Bytes(bool bigEndian) : bigEndian_(bigEndian) {}

    Bytes& integer(std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i) {
            const int shift = 8 * (bigEndian_ ? size - 1 - i : i);
            text_.push_back(static_cast<char>(value >> shift & 0xff));
        }
        return *this;
    }
    Bytes& real(float value) { return integer(std::bit_cast<std::uint32_t>(value), 4); }
    Bytes& wide(double value) { return integer(std::bit_cast<std::uint64_t>(value), 8); }
    const std::string& text() const { return text_; }

  private:
    bool bigEndian_;
    std::string text_;
};

inline const char* formatName(bool bigEndian) {
    return bigEndian ? "binary_big_endian" : "binary_little_endian";
}

inline std::string header(const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

inline const std::string kCoordinates = "property float x\nproperty float y\nproperty float z\n";

/// A text with `vertices` lines and one list of corners per line of faces.
inline std::string ascii(int vertices, const std::string& vertexLines, int faces,
                         const std::string& faceLines) {
    return header("ascii", fmt::format("element vertex {}\n{}element face {}\n"
                                       "property list uchar int vertex_indices\n",
                                       vertices, kCoordinates, faces)) +
           vertexLines + faceLines;
}

inline const std::string kThree = "0 0 0\n1 0 0\n0 1 0\n";

class PlyTest : public SceneFiles {
  protected:
    /// The mesh as it is in the file, including triangles without area.
    Mesh mesh(const std::string& text, Reading reading = Reading::kLenient) const {
        MaterialFiles files(reading);
        return loadPly(write("mesh.ply", text), files);
    }

    std::vector<std::string> warningsOf(const std::string& text) const {
        std::vector<std::string> warnings = mesh(text).warnings;
        for (std::string& warning : warnings)
            warning.erase(0, folder_.string().size() + 1);
        return warnings;
    }

    std::string errorOfPly(const std::string& text, Reading reading = Reading::kLenient) const {
        write("mesh.ply", text);
        return errorOf("mesh.ply", reading);
    }
};

}  // namespace duolux::test
