#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>

#include "host/base/error.h"
#include "host/base/file.h"
#include "tests/mutation/try_mutations.h"

namespace duolux::test {

namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

/// Fast tests first.
constexpr const char* kTests[] = {"film_test", "render_test", "scene_test", "statistical_test"};

/// All files except hidden ones and build output, relative to the root.
std::set<fs::path> sourcesIn(const fs::path& root) {
    std::set<fs::path> files;
    for (const fs::directory_entry& top : fs::directory_iterator(root)) {
        const std::string name = top.path().filename().string();
        if (name[0] == '.' || name == "build") continue;
        if (top.is_regular_file()) files.insert(name);
        if (!top.is_directory()) continue;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(top.path()))
            if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(root));
    }
    return files;
}

/// A copy of the project, and a build of it.
class Copy {
  public:
    explicit Copy(const fs::path& project) : project_(project) {
        bringUpToDate();
        cmake({"-S", sources_.string(), "-B", build_.string(), "-G", DUOLUX_GENERATOR,
               "-DCMAKE_CXX_COMPILER=" DUOLUX_COMPILER, "-DCMAKE_CXX_COMPILER_LAUNCHER=" DUOLUX_LAUNCHER,
               "-DCMAKE_CXX_FLAGS=" DUOLUX_COMPILER_FLAGS, "-DCMAKE_BUILD_TYPE=" DUOLUX_BUILD_TYPE});
        build();
    }

    void write(const Mutation& m, const std::string& text) const { writeFile(sources_ / m.file, text); }
    void restore(const Mutation& m) const { writeFile(sources_ / m.file, readFile(project_ / m.file)); }

    /// Throws MachineError if that fails.
    void build() const {
        std::vector<std::string> arguments{"--build", build_.string(), "--target"};
        arguments.insert(arguments.end(), std::begin(kTests), std::end(kTests));
        cmake(arguments);
    }

    ProgramResult run(const std::string& test, const std::string& filter, seconds limit) const {
        const fs::path folder = build_ / "tests" / (test == "statistical_test" ? "statistical" : "unit");
        return runProgram((folder / test).string(), build_, {"--gtest_brief=1", "--gtest_filter=" + filter},
                          std::nullopt, limit);
    }

  private:
    /// Unchanged files keep their modification times, so that little is rebuilt.
    void bringUpToDate() const {
        fs::create_directories(sources_);
        const std::set<fs::path> files = sourcesIn(project_);
        for (const fs::path& file : sourcesIn(sources_))
            if (!files.contains(file)) fs::remove(sources_ / file);
        for (const fs::path& file : files) {
            const fs::path copy = sources_ / file;
            if (fs::exists(copy) && readFile(copy) == readFile(project_ / file)) continue;
            fs::create_directories(copy.parent_path());
            fs::copy_file(project_ / file, copy, fs::copy_options::overwrite_existing);
        }
    }

    void cmake(const std::vector<std::string>& arguments) const {
        const ProgramResult result =
            runProgram(DUOLUX_CMAKE, sources_, arguments, std::nullopt, seconds(7200));
        if (result.status != 0)
            throw MachineError(
                fmt::format("{}: cannot be built:\n{}{}", sources_.string(), result.out, result.err));
    }

    fs::path project_;
    fs::path sources_ = DUOLUX_MUTATION_FOLDER;
    fs::path build_ = sources_ / "build" / "release";
};

/// For the filtered tests of a program. A mutation may make a loop endless.
constexpr seconds kFirstTestsLimit(600), kAllTestsLimit(3600);

void tryOne(const Copy& copy, const MutationList& list, const std::string& filter, seconds limit,
            Mutation& m) {
    copy.write(m, mutated(list, m));
    try {
        copy.build();
        for (const char* test : kTests) {
            if (!m.decided()) noteResult(copy.run(test, filter, limit), m);
        }
    } catch (const MachineError&) {
        m.compiles = false;
    }
    copy.restore(m);
}

}  // namespace

void tryInProgram(MutationList& list) {
    const Copy copy(list.root);
    // First the tests that detect most mutations of a file, then all tests for the remaining mutations.
    for (Mutation& m : list.mutations) {
        tryOne(copy, list, list.firstTests(m), kFirstTestsLimit, m);
        if (m.decided()) printVerdict(list, m);
    }
    if (std::ranges::all_of(list.mutations, &Mutation::decided)) return;
    for (Mutation& m : list.mutations) {
        if (m.decided()) continue;
        tryOne(copy, list, "*", kAllTestsLimit, m);
        printVerdict(list, m);
    }
}

}  // namespace duolux::test
