#pragma once

#include <string>
#include <string_view>

namespace duolux {

/// Throws InputError where the header of an OpenEXR file claims more than the file can hold: OpenEXR
/// allocates what attributes, channels, tiles and the data window claim before it reads them. Whatever else
/// is wrong with a file is left to OpenEXR to tell.
void checkExrHeader(std::string_view bytes, const std::string& file);

}  // namespace duolux
