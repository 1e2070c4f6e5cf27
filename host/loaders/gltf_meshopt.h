#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "host/loaders/json_node.h"

namespace duolux {

/// What EXT_meshopt_compression says of a buffer view.
struct MeshoptView {
    enum class Mode { kAttributes, kTriangles, kIndices };
    enum class Filter { kNone, kOctahedral, kQuaternion, kExponential };

    std::size_t stride = 0, count = 0;
    Mode mode = Mode::kAttributes;
    Filter filter = Filter::kNone;
};

/// Reads the extension of a buffer view. Throws InputError.
MeshoptView readMeshoptView(const JsonNode& extension);

/// Decompresses to count * stride bytes. Throws InputError.
std::string decodeMeshopt(const JsonNode& extension, const MeshoptView& view, std::string_view bytes);

}  // namespace duolux
