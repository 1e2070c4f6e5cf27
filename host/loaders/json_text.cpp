#include "host/loaders/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/printable.h"
#include "host/loaders/file_kind.h"

namespace duolux {

namespace {

using nlohmann::json;

/// Tracks the parser's path in the document and the keys of each open object. (json::parse has a callback for
/// this, but then takes quadratic time in the number of an object's members.)
class KeyWatch : public nlohmann::json_sax<json> {
  public:
    explicit KeyWatch(std::string file) : file_(std::move(file)) {}

    bool null() override { return beginElement(); }
    bool boolean(bool) override { return beginElement(); }
    bool number_integer(number_integer_t) override { return beginElement(); }
    bool number_unsigned(number_unsigned_t) override { return beginElement(); }
    bool number_float(number_float_t, const string_t&) override { return beginElement(); }
    bool string(string_t&) override { return beginElement(); }
    bool binary(binary_t&) override { return beginElement(); }
    bool start_object(std::size_t) override { return open(false); }
    bool start_array(std::size_t) override { return open(true); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    /// json::parse reports syntax errors.
    bool parse_error(std::size_t, const std::string& token,
                     const nlohmann::detail::exception& error) override {
        if (dynamic_cast<const json::out_of_range*>(&error) == nullptr) return false;
        beginElement();
        throw InputError(file_, path(), "is " + shortened(token),
                         "expected a number of at most 1e308 in magnitude");
    }

    bool key(string_t& key) override {
        open_.back().key = key;
        if (!open_.back().keys.insert(key).second) {
            throw InputError(file_, path(), "the key appears twice", "expected it once");
        }
        return true;
    }

  private:
    struct Level {
        bool isArray = false;
        std::size_t elements = 0;
        std::string key;
        std::set<std::string> keys;
    };

    bool beginElement() {
        if (!open_.empty()) ++open_.back().elements;
        return true;
    }

    bool open(bool isArray) {
        beginElement();
        open_.emplace_back().isArray = isArray;
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    std::string path() const {
        std::string path;
        for (const Level& level : open_) {
            if (level.isArray) {
                path += fmt::format("[{}]", level.elements - 1);
            } else {
                if (!path.empty()) path += '.';
                path += shortened(level.key);
            }
        }
        return path;
    }

    std::string file_;
    std::vector<Level> open_;
};

/// "line 3, column 5" for a byte offset; columns count bytes.
std::string placeOf(std::string_view text, std::size_t offset) {
    const std::size_t end = std::min(offset, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    const std::size_t newline = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
    return fmt::format("line {}, column {}", line,
                       end - (newline == std::string::npos ? 0 : newline + 1) + 1);
}

/// The library's message without its prefix "[json.exception.parse_error.101] parse error at line 1, column
/// 2: ".
std::string explanation(const std::string& message) {
    const std::size_t column = message.find("column ");
    const std::size_t colon = message.find(": ", column == std::string::npos ? 0 : column);
    constexpr std::size_t kLongest = 160;
    return shortened(colon == std::string::npos ? message : message.substr(colon + 2), kLongest);
}

}  // namespace

json parseJsonFile(const std::filesystem::path& path) {
    return parseJson(path, readFile(path), "a JSON scene");
}

json parseJson(const std::filesystem::path& path, std::string_view text, std::string_view expected) {
    const std::string remedy = fmt::format("expected {}", expected);
    if (text.empty()) {  // the library's message depends on its version
        throw InputError(path.string(), "line 1, column 1", "syntax error: the file is empty", remedy);
    }
    expectNoForeignFormat(path, text, expected);
    try {
        KeyWatch watch(path.string());
        json::sax_parse(text, &watch);
        return json::parse(text);
    } catch (const json::parse_error& e) {
        const std::size_t offset = e.byte == 0 ? 0 : e.byte - 1;
        throw InputError(path.string(), placeOf(text, offset), explanation(e.what()), remedy);
    } catch (const json::exception& e) {
        throw InputError(path.string(), "", explanation(e.what()), remedy);
    }
}

}  // namespace duolux
