#include "host/loaders/ply_oddities.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/base/printable.h"
#include "host/loaders/tally.h"

namespace duolux {

namespace {

constexpr OddityText<PlyOddity> kPlyOddities[] = {
    {PlyOddity::kShortFace, "a face of fewer than 3 corners", "left out"},
    {PlyOddity::kBadFace, "a face with a vertex that is not in the file", "left out"},
    {PlyOddity::kUnusedVertex, "a vertex that is not finite or too large", "no face uses it"},
    {PlyOddity::kNormal, "a normal that is 0 or not finite", "the faces at this vertex are flat"},
    {PlyOddity::kColour, "a colour that is not between 0 and 1", "clamped"},
    {PlyOddity::kUv, "a texture coordinate that is not finite or too large",
     "the faces at this vertex have none"},
    {PlyOddity::kFaceUv, "a face whose texture coordinates are not two numbers for each corner, or too large",
     "it has none"},
};

}  // namespace

void PlyOddities::noteUnused(const PlyElement& element, const PlyProperty& property) {
    unused_.push_back(fmt::format("{} of {}", shortened(property.name), element.name));
}

void PlyOddities::warn(const std::filesystem::path& path, const PlyHeader& header,
                       std::vector<std::string>& warnings) const {
    const std::string file = path.string();
    for (const auto& [kind, what, consequence] : kPlyOddities) {
        const auto& [number, first] = found_[static_cast<std::size_t>(kind)];
        if (number == 0) continue;
        warnings.push_back(fmt::format("{}: {}: {}{}: {}", file, first, what, andMore(number), consequence));
    }
    if (overlongLines_ > 0) {
        warnings.push_back(fmt::format("{}: {} line{} more numbers than the header says: ignored", file,
                                       overlongLines_, overlongLines_ == 1 ? " has" : "s have"));
    }
    std::vector<std::string> unused = unused_;
    for (const PlyElement& element : header.elements) {
        if (element.name != "vertex" && element.name != "face")
            unused.push_back(fmt::format("element {}", shortened(element.name)));
    }
    if (!unused.empty()) {
        constexpr std::size_t kShown = 8;
        const std::size_t hidden = unused.size() - std::min(unused.size(), kShown);
        unused.resize(unused.size() - hidden);
        warnings.push_back(fmt::format("{}: not supported and ignored: {}{}", file, fmt::join(unused, ", "),
                                       hidden == 0 ? "" : fmt::format(" and {} more", hidden)));
    }
    if (header.unknownLine) {
        warnings.push_back(
            fmt::format("{}: {} in the header is unknown: ignored", file, inQuotes(*header.unknownLine)));
    }
}

}  // namespace duolux
