#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace duolux {

/// What a warning is about, where other code depends on it.
enum class WarningKind : std::uint8_t {
    kOther,
    kBlackPicture,     ///< no light, so that the picture will be black
    kEmittersFaceAway  ///< emitters face away from what they could light
};

/// A message for the user about something that does not prevent a picture.
struct Warning {
    // NOLINTNEXTLINE(google-explicit-constructor): most warnings are a text alone
    Warning(std::string message, WarningKind about = WarningKind::kOther)
        : text(std::move(message)), kind(about) {}

    std::string text;
    WarningKind kind;
};

inline std::vector<std::string> textsOf(const std::vector<Warning>& warnings) {
    std::vector<std::string> texts;
    for (const Warning& warning : warnings)
        texts.push_back(warning.text);
    return texts;
}

}  // namespace duolux
