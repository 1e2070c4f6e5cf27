#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "host/loaders/json_node.h"

namespace duolux {

/// The text with %41 and the like replaced by the bytes that they stand for. A '%' without two hexadecimal
/// digits stays.
std::string decodePercent(std::string_view text);

/// Decodes base64 (RFC 4648), with or without padding. Empty if it is malformed.
std::optional<std::string> decodeBase64(std::string_view text);

/// Whether a URI holds its content (RFC 2397).
bool isDataUri(std::string_view uri);

/// The content of a data URI. Throws InputError.
std::string decodeDataUri(const JsonNode& uri);

/// The file that a URI, which is no data URI, refers to; it need not exist. The name may be percent-encoded
/// or not. Throws InputError if the URI cannot be a file.
std::filesystem::path pathOfUri(const JsonNode& uri);

}  // namespace duolux
