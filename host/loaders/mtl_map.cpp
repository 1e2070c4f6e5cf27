#include "host/loaders/mtl_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>

#include "host/loaders/source_text.h"

namespace duolux {

namespace {

enum class MapOption {
    kBlend,
    kClamp,
    kOffset,
    kScale,
    kBump,
    kChannel,
    kGain,
    kUnused,  ///< nothing, unless off or 0
    kUnknown
};

struct OptionSyntax {
    std::string_view name;
    MapOption option;
    int words;    ///< that follow and are no numbers
    int numbers;  ///< at most
};
constexpr OptionSyntax kOptions[] = {
    {"-blendu", MapOption::kBlend, 1, 0},    {"-blendv", MapOption::kBlend, 1, 0},
    {"-clamp", MapOption::kClamp, 1, 0},     {"-o", MapOption::kOffset, 0, 3},
    {"-s", MapOption::kScale, 0, 3},         {"-bm", MapOption::kBump, 0, 1},
    {"-imfchan", MapOption::kChannel, 1, 0}, {"-mm", MapOption::kGain, 0, 2},
    {"-t", MapOption::kUnused, 0, 3},        {"-cc", MapOption::kUnused, 1, 0},
    {"-boost", MapOption::kUnused, 0, 1},    {"-texres", MapOption::kUnused, 0, 1},
    {"-type", MapOption::kUnused, 1, 0},
};

class MapReader {
  public:
    explicit MapReader(std::string_view arguments) : rest_(trimmed(arguments)) {}

    MtlMap run() {
        while (rest_.starts_with('-') && readOption()) {
        }
        map_.file = rest_;
        // From v up the image to v down: 1 - (s (1 - v) + o) = s v + 1 - s - o.
        map_.transform.scale = glm::vec2(scale_);
        map_.transform.offset = {static_cast<float>(offset_.x),
                                 static_cast<float>(1.0 - scale_.y - offset_.y)};
        return std::move(map_);
    }

  private:
    /// Returns false if a file name begins here.
    bool readOption() {
        const std::string_view word = firstWord(rest_);
        const auto* const found =
            std::find_if(std::begin(kOptions), std::end(kOptions),
                         [&](const OptionSyntax& syntax) { return syntax.name == word; });
        if (found == std::end(kOptions) && word.size() == rest_.size()) return false;
        const OptionSyntax syntax =
            found == std::end(kOptions) ? OptionSyntax{word, MapOption::kUnknown, 0, 3} : *found;
        advance(word);
        std::string_view value;
        const std::string_view next = firstWord(rest_);
        // The last word is the file, unless it cannot be one.
        if (syntax.words > 0 && (next.size() < rest_.size() || next == "on" || next == "off")) {
            value = next;
            advance(next);
        }
        glm::dvec3 numbers(0.0);
        int count = 0;
        while (count < syntax.numbers) {
            const std::optional<double> number = numberAhead();
            if (!number) break;
            numbers[count++] = *number;
            advance(firstWord(rest_));
        }
        if (!apply(syntax.option, value, numbers, count)) map_.unused.push_back(word);
        return true;
    }

    void advance(std::string_view word) { rest_ = trimmed(rest_.substr(word.size())); }

    std::optional<double> numberAhead() const {
        const std::string_view word = firstWord(rest_);
        const auto [past, value] = readNumber(word.data(), word.data() + word.size());
        if (word.empty() || past != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
        return value;
    }

    /// Whether the option has its effect, or is to have none.
    bool apply(MapOption option, std::string_view value, const glm::dvec3& numbers, int count) {
        switch (option) {
            case MapOption::kBlend:
                if (value == "off") map_.filter = Filter::kNearest;
                return true;
            case MapOption::kClamp:
                if (value != "off") map_.wrap = Wrap::kClamp;
                return true;
            case MapOption::kOffset:
                if (count == 0 || !isUsual(numbers)) return false;
                offset_ = glm::dvec2(numbers);
                return true;
            case MapOption::kScale:
                if (count == 0 || !isUsual(numbers)) return false;
                scale_ = {numbers.x, count > 1 ? numbers.y : 1.0};
                return true;
            case MapOption::kBump:
                if (count > 0) map_.scale = numbers.x;
                return count > 0;
            case MapOption::kChannel:
                return chooseChannel(value);
            case MapOption::kGain:
                if (count == 0 || !isUsual(numbers)) return false;
                map_.base = numbers.x;
                if (count > 1) map_.gain = numbers.y;
                return true;
            case MapOption::kUnused:
                return value == "off" || (value.empty() && numbers == glm::dvec3(0.0));
            case MapOption::kUnknown:
                return false;
        }
        return false;
    }

    /// Coordinates beyond this would have no precision left.
    static bool isUsual(const glm::dvec3& numbers) {
        constexpr double kLargest = 1e6;
        return glm::all(glm::lessThanEqual(glm::abs(numbers), glm::dvec3(kLargest)));
    }

    /// Luminance is red: images with one value per pixel are grey.
    bool chooseChannel(std::string_view name) {
        struct Channel {
            std::string_view name;
            std::uint32_t index;
        };
        static constexpr Channel kNames[] = {{"r", 0}, {"g", 1}, {"b", 2}, {"m", 3}, {"l", 0}};
        const auto* const found = std::find_if(std::begin(kNames), std::end(kNames),
                                               [&](const Channel& channel) { return channel.name == name; });
        if (found == std::end(kNames)) return false;
        map_.channel = found->index;
        map_.hasChannel = true;
        return true;
    }

    std::string_view rest_;
    glm::dvec2 scale_{1.0}, offset_{0.0};
    MtlMap map_;
};

}  // namespace

MtlMap readMtlMap(std::string_view arguments) {
    return MapReader(arguments).run();
}

}  // namespace duolux
