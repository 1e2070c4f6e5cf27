#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace duolux::test {

/// A line of a list: FILE | OLD => NEW | WHY, and for one that no test can catch: | equivalent: REASON.
struct Mutation {
    std::size_t line = 0;
    std::string file, before, after, why, equivalent;
    std::string caughtBy;  ///< the first test that failed; empty: it survived
    bool compiles = true;
    std::string crash;  ///< how the tests ended instead of failing

    bool decided() const { return !compiles || !caughtBy.empty() || !crash.empty(); }
};

struct MutationList {
    std::string name;            ///< of its file, for messages
    std::filesystem::path root;  ///< what the files are relative to
    std::vector<Mutation> mutations;
    std::map<std::string, std::string> first;  ///< by file: the tests that find most

    /// By default those that are named after the file.
    std::string firstTests(const Mutation& m) const;
    /// Keeps those of files whose name contains this.
    void keepOnly(const std::string& part);
};

/// Throws InputError at the first line that makes no sense, or does not fit the files below the root.
MutationList readMutations(const std::filesystem::path& list, const std::filesystem::path& root);

/// The file with the mutation in it. Throws InputError unless what is to be replaced is there exactly once.
std::string mutated(const MutationList& list, const Mutation& m);

/// Notes in the mutation which test failed, or how else the tests ended.
void noteResult(const ProgramResult& result, Mutation& m);

/// Prints what was changed, and what came of it.
void printVerdict(const MutationList& list, const Mutation& m);

/// Prints what is to be done about the list, and its score. Whether that is as good as the goal, in per cent.
bool printScore(const MutationList& list, double goal);

}  // namespace duolux::test
