#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/loaders/json_node.h"
#include "host/loaders/tally.h"

namespace duolux {

/// What the reader of a glTF file noticed: one warning for each kind, with the first place and the count.
class GltfNotes {
  public:
    explicit GltfNotes(Reading reading) : strict_(reading == Reading::kStrict) {}

    /// An error that other programs accept. In strict reading it throws InputError. `problem` and
    /// `consequence` determine the kind.
    void tolerate(const JsonNode& node, std::string_view problem, std::string_view remedy,
                  std::string_view consequence);

    /// Something that has no effect on the picture although it should.
    void ignore(const JsonNode& node, std::string_view what, std::string_view consequence);

    /// Adds the warnings, in the order of their first occurrence.
    void warn(std::vector<std::string>& warnings) const;

  private:
    struct Note {
        std::string place, what, consequence;
        std::size_t count = 0;
    };

    bool strict_;
    std::vector<Note> notes_;
    std::map<std::pair<std::string, std::string>, std::size_t> indices_;
};

}  // namespace duolux
