#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace duolux::test {

/// A function of the library, or a condition in it.
struct CoveragePoint {
    std::string file;
    std::size_t line;
    std::string text;  ///< the function's name, or the condition
    bool isCondition;
};

/// Instruments every function and every condition of a GLSL file (of if, while, for and ?:), so that a kernel
/// records what it reaches: coverFunction_(id), coverCondition_(id, condition). Line numbers do not change.
/// Appends to `points`, whose index is the id.
std::string instrument(std::string_view file, std::string_view text, std::vector<CoveragePoint>& points);

/// From now on, kernels are compiled from instrumented copies of the *.glsl files in `folder` of the project,
/// and the coverage is written to the file `report` after all tests.
void measureCoverage(const std::filesystem::path& folder, const std::filesystem::path& report);

/// One or two flags for each point: whether a function was reached; whether a condition was ever false, ever
/// true.
std::string coverageReport(const std::vector<CoveragePoint>& points,
                           const std::vector<std::uint32_t>& reached);

}  // namespace duolux::test
