#include "host/loaders/ply_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "host/base/printable.h"
#include "host/loaders/source_text.h"

namespace duolux {

namespace {

template <typename T>
double readAs(const char* at, bool swap) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at, sizeof(T));
    if (swap) std::reverse(bytes.begin(), bytes.end());
    return static_cast<double>(std::bit_cast<T>(bytes));
}

/// The fewest bytes of an item: its lists are empty. A value of text is a digit and a blank.
std::size_t smallestItem(const PlyElement& element, PlyFormat format) {
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties)
        bytes += format == PlyFormat::kAscii ? 2 : sizeOf(property.countType.value_or(property.type));
    return bytes;
}

}  // namespace

PlyBody::PlyBody(const std::filesystem::path& path, std::string_view bytes, const PlyHeader& header)
    : path_(path), bytes_(bytes), header_(header), at_(header.bodyOffset) {}

void PlyBody::beginElement(const PlyElement& element) {
    element_ = &element;
    item_ = 0;
    const std::size_t smallest = smallestItem(element, header_.format);
    if (smallest == 0) return;
    // The last value of a text may have no blank behind it.
    const std::uint64_t most = (remaining() + (header_.format == PlyFormat::kAscii ? 1 : 0)) / smallest;
    if (element.count > most) {
        throw InputError(path_.string(), fmt::format("element {}", shortened(element.name)),
                         fmt::format("the file holds at most {}", most),
                         fmt::format("expected {}, as the header says", element.count));
    }
}

void PlyBody::beginItem() {
    ++item_;
    if (header_.format != PlyFormat::kAscii) return;
    while (at_ < bytes_.size() && (isBlank(bytes_[at_]) || isLineEnd(bytes_[at_])))
        ++at_;
    if (at_ == bytes_.size()) failTooShort();
}

void PlyBody::endItem() {
    if (header_.format != PlyFormat::kAscii) return;
    while (at_ < bytes_.size() && isBlank(bytes_[at_]))
        ++at_;
    if (at_ == bytes_.size() || isLineEnd(bytes_[at_])) return;
    ++overlongItems_;
    at_ = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
}

double PlyBody::textValue() {
    while (at_ < bytes_.size() && isBlank(bytes_[at_]))
        ++at_;
    if (at_ == bytes_.size()) failTooShort();
    if (isLineEnd(bytes_[at_])) throw error("the line has too few numbers", "expected a line for each item");
    const char* const end = bytes_.data() + bytes_.size();
    const auto [past, number] = readNumber(bytes_.data() + at_, end);
    if (past == nullptr || (past != end && !isBlank(*past) && !isLineEnd(*past))) {
        const std::string_view rest = bytes_.substr(at_);
        throw error(fmt::format("{} is not a number", inQuotes(firstWord(rest))), "expected a number");
    }
    at_ = static_cast<std::size_t>(past - bytes_.data());
    return number;
}

double PlyBody::binaryValue(PlyType type) {
    const std::size_t size = sizeOf(type);
    if (remaining() < size) failTooShort();
    const char* const at = bytes_.data() + at_;
    at_ += size;
    const bool swap = (header_.format == PlyFormat::kBigEndian) != (std::endian::native == std::endian::big);
    switch (type) {
        case PlyType::kInt8:
            return readAs<std::int8_t>(at, swap);
        case PlyType::kUint8:
            return readAs<std::uint8_t>(at, swap);
        case PlyType::kInt16:
            return readAs<std::int16_t>(at, swap);
        case PlyType::kUint16:
            return readAs<std::uint16_t>(at, swap);
        case PlyType::kInt32:
            return readAs<std::int32_t>(at, swap);
        case PlyType::kUint32:
            return readAs<std::uint32_t>(at, swap);
        case PlyType::kFloat:
            return readAs<float>(at, swap);
        case PlyType::kDouble:
            break;
    }
    return readAs<double>(at, swap);
}

std::size_t PlyBody::listLength(const PlyProperty& property) {
    const double length = value(*property.countType);
    if (!(length >= 0.0) || length != std::floor(length)) {
        throw error(fmt::format("{} is not the length of a list", length), "expected a whole number");
    }
    const std::size_t size = header_.format == PlyFormat::kAscii ? 2 : sizeOf(property.type);
    const std::size_t most = (remaining() + size - 1) / size;
    if (length > static_cast<double>(most)) {
        throw error(fmt::format("a list of {} numbers goes beyond the end of the file", length),
                    fmt::format("expected at most {}", most));
    }
    return static_cast<std::size_t>(length);
}

void PlyBody::skip(const PlyProperty& property) {
    const std::size_t count = property.isList() ? listLength(property) : 1;
    if (header_.format == PlyFormat::kAscii) {
        for (std::size_t i = 0; i < count; ++i)
            textValue();
        return;
    }
    const std::size_t size = count * sizeOf(property.type);
    if (remaining() < size) failTooShort();
    at_ += size;
}

void PlyBody::skipElement(const PlyElement& element) {
    beginElement(element);
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        beginItem();
        for (const PlyProperty& property : element.properties)
            skip(property);
        endItem();
    }
}

std::string PlyBody::place() const {
    const std::string item = fmt::format("{} {} of {}", shortened(element_->name), item_, element_->count);
    if (header_.format != PlyFormat::kAscii) return item;
    const std::string_view before = bytes_.substr(0, at_);
    const auto newlines = std::count(before.begin(), before.end(), '\n');
    const auto lines = newlines > 0 ? newlines : std::count(before.begin(), before.end(), '\r');
    return fmt::format("line {} ({})", lines + 1, item);
}

InputError PlyBody::error(std::string_view problem, std::string_view remedy) const {
    return {path_.string(), place(), problem, remedy};
}

void PlyBody::failTooShort() const {
    throw error("the file ends here", fmt::format("expected {}, as the header says", element_->count));
}

}  // namespace duolux
