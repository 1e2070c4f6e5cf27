#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <vector>

#include "host/base/temporary_folder.h"
#include "host/bvh/tree_cache.h"
#include "host/bvh/tree_file.h"
#include "host/generators/icosphere.h"

namespace duolux {

inline Geometry sphere(std::uint32_t frequency) {
    const Icosphere icosphere = makeIcosphere(frequency);
    Geometry geometry;
    geometry.positions.assign(icosphere.positions.begin(), icosphere.positions.end());
    geometry.triangles = icosphere.triangles;
    return geometry;
}

inline void expectSame(const WideBvh& a, const WideBvh& b) {
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    EXPECT_EQ(std::memcmp(a.nodes.data(), b.nodes.data(), std::span(a.nodes).size_bytes()), 0);
    EXPECT_EQ(a.pairs, b.pairs);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.sahCost, b.sahCost);
}

class TreeCacheTest : public testing::Test {
  protected:
    WideBvh get(std::uint64_t mostBytes = TreeCache::kMostBytes) const {
        return TreeCache(cache_, mostBytes).tree(geometry_, triangles_);
    }

    std::vector<std::filesystem::path> files() const {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::directory_iterator(cache_))
            found.push_back(entry.path());
        return found;
    }

    /// A file that holds another tree than this geometry has shows whether it is read.
    void keepInstead(const WideBvh& tree, const std::filesystem::path& path) const {
        const int file = ::open(path.c_str(), O_WRONLY | O_TRUNC);
        ASSERT_TRUE(writeTree(file, tree, treeKey(geometry_, triangles_)));
        ::close(file);
    }

    /// Whether a tree is good enough to be returned, and that a bad one's file is replaced.
    bool accepted(const WideBvh& tree) const {
        get();
        const std::filesystem::path path = files().at(0);
        keepInstead(tree, path);
        const bool read = readTree(path, treeKey(geometry_, triangles_), geometry_, triangles_).has_value();
        if (!read) {
            expectSame(get(), built_);
            EXPECT_TRUE(readTree(path, treeKey(geometry_, triangles_), geometry_, triangles_).has_value());
        }
        return read;
    }

    TemporaryFolder folder_;
    std::filesystem::path cache_ = folder_ / "a" / "duolux";
    Geometry geometry_ = sphere(8);
    std::vector<std::uint32_t> triangles_ = allTriangles(geometry_);
    WideBvh built_ = buildWideBvh(geometry_, triangles_);
};

}  // namespace duolux
