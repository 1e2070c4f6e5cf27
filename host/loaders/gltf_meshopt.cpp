#include "host/loaders/gltf_meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <array>
#include <limits>

namespace duolux {

namespace {

void checkStride(const JsonNode& stride, const MeshoptView& view) {
    if (view.mode != MeshoptView::Mode::kAttributes) {
        if (view.stride != 2 && view.stride != 4) stride.failValue("expected 2 or 4, the size of an index");
        return;
    }
    if (view.stride % 4 != 0) stride.failValue("expected a multiple of 4");
    const bool isOctahedral = view.filter == MeshoptView::Filter::kOctahedral;
    if (isOctahedral && view.stride != 4 && view.stride != 8) stride.failValue("expected 4 or 8");
    if (view.filter == MeshoptView::Filter::kQuaternion && view.stride != 8) stride.failValue("expected 8");
}

}  // namespace

MeshoptView readMeshoptView(const JsonNode& extension) {
    static const std::array<std::string, 3> kModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
    static const std::array<std::string, 4> kFilters{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
    constexpr std::uint32_t kLargestStride = 256, kMost = std::numeric_limits<std::int32_t>::max();
    MeshoptView view;
    const JsonNode stride = extension.require("byteStride", "expected the size of an element in bytes");
    const JsonNode count = extension.require("count", "expected the number of elements");
    const JsonNode mode = extension.require("mode", "expected \"ATTRIBUTES\", \"TRIANGLES\" or \"INDICES\"");
    view.stride = stride.integer(1, kLargestStride);
    view.count = count.integer(0, kMost);
    view.mode = static_cast<MeshoptView::Mode>(mode.choice(kModes));
    if (const auto filter = extension.find("filter")) {
        view.filter = static_cast<MeshoptView::Filter>(filter->choice(kFilters));
        if (view.filter != MeshoptView::Filter::kNone && view.mode != MeshoptView::Mode::kAttributes)
            filter->failValue("expected \"NONE\" in this mode");
    }
    checkStride(stride, view);
    if (view.mode == MeshoptView::Mode::kTriangles && view.count % 3 != 0)
        count.failValue("expected a multiple of 3");
    return view;
}

std::string decodeMeshopt(const JsonNode& extension, const MeshoptView& view, std::string_view bytes) {
    // More than the codecs achieve, so that damaged counts do not allocate much.
    constexpr std::size_t kLargestRatio = 4096;
    const bool isAttributes = view.mode == MeshoptView::Mode::kAttributes;
    const std::size_t size = view.stride * view.count;
    const auto fail = [&] {
        extension.fail("the compressed data is damaged", fmt::format("expected {} elements", view.count));
    };
    if (size / kLargestRatio > bytes.size()) fail();
    // As 32-bit words, for alignment.
    std::string decoded((size + 3) / 4 * 4, '\0');
    const auto* const source = reinterpret_cast<const unsigned char*>(bytes.data());
    int status = 0;
    if (isAttributes) {
        status = meshopt_decodeVertexBuffer(decoded.data(), view.count, view.stride, source, bytes.size());
    } else if (view.mode == MeshoptView::Mode::kTriangles) {
        status = meshopt_decodeIndexBuffer(decoded.data(), view.count, view.stride, source, bytes.size());
    } else {
        status = meshopt_decodeIndexSequence(decoded.data(), view.count, view.stride, source, bytes.size());
    }
    if (status != 0) fail();
    switch (view.filter) {
        case MeshoptView::Filter::kNone:
            break;
        case MeshoptView::Filter::kOctahedral:
            meshopt_decodeFilterOct(decoded.data(), view.count, view.stride);
            break;
        case MeshoptView::Filter::kQuaternion:
            meshopt_decodeFilterQuat(decoded.data(), view.count, view.stride);
            break;
        case MeshoptView::Filter::kExponential:
            meshopt_decodeFilterExp(decoded.data(), view.count, view.stride);
            break;
    }
    decoded.resize(size);
    return decoded;
}

}  // namespace duolux
