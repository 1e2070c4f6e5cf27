// A failed write throws MachineError, leaves the old file unchanged, and leaves no other files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/parallel.h"
#include "host/film/image.h"
#include "tests/support/address_space.h"
#include "tests/unit/film_samples.h"

namespace duolux {
namespace {

using test::variedImage;
using test::writeText;
using testing::HasSubstr;

/// Makes every file that grows beyond `bytes` fail with EFBIG, as a full disk would with ENOSPC.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &old_);
        rlimit limit = old_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit old_{};
    void (*handler_)(int);
};

std::string machineErrorOf(const std::filesystem::path& path, const RadianceImage& image) {
    try {
        writeImage(path, image, {});
    } catch (const MachineError& e) {
        return e.what();
    }
    ADD_FAILURE() << "expected MachineError";
    return {};
}

std::vector<std::string> namesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename());
    return names;
}

class WriteFailure : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Formats, WriteFailure, testing::Values("a.exr", "a.png", "a.pfm"),
                         [](const auto& file) { return std::string(file.param).substr(2); });

TEST_P(WriteFailure, OnAFullDiskKeepsTheOldFileAndNoTemporary) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / GetParam();
    writeText(path, "the old file");
    std::string message;
    {
        const FileSizeLimit limit(1000);
        message = machineErrorOf(path, variedImage(64, 64));
    }
    EXPECT_THAT(message, HasSubstr(path.string() + ": cannot write: File too large"));
    EXPECT_EQ(readFile(path), "the old file");
    EXPECT_THAT(namesIn(folder.path()), testing::ElementsAre(GetParam()));
}

TEST_P(WriteFailure, IntoAMissingFolderNamesTheFile) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "missing" / GetParam();
    EXPECT_THAT(machineErrorOf(path, variedImage(2, 2)),
                HasSubstr(path.string() + ": cannot write: No such file"));
    writeText(folder / "file", "");
    const std::filesystem::path inFile = folder / "file" / GetParam();
    EXPECT_THAT(machineErrorOf(inFile, variedImage(2, 2)), HasSubstr("cannot write: Not a directory"));
}

TEST_P(WriteFailure, OverAFolderLeavesNoTemporary) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / GetParam();
    std::filesystem::create_directory(path);
    EXPECT_THAT(machineErrorOf(path, variedImage(2, 2)), HasSubstr(path.string() + ": cannot write: "));
    EXPECT_THAT(namesIn(folder.path()), testing::ElementsAre(GetParam()));
}

TEST_P(WriteFailure, IsNotSeenWhenOverwritingWorks) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / GetParam();
    writeText(path, "the old file");
    writeImage(path, variedImage(2, 3), {});
    EXPECT_EQ(readImage(path).height, 3u);
    EXPECT_THAT(namesIn(folder.path()), testing::ElementsAre(GetParam()));
}

TEST_P(WriteFailure, IsNotForAPictureThatDoesNotFitIntoMemory) {
    // 36 MiB in an EXR, 12 in a PFM, and as much as floats for a PNG.
    const ImageRows rows{1024, 1024,
                         [](std::uint32_t firstRow, std::span<glm::vec3> invisible, auto visible) {
                             std::ranges::fill(invisible, glm::vec3(0.5f));
                             std::ranges::fill(visible, glm::vec3(static_cast<float>(firstRow)));
                         }};
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / GetParam();
    limitWorkers(1);  // the stacks of other threads would count
    {
        const test::AddressSpaceLimit limit(std::size_t{11} << 20);
        EXPECT_NO_THROW(writeImage(path, rows, {}));
    }
    limitWorkers(0);
    EXPECT_EQ(readImage(path).visible.back(), glm::vec3(std::string(GetParam()) == "a.png" ? 1.0f : 1008.0f));
}

TEST(WriteImage, RefusesAnUnknownFormat) {
    const TemporaryFolder folder;
    const auto write = [&] { writeImage(folder / "a.tiff", variedImage(1, 1), {}); };
    EXPECT_THAT(write, testing::ThrowsMessage<UsageError>(
                           HasSubstr("a.tiff: unknown image format; expected .exr, .png or .pfm")));
    EXPECT_THAT(namesIn(folder.path()), testing::IsEmpty());
}

}  // namespace
}  // namespace duolux
