#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace duolux::test {

/// A scene that cannot be used: every command that loads `files[0]` must refuse it.
struct MalformedScene {
    const char* name;
    std::vector<std::pair<std::string, std::string>> files;  ///< name and content; the scene comes first
    std::vector<std::string> words;  ///< in the error line: file, place, problem, remedy
    bool onlyIfStrict = false;       ///< loads without --strict
};

/// An invalid command line. It may refer to good.obj, a valid scene.
struct WrongUsage {
    const char* name;
    std::vector<std::string> arguments;
    std::vector<std::string> words;
};

/// For messages of the test framework.
inline void PrintTo(const MalformedScene& scene, std::ostream* out) {
    *out << scene.name;
}
inline void PrintTo(const WrongUsage& usage, std::ostream* out) {
    *out << usage.name;
}

std::vector<MalformedScene> malformedObjs();
std::vector<MalformedScene> malformedMtls();
std::vector<MalformedScene> malformedGltfs();
std::vector<MalformedScene> malformedJsons();
std::vector<WrongUsage> wrongUsages();

}  // namespace duolux::test
