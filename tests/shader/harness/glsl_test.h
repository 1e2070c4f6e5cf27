#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/shader/harness/glsl_file.h"
#include "tests/shader/harness/glsl_report.h"

namespace duolux::test {

/// Changes the random inputs of all tests; 0 unless main() is given another value.
std::uint32_t& randomSeed();

/// Runs one test of a file on device() and returns what failed; line 0: no line of this file. Throws
/// MachineError if the device fails.
std::vector<GlslFailure> runGlslTest(const GlslFile& file, std::size_t test);

/// Registers every test of every *_test.glsl in a folder of the project as a GoogleTest of the suite
/// NameGlsl, where NAME_test.glsl is the file. An invalid file becomes a failing test. Throws
/// std::runtime_error if the folder does not exist.
void registerGlslTests(const std::filesystem::path& folder);

}  // namespace duolux::test
