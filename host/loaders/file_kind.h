#pragma once

#include <filesystem>
#include <string_view>

#include "host/base/error.h"

namespace duolux {

/// The content of a file is of a different kind than its name says.
class ForeignFile : public InputError {
  public:
    using InputError::InputError;
};

/// Throws ForeignFile if the content of a file is evidently not `expected` (for example "a Wavefront OBJ
/// file") but something else, for example an archive, a web page or a Git LFS pointer.
void expectNoForeignFormat(const std::filesystem::path& path, std::string_view bytes,
                           std::string_view expected);

}  // namespace duolux
