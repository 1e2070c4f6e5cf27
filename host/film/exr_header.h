#pragma once

#include <string>
#include <string_view>

namespace duolux {

/// Throws InputError if the header of an OpenEXR file claims more data than the file can hold: OpenEXR
/// allocates memory for the claimed attributes, channels, tiles and data window before it reads them. OpenEXR
/// reports all other errors.
void checkExrHeader(std::string_view bytes, const std::string& file);

}  // namespace duolux
