#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/source_text.h"

namespace duolux {

/// Collects the statements of an MTL file that are not supported but would affect the image, or that are
/// unknown. Default values that exporters write for every material (d 1, illum 2, Ks 0.5) are ignored.
class MtlUnused {
  public:
    /// Adds a statement of the current material.
    void add(std::string_view keyword, std::string_view arguments, std::size_t offset);

    /// Ends the current material; `counts`: whether it is used.
    void finishMaterial(bool counts);

    /// At most four warnings: about textures, transparency, non-diffuse reflection, and unknown statements.
    void warn(const SourceText& text, std::vector<std::string>& warnings) const;

  private:
    enum Group : std::size_t { kTextures, kTransparency, kShine, kUnknown, kGroups };

    struct Named {
        std::string keyword;
        std::size_t materials = 0;
    };
    struct Found {
        std::vector<Named> keywords;  ///< in the order of first occurrence
        std::size_t materials = 0;
        std::size_t first = 0;  ///< offset of the first statement
        bool more = false;      ///< whether there are more than in `keywords`
    };
    struct Statement {
        Group group;
        std::string_view keyword;
        std::size_t offset;
    };
    /// Values that the current material specifies.
    struct Values {
        std::optional<double> dissolve, transparency, specular, filter;
        bool filterIsGrey = true;  ///< Tf is 0 or 1 in all channels
        int illumination = 2;
        std::size_t dissolveAt = 0, transparencyAt = 0, specularAt = 0, filterAt = 0, illuminationAt = 0;
    };

    void note(Group group, std::string_view keyword, std::size_t offset);

    Values values_;
    std::vector<Statement> statements_;  ///< of the current material
    std::array<Found, kGroups> found_;
};

}  // namespace duolux
