#pragma once

#include <cstddef>
#include <memory>

#include "host/scene/texture.h"

namespace duolux {

/// An image, and what its file says of the values.
struct DecodedImage {
    std::shared_ptr<const Image> image;
    bool linear = false;        ///< whatever the use of the image, the values are linear: HDR, OpenEXR
    std::size_t nonFinite = 0;  ///< values that were not finite; they are 0
};

/// Decodes an image by its content: PNG, JPEG, Radiance HDR, or OpenEXR with channels R, G, B, or Y, and A.
/// Samples of 16 bits become fractions of 65535. Converts the values as the source says. Throws InputError,
/// which names the source, if there is no such file, or if it is none of these or damaged. Allocates no more
/// than the file can fill.
DecodedImage decodeImage(const ImageSource& source);

}  // namespace duolux
