#pragma once

#include <filesystem>
#include <string_view>

#include "host/base/error.h"

namespace duolux {

/// A file whose content is of another kind than its name says.
class ForeignFile : public InputError {
  public:
    using InputError::InputError;
};

/// Throws ForeignFile if the content of a file is evidently not text of `expected`, such as "a Wavefront OBJ
/// file", but for example an archive, a web page or the pointer that Git LFS leaves in place of a file.
void expectNoForeignFormat(const std::filesystem::path& path, std::string_view bytes,
                           std::string_view expected);

}  // namespace duolux
