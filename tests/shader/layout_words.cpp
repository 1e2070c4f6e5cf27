#include "tests/shader/layout_words.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/source_text.h"

namespace duolux::test {

namespace {

/// The text between the braces of every structure, by name.
std::map<std::string, std::string, std::less<>> readStructures() {
    std::map<std::string, std::string, std::less<>> out;
    for (const char* folder : {"shaders/shared", "shaders/lib"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(projectRoot() / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string file = entry.path().lexically_relative(projectRoot()).string();
            const std::string text = blankComments(readSource(file));
            constexpr std::string_view kKeyword = "\nstruct ";
            for (std::size_t at = text.find(kKeyword); at != std::string::npos;
                 at = text.find(kKeyword, at)) {
                at += kKeyword.size();
                const std::size_t open = text.find_first_of("{;", at);
                if (open == std::string::npos || text[open] == ';') continue;
                const std::string name = collapseSpaces(std::string_view(text).substr(at, open - at));
                const std::string fields = text.substr(open + 1, closingBracket(text, open) - open - 1);
                if (!out.emplace(name, fields).second)
                    throw std::runtime_error(fmt::format("{}: a second structure {}", file, name));
            }
        }
    }
    return out;
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> out;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        std::string part = collapseSpaces(text.substr(0, end));
        if (!part.empty()) out.push_back(std::move(part));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

class Lister {
  public:
    std::vector<LayoutWord> words;

    void structure(std::string_view name, const std::string& prefix) {
        static const auto structures = readStructures();
        const auto found = structures.find(name);
        if (found == structures.end())
            throw std::runtime_error(fmt::format("no structure {} in shaders/shared or shaders/lib", name));
        for (const std::string& declaration : split(found->second, ';')) {
            const std::vector<std::string> parts = split(declaration, ' ');
            if (parts.size() != 2) throw std::runtime_error(fmt::format("{}: \"{}\"", name, declaration));
            const std::size_t bracket = parts[1].find('[');
            const std::string field = prefix + parts[1].substr(0, bracket);
            if (bracket == std::string::npos) {
                value(parts[0], field);
                continue;
            }
            int size = 0;
            std::from_chars(&parts[1][bracket + 1], parts[1].data() + parts[1].size(), size);
            if (size < 1) throw std::runtime_error(fmt::format("{}: \"{}\"", name, declaration));
            for (int i = 0; i < size; ++i)
                value(parts[0], fmt::format("{}[{}]", field, i));
        }
    }

  private:
    void value(std::string_view type, const std::string& name) {
        if (type == "float" || type == "uint" || type == "int") return word(name, type == "float");
        const bool isFloat = type.starts_with("vec");
        if (isFloat || type.starts_with("uvec") || type.starts_with("ivec")) {
            for (int i = 0; i < type.back() - '0'; ++i)
                word(fmt::format("{}.{}", name, "xyzw"[i]), isFloat);
        } else {
            structure(type, name + ".");
        }
    }

    void word(const std::string& name, bool isFloat) {
        words.push_back({name, isFloat, words.size() * sizeof(std::uint32_t)});
    }
};

}  // namespace

std::vector<LayoutWord> layoutWords(std::string_view structure) {
    Lister lister;
    lister.structure(structure, "");
    return lister.words;
}

}  // namespace duolux::test
