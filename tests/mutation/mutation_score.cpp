// Applies small plausible changes to the sources, one at a time, and checks that the tests detect them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>

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
        test::MutationList library = test::readMutations(lists / "library.txt", project / "shaders");
        test::MutationList program = test::readMutations(lists / "program.txt", project);
        if (check) return 0;
        library.keepOnly(only);
        program.keepOnly(only);
        if (library.mutations.empty() && program.mutations.empty())
            throw UsageError(fmt::format("no mutation of a file whose name contains \"{}\"", only));
        setenv("GTEST_FAIL_FAST", "1", 1);
        bool good = true;
        if (!library.mutations.empty()) {
            test::tryInLibrary(library);
            good = test::printScore(library, goal);
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
