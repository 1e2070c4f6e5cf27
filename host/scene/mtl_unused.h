#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/scene/source_text.h"

namespace duolux {

/// The statements of an MTL file that would change the picture, or are unknown, and have no effect. Those
/// that every exporter writes, and whose values say nothing special (d 1, illum 2, Ks 0.5), do not count.
class MtlUnused {
  public:
    /// A statement of the current material.
    void add(std::string_view keyword, std::string_view arguments, std::size_t offset);

    /// The current material is complete; `counts` if it is used.
    void finishMaterial(bool counts);

    /// At most four warnings: of textures, of transparency, of what shines, and of unknown statements.
    void warn(const SourceText& text, std::vector<std::string>& warnings) const;

  private:
    enum Group : std::size_t { kTextures, kTransparency, kShine, kUnknown, kGroups };

    struct Named {
        std::string keyword;
        std::size_t materials = 0;
    };
    struct Found {
        std::vector<Named> keywords;  ///< in the order of their first statements
        std::size_t materials = 0;
        std::size_t first = 0;  ///< offset of the first statement
        bool more = false;      ///< than `keywords` names
    };
    struct Statement {
        Group group;
        std::string_view keyword;
        std::size_t offset;
    };
    /// Values of the current material, where it gives them.
    struct Values {
        std::optional<double> dissolve, transparency, specular, filter;
        bool filterIsGrey = true;  ///< 0 or 1 in all channels
        int illumination = 2;
        std::size_t dissolveAt = 0, transparencyAt = 0, specularAt = 0, filterAt = 0, illuminationAt = 0;
    };

    void note(Group group, std::string_view keyword, std::size_t offset);

    Values values_;
    std::vector<Statement> statements_;  ///< of the current material
    std::array<Found, kGroups> found_;
};

}  // namespace duolux
