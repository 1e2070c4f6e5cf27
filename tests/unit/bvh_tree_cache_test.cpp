#include "tests/unit/bvh_tree_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <thread>

#include "host/base/file.h"

// The folder of cached trees: what is kept there, for how long, and whose files it may be.

namespace duolux {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

TEST_F(TreeCacheTest, KeepsWhatTheBuilderBuilds) {
    expectSame(get(), built_);
    ASSERT_EQ(files().size(), 1u);
    EXPECT_EQ(fs::file_size(files()[0]), treeFileBytes(built_));
    expectSame(get(), built_);
    // The tree is read from the file.
    WideBvh other = built_;
    other.nodes[0].upper[0][0] ^= 1;
    keepInstead(other, files()[0]);
    expectSame(get(), other);
    // Other users cannot read it.
    EXPECT_EQ(fs::status(cache_).permissions(), fs::perms::owner_all);
}

TEST_F(TreeCacheTest, DoesWithoutAFolderThatCannotBeUsed) {
    writeFile(folder_ / "a", "a file where the folder should be");
    expectSame(get(), built_);
    cache_ = "/proc/duolux";
    expectSame(get(), built_);
    cache_ = "/dev/full/duolux";
    expectSame(get(), built_);
}

TEST_F(TreeCacheTest, DoesWithoutAFolderThatIsReadOnly) {
    fs::create_directories(cache_);
    fs::permissions(cache_, fs::perms::owner_read | fs::perms::owner_exec);
    // Nothing is read-only for root.
    const pid_t child = ::fork();
    if (child == 0) {
        if (::geteuid() == 0 && (::chmod(folder_.path().c_str(), 0755) != 0 || ::seteuid(65534) != 0))
            ::_exit(2);
        const WideBvh tree = get();
        ::_exit(tree.pairs == built_.pairs ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    fs::permissions(cache_, fs::perms::owner_all);
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(TreeCacheTest, LeavesNothingOfAFileThatDidNotFit) {
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit small{1000, 1000};
        ::signal(SIGXFSZ, SIG_IGN);
        if (::setrlimit(RLIMIT_FSIZE, &small) != 0) ::_exit(2);
        ::_exit(get().pairs == built_.pairs ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(TreeCacheTest, DeletesWhatWasNotUsedForLongest) {
    std::vector<Geometry> geometries;
    for (const float x : {0.0f, 1.0f, 2.0f, 3.0f}) {
        geometries.push_back(geometry_);
        for (glm::vec3& p : geometries.back().positions)
            p.x += x;
    }
    const TreeCache cache(cache_, 3 * treeFileBytes(built_) + treeFileBytes(built_) / 2);
    const auto ask = [&](std::size_t i) {
        cache.tree(geometries[i], triangles_);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));  // file systems' clocks may be coarse
    };
    const auto kept = [&](std::size_t i) {
        const TreeKey key = treeKey(geometries[i], triangles_);
        for (const fs::path& file : files()) {
            if (readTree(file, key, geometries[i], triangles_)) return true;
        }
        return false;
    };
    for (const std::size_t i : {0, 1, 2, 0})
        ask(i);
    EXPECT_EQ(files().size(), 3u);
    ask(3);
    EXPECT_EQ(files().size(), 3u);
    EXPECT_TRUE(kept(0));
    EXPECT_FALSE(kept(1));
    EXPECT_TRUE(kept(2));
    EXPECT_TRUE(kept(3));
}

TEST_F(TreeCacheTest, DeletesNoFilesOfTheUser) {
    fs::create_directories(cache_);
    fs::permissions(cache_, fs::perms::owner_all);
    const std::string name(32, '0');
    get();
    const std::string tree = readFile(files().at(0));
    const std::map<std::string, std::string> others{
        {"thesis.txt", "text"},           {name + ".tree", "of the right name"}, {name + ".exr", tree},
        {name.substr(1) + ".tree", tree}, {name + ".tree.1234567", tree},        {"new-XXXXXX", tree}};
    for (const auto& [file, bytes] : others)
        writeFile(cache_ / file, bytes);
    fs::create_symlink("thesis.txt", cache_ / (std::string(32, '1') + ".tree"));
    writeFile(cache_ / (name + ".tree.abcdef"), tree);  // left by a process that was killed
    const auto past = fs::file_time_type::clock::now() - std::chrono::hours(1000);
    for (const fs::path& file : files()) {
        if (!fs::is_symlink(file)) fs::last_write_time(file, past);
    }
    geometry_.positions[0].x += 1.0f;
    const WideBvh built = buildWideBvh(geometry_, triangles_);
    expectSame(get(treeFileBytes(built)), built);
    for (const auto& [file, bytes] : others)
        EXPECT_EQ(readFile(cache_ / file), bytes) << file;
    EXPECT_EQ(files().size(), others.size() + 2) << "the link and the new tree";
}

TEST_F(TreeCacheTest, DoesWithoutAFolderThatOthersMayChange) {
    get();
    WideBvh other = built_;
    other.nodes[0].upper[0][0] ^= 1;
    keepInstead(other, files()[0]);
    expectSame(get(), other);
    for (const fs::perms writer : {fs::perms::group_write, fs::perms::others_write}) {
        fs::permissions(cache_, fs::perms::owner_all | writer);
        expectSame(get(), built_);
    }
    fs::permissions(cache_, fs::perms::owner_all);
    if (::geteuid() != 0) return;
    constexpr uid_t kNobody = 65534;
    ASSERT_EQ(::chown(cache_.c_str(), kNobody, kNobody), 0);
    expectSame(get(), built_);
    ASSERT_EQ(::chown(cache_.c_str(), 0, 0), 0);
    expectSame(get(), other);
    ASSERT_EQ(::chown(files()[0].c_str(), kNobody, kNobody), 0);
    expectSame(get(), built_);
}

TEST_F(TreeCacheTest, KeepsNothingLargerThanAllMayBe) {
    expectSame(get(treeFileBytes(built_) - 1), built_);
    EXPECT_FALSE(fs::exists(cache_));
}

TEST_F(TreeCacheTest, IsSharedByProcesses) {
    // With room for only one of the two trees: each process writes, reads and deletes at the same time as the
    // others.
    const Geometry other = sphere(7);
    const std::vector<std::uint32_t> all = allTriangles(other);
    const WideBvh otherBuilt = buildWideBvh(other, all);
    const TreeCache cache(cache_, treeFileBytes(built_) + 100);
    std::vector<pid_t> children;
    for (int process = 0; process < 4; ++process) {
        children.push_back(::fork());
        if (children.back() != 0) continue;
        for (int i = 0; i < 50; ++i) {
            if (cache.tree(geometry_, triangles_).pairs != built_.pairs) ::_exit(1);
            if (cache.tree(other, all).pairs != otherBuilt.pairs) ::_exit(1);
        }
        ::_exit(0);
    }
    for (const pid_t child : children) {
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
    for (const fs::path& file : files())
        EXPECT_EQ(file.extension(), ".tree");
}

/// What uploads of scenes use.
TEST_F(TreeCacheTest, HoldsTreesOfLargeScenes) {
    geometry_ = sphere(58);  // 67,280 triangles
    triangles_ = allTriangles(geometry_);
    const WideBvh built = cachedWideBvh({}, geometry_, triangles_);
    EXPECT_FALSE(fs::exists(cache_));
    expectSame(cachedWideBvh(cache_, geometry_, triangles_), built);
    EXPECT_EQ(files().size(), 1u);
    expectSame(cachedWideBvh(cache_, geometry_, triangles_), built);
    EXPECT_EQ(files().size(), 1u);
    triangles_.resize(TreeCache::kFewestTriangles - 1);
    cachedWideBvh(cache_, geometry_, triangles_);
    EXPECT_EQ(files().size(), 1u);
}

}  // namespace
}  // namespace duolux
