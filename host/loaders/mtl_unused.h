#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "host/loaders/source_text.h"

namespace duolux {

/// Collects the statements of an MTL file that have no effect but would affect the image, or that are
/// unknown.
class MtlUnused {
  public:
    /// Adds a statement that the reader does not know, of the current material.
    void add(std::string_view keyword, std::size_t offset);
    /// Adds a statement that does not apply to the current material.
    void addInapplicable(std::string_view keyword, std::size_t offset) {
        note(kInapplicable, keyword, offset);
    }
    /// Adds an option of an image of the current material.
    void addOption(std::string_view option, std::size_t offset) { note(kOptions, option, offset); }

    /// Ends the current material; `counts`: whether it is used.
    void finishMaterial(bool counts);

    /// At most one warning for each kind.
    void warn(const SourceText& text, std::vector<std::string>& warnings) const;

  private:
    enum Group : std::size_t { kImages, kInapplicable, kOptions, kUnknown, kGroups };

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

    void note(Group group, std::string_view keyword, std::size_t offset);

    std::vector<Statement> statements_;  ///< of the current material
    std::array<Found, kGroups> found_;
};

}  // namespace duolux
