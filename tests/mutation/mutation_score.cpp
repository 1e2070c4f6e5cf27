// Applies small plausible changes to the sources, one at a time, and checks that the tests detect them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "host/base/error.h"
#include "tests/mutation/try_mutations.h"

int main(int argc, char** argv) {
    using namespace duolux;
    CLI::App app("Mutation score of the tests.");
    std::string only;
    double goal = 95.0;
    app.add_option("--only", only, "only mutations of files whose name contains this");
    app.add_option("--goal", goal, "per cent of each list to be caught; fewer: exit status 1")
        ->capture_default_str();
    bool check = false;
    app.add_flag("--check", check, "only check that the lists fit the sources");
    CLI11_PARSE(app, argc, argv);
    try {
        const std::filesystem::path lists = DUOLUX_MUTATION_LISTS;
        const std::filesystem::path project = DUOLUX_SOURCE_ROOT;
        std::vector<test::MutationList> library;
        for (const auto& entry : std::filesystem::directory_iterator(lists / "library"))
            library.push_back(test::readMutations(entry.path(), project / "shaders"));
        test::MutationList program = test::readMutations(lists / "program.txt", project);
        if (check) return 0;
        for (test::MutationList& list : library)
            list.keepOnly(only);
        std::erase_if(library, [](const test::MutationList& list) { return list.mutations.empty(); });
        program.keepOnly(only);
        if (library.empty() && program.mutations.empty())
            throw UsageError(fmt::format("no mutation of a file whose name contains \"{}\"", only));
        setenv("GTEST_FAIL_FAST", "1", 1);
        bool good = true;
        for (test::MutationList& list : library) {
            test::tryInLibrary(list);
            good = test::printScore(list, goal) && good;
        }
        if (!program.mutations.empty()) {
            test::tryInProgram(program);
            good = test::printScore(program, goal) && good;
        }
        return good ? 0 : 1;
    } catch (const std::exception& e) {
        fmt::print(stderr, "mutation_score: {}\n", e.what());
        return 1;
    }
}
