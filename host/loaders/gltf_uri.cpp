#include "host/loaders/gltf_uri.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "host/base/text.h"
#include "host/loaders/material_files.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

constexpr const char* kUriRemedy = "expected a data URI or the path of a file, relative to the glTF file";

/// The value of a hexadecimal digit; empty if it is none.
std::optional<unsigned> hexDigit(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
    if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
    return std::nullopt;
}

constexpr std::uint8_t kNoDigit = 64;

constexpr std::array<std::uint8_t, 256> base64Digits() {
    std::array<std::uint8_t, 256> digits{};
    digits.fill(kNoDigit);
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kDigits.size(); ++i)
        digits[static_cast<unsigned char>(kDigits[i])] = static_cast<std::uint8_t>(i);
    return digits;
}

/// The scheme of a URI ("https"); empty if it is relative. A single letter is a drive.
std::string_view schemeOf(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon < 2) return {};
    const std::string_view scheme = uri.substr(0, colon);
    const bool isScheme = scheme.find_first_not_of(
                              "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                              "0123456789+-.") == std::string_view::npos;
    return isScheme ? scheme : std::string_view();
}

}  // namespace

std::string decodePercent(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size()) {
            const auto high = hexDigit(text[i + 1]), low = hexDigit(text[i + 2]);
            if (high && low) {
                decoded.push_back(static_cast<char>(16 * *high + *low));
                i += 2;
                continue;
            }
        }
        decoded.push_back(text[i]);
    }
    return decoded;
}

std::optional<std::string> decodeBase64(std::string_view text) {
    static constexpr std::array<std::uint8_t, 256> kDigits = base64Digits();
    for (int i = 0; i < 2 && text.ends_with('='); ++i)
        text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::string decoded;
    decoded.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::uint8_t digit = kDigits[static_cast<unsigned char>(c)];
        if (digit == kNoDigit) return std::nullopt;
        bits = (bits << 6u) | digit;
        count += 6;
        if (count >= 8) {
            count -= 8;
            decoded.push_back(static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xffu));
        }
    }
    return decoded;
}

bool isDataUri(std::string_view uri) {
    return lowerCase(uri.substr(0, 5)) == "data:";
}

std::string decodeDataUri(const JsonNode& node) {
    const std::string_view uri = node.text(kUriRemedy);
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        node.fail("is a data URI without a comma",
                  "expected \"data:application/octet-stream;base64,\" and the data");
    }
    const std::string_view data = uri.substr(comma + 1);
    if (!lowerCase(uri.substr(0, comma)).ends_with(";base64")) return decodePercent(data);
    std::optional<std::string> decoded = decodeBase64(data);
    // Encoded as in web pages: %2B, %2F and %3D for +, / and =.
    if (!decoded && data.find('%') != std::string_view::npos) decoded = decodeBase64(decodePercent(data));
    if (!decoded) node.fail("is a data URI that is not base64", "expected letters, digits, + and /");
    return *std::move(decoded);
}

fs::path pathOfUri(const JsonNode& node) {
    std::string_view uri = node.text(kUriRemedy);
    const std::string scheme = lowerCase(schemeOf(uri));
    if (scheme == "file") {
        uri.remove_prefix(scheme.size() + 1);
        if (uri.starts_with("//")) uri.remove_prefix(2);
    } else if (!scheme.empty()) {
        node.failValue(kUriRemedy);
    }
    const std::string decoded = decodePercent(uri);
    if (uri.empty() || decoded.find('\0') != std::string::npos) node.failValue(kUriRemedy);
    const fs::path folder = node.file().parent_path();
    std::error_code ec;
    for (const std::string& name : {decoded, std::string(uri), withSlashes(decoded), withSlashes(uri)}) {
        if (fs::exists(folder / name, ec)) return folder / name;
    }
    return folder / decoded;
}

}  // namespace duolux
