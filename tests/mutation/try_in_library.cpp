#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/cli/temporary_folder.h"
#include "tests/mutation/try_mutations.h"

namespace duolux::test {

namespace {

/// Runs the tests with these sources and records the result in the mutation. Tests named *Oracles* are
/// excluded, because they share the library's source.
void runTests(const std::filesystem::path& sources, const std::string& filter, Mutation& m) {
    const ProgramResult result =
        runProgram(DUOLUX_SHADER_TEST, sources,
                   {"--sources", sources.string(), "--gtest_brief=1",
                    "--gtest_filter=" + filter + "-*Oracles*:Harness*:Coverage*:TestDevice*"},
                   std::nullopt, std::chrono::seconds(300));
    // No tests are named after this file: the whole suite is run.
    if (result.err.find("no test's name matches") != std::string::npos) return;
    // A mutation that does not compile says nothing about the tests.
    m.compiles = result.out.find("ERROR: ") == std::string::npos;
    noteResult(result, m);
}

}  // namespace

void tryInLibrary(MutationList& list) {
    Mutation none;
    runTests(list.root, "*", none);
    if (none.decided())
        throw MachineError(fmt::format("without any mutation {} fails already",
                                       none.caughtBy.empty() ? DUOLUX_SHADER_TEST : none.caughtBy));
    std::atomic<std::size_t> next{0};
    std::mutex printing;
    std::exception_ptr failure;
    const auto work = [&] {
        try {
            for (std::size_t i = next++; i < list.mutations.size(); i = next++) {
                Mutation& m = list.mutations[i];
                const TemporaryFolder folder;
                const std::filesystem::path file = folder.path() / "shaders" / m.file;
                std::filesystem::create_directories(file.parent_path());
                writeFile(file, mutated(list, m));
                runTests(folder.path(), list.firstTests(m), m);
                if (m.caughtBy.empty() && m.crash.empty()) runTests(folder.path(), "*", m);
                const std::lock_guard lock(printing);
                printVerdict(list, m);
            }
        } catch (...) {
            const std::lock_guard lock(printing);
            failure = std::current_exception();
            next = list.mutations.size();
        }
    };
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < std::max(1u, std::thread::hardware_concurrency()); ++t)
        threads.emplace_back(work);
    for (std::thread& thread : threads)
        thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace duolux::test
