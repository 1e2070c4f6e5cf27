#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <functional>
#include <set>
#include <span>
#include <utility>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/cli/temporary_folder.h"

namespace duolux {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FileTest : public testing::Test {
  protected:
    static void write(const fs::path& path, std::string_view text) {
        std::ofstream(path, std::ios::binary) << text;
    }
    std::size_t filesInFolder() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    static mode_t modeOf(const fs::path& path) {
        struct stat status {};
        EXPECT_EQ(::stat(path.c_str(), &status), 0) << path;
        return status.st_mode & 07777;
    }
    /// The message of the MachineError that the step throws, if any.
    static std::string errorOf(const std::function<void()>& step) {
        try {
            step();
        } catch (const MachineError& e) {
            return e.what();
        }
        return "";
    }

    static constexpr uid_t kNobody = 65534;
    /// Runs the step in a process of an unprivileged user who owns the folder and its contents; returns the
    /// exit status.
    int asAnotherUser(const std::function<int()>& step) const {
        return inAnotherProcess([&] {
            if (::geteuid() == 0) {
                for (const auto& entry : fs::directory_iterator(folder_)) {
                    if (::chown(entry.path().c_str(), kNobody, kNobody) != 0) ::_exit(101);
                }
                if (::chown(folder_.c_str(), kNobody, kNobody) != 0 || ::setgroups(0, nullptr) != 0 ||
                    ::setgid(kNobody) != 0 || ::setuid(kNobody) != 0) {
                    ::_exit(102);
                }
            }
            return step();
        });
    }

    /// Runs the step in a process that may mount, and whose mounts are invisible to other processes;
    /// unprivileged users need a user namespace for this.
    int whereMountsArePrivate(const std::function<int()>& step) const {
        return inAnotherProcess([&] {
            const uid_t user = ::geteuid();
            const gid_t group = ::getegid();
            if (::unshare(CLONE_NEWNS) != 0) {
                if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) ::_exit(103);
                write("/proc/self/setgroups", "deny");
                write("/proc/self/uid_map", fmt::format("{0} {0} 1", user));
                write("/proc/self/gid_map", fmt::format("{0} {0} 1", group));
            }
            if (::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) ::_exit(104);
            return step();
        });
    }

    static int inAnotherProcess(const std::function<int()>& step) {
        const pid_t child = ::fork();
        if (child == 0) {
            try {
                ::_exit(step());
            } catch (const std::exception& e) {
                std::fprintf(stderr, "%s\n", e.what());
                ::_exit(100);
            }
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return status;
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

TEST_F(FileTest, WritesBesideTheOldFileUntilAllIsThere) {
    const fs::path path = folder_ / "image.exr";
    write(path, "old");
    writeFileAtomically(path, [&](FileWriter& file) {
        file.write("n__");
        EXPECT_EQ(file.position(), 3u);
        file.seek(1);
        file.write("ew");
        EXPECT_EQ(filesInFolder(), 2u);
        EXPECT_EQ(readFile(path), "old");
    });
    EXPECT_EQ(readFile(path), "new");
    EXPECT_EQ(filesInFolder(), 1u);
}

/// The temporary file of the file that is being written.
fs::path temporaryIn(const fs::path& folder, const fs::path& path) {
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path() != path) return entry.path();
    }
    return {};
}

TEST_F(FileTest, TemporaryNamesAreUnpredictable) {
    std::set<fs::path> names;
    const fs::path path = folder_ / "a.png";
    for (int i = 0; i < 5; ++i) {
        writeFileAtomically(path, [&](FileWriter&) { names.insert(temporaryIn(folder_, path)); });
    }
    EXPECT_EQ(names.size(), 5u);
}

TEST_F(FileTest, PermissionsOfTheOldFileStay) {
    const mode_t old = ::umask(027);
    writeFile(folder_ / "new", "x");
    ::umask(old);
    EXPECT_EQ(modeOf(folder_ / "new"), 0640u);
    for (const mode_t mode : {0600u, 0664u, 0200u}) {
        ASSERT_EQ(::chmod((folder_ / "new").c_str(), mode), 0);
        writeFileAtomically(folder_ / "new", [&](FileWriter& file) {
            EXPECT_EQ(modeOf(temporaryIn(folder_, folder_ / "new")), 0600u);  // not readable by other users
            file.write("y");
        });
        EXPECT_EQ(modeOf(folder_ / "new"), mode);
    }
}

TEST_F(FileTest, AWriteProtectedFileStays) {
    write(folder_ / "f", "old");
    ASSERT_EQ(::chmod((folder_ / "f").c_str(), 0444), 0);
    for (const std::string& error : {errorOf([&] { writeFile(folder_ / "f", "new"); }),
                                     errorOf([&] { checkWritable(folder_ / "f"); })}) {
        EXPECT_EQ(error, (folder_ / "f").string() + ": cannot write: the file is write-protected");
    }
    EXPECT_EQ(readFile(folder_ / "f"), "old");
}

TEST_F(FileTest, ALinkToNothingMakesTheFileThatItNames) {
    fs::create_directory(folder_ / "sub");
    fs::create_symlink("sub/second", folder_ / "first");
    fs::create_symlink("third", folder_ / "sub/second");
    checkWritable(folder_ / "first");
    writeFile(folder_ / "first", "new");
    EXPECT_TRUE(fs::is_symlink(folder_ / "first"));
    EXPECT_EQ(readFile(folder_ / "sub/third"), "new");
    fs::create_symlink("circle", folder_ / "circle");
    EXPECT_THAT(errorOf([&] { writeFile(folder_ / "circle", "x"); }), HasSubstr("symbolic links"));
}

TEST_F(FileTest, TheLongestNameIsWritten) {
    const std::string longest(255, 'x');
    checkWritable(folder_ / longest);
    writeFile(folder_ / longest, "new");
    writeFile(folder_ / longest, "newer");
    EXPECT_EQ(readFile(folder_ / longest), "newer");
    EXPECT_THAT(errorOf([&] { checkWritable(folder_ / (longest + "x")); }), HasSubstr("File name too long"));
}

TEST_F(FileTest, AFileOfAFolderWithoutPermissionIsWrittenInPlace) {
    write(folder_ / "f", "a longer old file");
    // Root has all permissions.
    const int status = asAnotherUser([&] {
        ::chmod((folder_ / "f").c_str(), 0666);
        ::chmod(folder_.c_str(), 0555);
        checkWritable(folder_ / "f");
        writeFile(folder_ / "f", "new");
        if (errorOf([&] { checkWritable(folder_ / "none"); }).find("Permission denied") == std::string::npos)
            return 3;
        return 0;
    });
    ::chmod(folder_.c_str(), 0755);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(readFile(folder_ / "f"), "new");
    EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(FileTest, OnlyOnesOwnLinksInASharedFolderAreFollowed) {
    write(folder_ / "victim", "old");
    fs::create_directory(folder_ / "shared");
    ASSERT_EQ(::chmod((folder_ / "shared").c_str(), 01777), 0);
    fs::create_symlink("../victim", folder_ / "shared/link");
    EXPECT_EQ(errorOf([&] { checkWritable(folder_ / "shared/link"); }), "");
    writeFile(folder_ / "shared/link", "mine");
    EXPECT_EQ(readFile(folder_ / "victim"), "mine");
    if (::geteuid() != 0) return;  // only root can make another user's link
    ASSERT_EQ(::lchown((folder_ / "shared/link").c_str(), kNobody, kNobody), 0);
    EXPECT_THAT(errorOf([&] { writeFile(folder_ / "shared/link", "new"); }), HasSubstr("Permission denied"));
    EXPECT_EQ(readFile(folder_ / "victim"), "mine");
}

TEST_F(FileTest, TheOwnerStaysWherePermitted) {
    write(folder_ / "f", "old");
    // Unprivileged users may give a file to another of their groups, if they have any.
    uid_t user = ::geteuid();
    gid_t group = ::getegid();
    std::array<gid_t, 256> groups{};
    const int count = ::getgroups(static_cast<int>(groups.size()), groups.data());
    ASSERT_GE(count, 0);
    if (user == 0) {
        user = group = kNobody;
    } else {
        const auto others = std::span(groups).first(static_cast<std::size_t>(count));
        const auto other = std::ranges::find_if(others, [&](gid_t g) { return g != group; });
        if (other != others.end()) group = *other;
    }
    ASSERT_EQ(::chown((folder_ / "f").c_str(), user, group), 0);
    writeFile(folder_ / "f", "new");
    struct stat status {};
    ASSERT_EQ(::stat((folder_ / "f").c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, user);
    EXPECT_EQ(status.st_gid, group);
}

TEST_F(FileTest, AMountedFileIsWrittenInPlace) {
    write(folder_ / "outside", "a longer old file");
    write(folder_ / "inside", "");
    const int status = whereMountsArePrivate([&] {
        const fs::path outside = folder_ / "outside", inside = folder_ / "inside";
        if (::mount(outside.c_str(), inside.c_str(), nullptr, MS_BIND, nullptr) != 0) return 105;
        checkWritable(inside);
        writeFile(inside, "new");
        return readFile(inside) == "new" ? 0 : 1;
    });
    EXPECT_EQ(status, 0) << "exit status " << WEXITSTATUS(status);
    EXPECT_EQ(readFile(folder_ / "inside"), "");
    EXPECT_EQ(readFile(folder_ / "outside"), "new");
    EXPECT_EQ(filesInFolder(), 2u);
}

TEST_F(FileTest, WhatIsOpenAlreadyIsAppendedTo) {
    const int file = ::open((folder_ / "out").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    ASSERT_EQ(::write(file, "first ", 6), 6);
    fs::create_symlink("/proc/self/fd/" + std::to_string(file), folder_ / "link");
    writeFile(folder_ / "link", "second ");
    ASSERT_EQ(::lseek(file, 0, SEEK_END), 13);
    ::close(file);
    EXPECT_EQ(readFile(folder_ / "out"), "first second ");
}

TEST_F(FileTest, ALinkStaysOne) {
    write(folder_ / "old", "old");
    fs::create_symlink("old", folder_ / "link");
    writeFile(folder_ / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    EXPECT_EQ(readFile(folder_ / "old"), "new");
    EXPECT_EQ(filesInFolder(), 2u);
}

TEST_F(FileTest, APipeStaysOneAndIsWrittenIntoOnceAllIsThere) {
    const auto half = [](FileWriter& file) {
        file.write("half of the b");
        throw std::runtime_error("disk on fire");
    };
    const fs::path pipe = folder_ / "pipe.exr";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    checkWritable(pipe);
    EXPECT_EQ(errorOf([&] { writeFileAtomically(pipe, half); }),
              pipe.string() + ": cannot write: disk on fire");
    writeFile(pipe, "bytes");
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
        writeFileAtomically(path, [&](FileWriter& file) {
            file.write("half of the n");
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
    const auto fail = [](FileWriter&) { throw InputError("scene.json", "", "is odd", ""); };
    EXPECT_THROW(writeFileAtomically(folder_ / "f", fail), InputError);
    EXPECT_EQ(filesInFolder(), 0u);
}

/// Opening a pipe for reading would wait for a writer.
TEST_F(FileTest, ReadingRefusesWhatIsNoFile) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const auto& [path, problem] :
         {std::pair(pipe, "is a pipe or a device"), std::pair(fs::path("/dev/zero"), "is a pipe or a device"),
          std::pair(folder_, "is a directory"), std::pair(folder_ / "none", "cannot open: No such file")}) {
        try {
            readFile(path);
            ADD_FAILURE() << path;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(problem)) << path;
        }
    }
}

}  // namespace
}  // namespace duolux
