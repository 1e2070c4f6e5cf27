#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/json_node.h"

namespace duolux {

/// The content of a primitive that Draco compressed.
struct DracoMesh {
    struct Attribute {
        std::vector<float> values;
        std::uint32_t components = 0;
    };
    std::vector<std::uint32_t> indices;           ///< three per triangle
    std::map<std::string, Attribute> attributes;  ///< by the name in the primitive
};

/// Decompresses `bytes` as the extension KHR_draco_mesh_compression of a primitive describes. Throws
/// InputError.
DracoMesh decodeDraco(const JsonNode& extension, std::string_view bytes);

}  // namespace duolux
