#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace duolux::test {

/// A line of a list: FILE | OLD => NEW | WHY; for a mutation that no test can detect, followed by
/// | equivalent: REASON.
struct Mutation {
    std::size_t line = 0;
    std::string file, before, after, why, equivalent;
    std::string caughtBy;  ///< the first test that failed; empty: it survived
    bool compiles = true;
    std::string crash;  ///< how the tests ended, if they did not fail normally

    bool decided() const { return !compiles || !caughtBy.empty() || !crash.empty(); }
};

struct MutationList {
    std::string name;            ///< of its file, for messages
    std::filesystem::path root;  ///< what the files are relative to
    std::vector<Mutation> mutations;
    std::map<std::string, std::string> first;  ///< by file: the tests that detect most mutations

    /// The tests of a file; by default those named after it.
    std::string firstTests(const Mutation& m) const;
    /// Keeps the mutations of files whose name contains a text.
    void keepOnly(const std::string& part);
};

/// Reads a list. Throws InputError at the first line that is malformed or does not match the files below the
/// root.
MutationList readMutations(const std::filesystem::path& list, const std::filesystem::path& root);

/// The file with the mutation applied. Throws InputError unless the text to be replaced occurs exactly once.
std::string mutated(const MutationList& list, const Mutation& m);

/// Records in the mutation which test failed, or how else the tests ended.
void noteResult(const ProgramResult& result, Mutation& m);

/// Prints the change and its result.
void printVerdict(const MutationList& list, const Mutation& m);

/// Prints the survivors and the score of the list. Returns whether the score reaches the goal, in per cent.
bool printScore(const MutationList& list, double goal);

}  // namespace duolux::test
