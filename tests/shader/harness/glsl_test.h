#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/shader/harness/glsl_file.h"
#include "tests/shader/harness/glsl_report.h"

namespace duolux::test {

/// What makes the random inputs of all tests other ones; 0 unless main() was told otherwise.
std::uint32_t& randomSeed();

/// Runs one test of a file on device() and returns what failed; line 0: no line of this file. Throws
/// MachineError if the device fails.
std::vector<GlslFailure> runGlslTest(const GlslFile& file, std::size_t test);

/// Makes every test of every *_test.glsl in a folder of the project a GoogleTest of the suite NameGlsl, where
/// NAME_test.glsl is the file. A file that cannot be understood becomes a test that fails. Throws
/// std::runtime_error if there is no such folder.
void registerGlslTests(const std::filesystem::path& folder);

}  // namespace duolux::test
