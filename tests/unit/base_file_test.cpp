#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/temporary_folder.h"

namespace duolux {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
  protected:
    static void write(const fs::path& path, std::string_view text) {
        std::ofstream(path, std::ios::binary) << text;
    }
    std::size_t filesInFolder() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    TemporaryFolder temporary_;
    fs::path folder_ = temporary_.path();
};

TEST_F(FileTest, ReadsAllBytes) {
    const std::string bytes("a\0\n\r\xFF", 5);
    write(folder_ / "f", bytes);
    EXPECT_EQ(readFile(folder_ / "f"), bytes);
    write(folder_ / "empty", "");
    EXPECT_EQ(readFile(folder_ / "empty"), "");
}

TEST_F(FileTest, CannotReadWhatIsNoFile) {
    EXPECT_THROW(readFile(folder_ / "none"), InputError);
    EXPECT_THROW(readFile(folder_), InputError);
}

TEST_F(FileTest, WritesUnderATemporaryNameOfTheSameExtension) {
    const fs::path path = folder_ / "image.exr";
    write(path, "old");
    writeFileAtomically(path, [&](const fs::path& temporary) {
        EXPECT_NE(temporary, path);
        EXPECT_EQ(temporary.parent_path(), folder_);
        EXPECT_EQ(temporary.extension(), ".exr");
        write(temporary, "new");
        EXPECT_EQ(readFile(path), "old");
    });
    EXPECT_EQ(readFile(path), "new");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(FileTest, ALinkStaysOne) {
    write(folder_ / "old", "old");
    fs::create_symlink("old", folder_ / "link");
    writeFile(folder_ / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    EXPECT_EQ(readFile(folder_ / "old"), "new");
    EXPECT_EQ(filesInFolder(), 2u);
}

TEST_F(FileTest, APipeStaysOneAndIsWrittenInto) {
    const fs::path pipe = folder_ / "pipe.exr";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    writeFileAtomically(pipe, [&](const fs::path& temporary) {
        EXPECT_EQ(temporary.extension(), ".exr");
        write(temporary, "bytes");
    });
    char bytes[16];
    const ssize_t count = ::read(reader, bytes, sizeof bytes);
    ::close(reader);
    ASSERT_EQ(count, 5);
    EXPECT_EQ(std::string(bytes, 5), "bytes");
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(FileTest, AFailedWriteLeavesTheOldFileAlone) {
    const fs::path path = folder_ / "image.exr";
    write(path, "old");
    try {
        writeFileAtomically(path, [&](const fs::path& temporary) {
            write(temporary, "half of the n");
            throw std::runtime_error("disk on fire");
        });
        FAIL() << "expected MachineError";
    } catch (const MachineError& e) {
        EXPECT_EQ(e.what(), path.string() + ": cannot write: disk on fire");
    }
    EXPECT_EQ(readFile(path), "old");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(FileTest, ErrorsOfTheProgramPassThrough) {
    const auto fail = [](const fs::path&) { throw InputError("scene.json", "", "is odd", ""); };
    EXPECT_THROW(writeFileAtomically(folder_ / "f", fail), InputError);
    EXPECT_EQ(filesInFolder(), 0u);
}

}  // namespace
}  // namespace duolux
