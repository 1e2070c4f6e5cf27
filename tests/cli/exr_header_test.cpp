// The metadata in EXR files, and whether other programs accept them.
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/openexr.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/run_duolux.h"

namespace duolux::test {
namespace {

/// Reads the header as `exrinfo -s` does: reserved attributes must have OpenEXR's types.
exr_result_t readStrictly(const std::filesystem::path& file) {
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.flags = EXR_CONTEXT_FLAG_STRICT_HEADER;
    exr_context_t context{};
    const exr_result_t result = exr_start_read(&context, file.c_str(), &settings);
    exr_finish(&context);
    return result;
}

std::string textOf(const Imf::Header& header, const char* attribute) {
    const auto* text = header.findTypedAttribute<Imf::StringAttribute>(attribute);
    return text != nullptr ? text->value() : "";
}

TEST(ExrHeader, IsStrictlyValidAndSaysWhatWasRendered) {
    const TemporaryFolder folder;
    for (const char* integrator : {"path", "light"}) {
        const ProgramResult result =
            runDuolux(folder.path(), {"render", DUOLUX_ASSETS "/cornell/cornell.json", "--device", "cpu",
                                      "--size", "8x4", "--spp", "2", "--seed", "7", "--bounces", "3",
                                      "--preset", "one-bounce", "--integrator", integrator, "-o", "a.exr"});
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(readStrictly(folder / "a.exr"), EXR_ERR_SUCCESS);
        const Imf::InputFile file((folder / "a.exr").c_str());
        const Imf::Header& header = file.header();
        EXPECT_EQ(textOf(header, "reflectance"), "one-bounce");
        EXPECT_EQ(textOf(header, "integrator"), integrator);
        EXPECT_EQ(textOf(header, "spp"), "2");
        EXPECT_EQ(textOf(header, "seed"), "7");
        EXPECT_EQ(textOf(header, "bounces"), "3");
        EXPECT_THAT(textOf(header, "scene hash"), testing::MatchesRegex("[0-9a-f]+"));
        EXPECT_THAT(textOf(header, "Software"), testing::MatchesRegex("duolux [0-9.]+ \\(.+\\)"));
    }
    ASSERT_EQ(runDuolux(folder.path(), {"sheet", "-o", "sheet.exr", "a.exr"}).status, 0);
    EXPECT_EQ(readStrictly(folder / "sheet.exr"), EXR_ERR_SUCCESS);
}

}  // namespace
}  // namespace duolux::test
