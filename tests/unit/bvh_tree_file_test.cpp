#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "host/base/file.h"
#include "tests/unit/bvh_tree_cache.h"

// What a cached tree's file holds, and which files are not believed.

namespace duolux {
namespace {

namespace fs = std::filesystem;

TEST_F(TreeCacheTest, TellsContentsApart) {
    const TreeKey key = treeKey(geometry_, triangles_);
    EXPECT_EQ(treeKey(geometry_, triangles_), key);
    Geometry moved = geometry_;
    moved.positions.back().z = std::nextafter(moved.positions.back().z, 2.0f);
    EXPECT_NE(treeKey(moved, triangles_), key);
    Geometry turned = geometry_;
    std::swap(turned.triangles[7].x, turned.triangles[7].y);
    EXPECT_NE(treeKey(turned, triangles_), key);
    const std::span<const std::uint32_t> all(triangles_);
    EXPECT_NE(treeKey(geometry_, all.first(10)), key);
    EXPECT_NE(treeKey(geometry_, all.first(10)), treeKey(geometry_, all.last(10)));
    // Materials are no part of a tree.
    Geometry painted = geometry_;
    painted.materials.assign(painted.triangles.size(), 3);
    EXPECT_EQ(treeKey(painted, triangles_), key);
    get();
    expectSame(TreeCache(cache_).tree(moved, triangles_), buildWideBvh(moved, triangles_));
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(TreeCacheTest, HoldsTreesOverASubset) {
    triangles_ = {3, 5, 8, 13, 21, 34, 55, 89, 144, 1279};
    const WideBvh built = buildWideBvh(geometry_, triangles_);
    expectSame(get(), built);
    expectSame(get(), built);
    EXPECT_EQ(files().size(), 1u);
}

TEST_F(TreeCacheTest, BuildsAgainWhatIsCorrupt) {
    get();
    const fs::path path = files().at(0);
    const std::string good = readFile(path);
    const TreeKey key = treeKey(geometry_, triangles_);
    const auto replaced = [&](const std::string& bytes) {
        writeFile(path, bytes);
        EXPECT_FALSE(readTree(path, key, geometry_, triangles_).has_value());
        expectSame(get(), built_);
        EXPECT_EQ(readFile(path), good);
    };
    for (std::size_t at = 0; at < good.size(); at += at < 80 ? 1 : 97) {
        SCOPED_TRACE(at);
        std::string bytes = good;
        bytes[at] = static_cast<char>(bytes[at] ^ 1 << at % 8);
        replaced(bytes);
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{71}, std::size_t{72}, good.size() - 1})
        replaced(good.substr(0, size));
    replaced(good + "x");
    // Another scene's tree.
    const Geometry other = sphere(9);
    const std::vector<std::uint32_t> all = allTriangles(other);
    TreeCache(folder_ / "other").tree(other, all);
    replaced(readFile(fs::directory_iterator(folder_ / "other")->path()));
}

/// With a checksum that fits.
TEST_F(TreeCacheTest, ReturnsNoTreeThatLeadsATraversalAstray) {
    ASSERT_TRUE(accepted(built_));
    const auto refused = [&](const auto& change) {
        WideBvh tree = built_;
        change(tree);
        return !accepted(tree);
    };
    const auto slotOf = [&](const shared::WideNode& node, bool inner) {
        for (std::size_t slot = 0; slot < 8; ++slot) {
            if (node.meta[slot] != 0 && ((node.innerMask >> slot & 1) != 0) == inner) return slot;
        }
        ADD_FAILURE() << "no such child";
        return std::size_t{0};
    };
    const auto last = static_cast<std::uint32_t>(built_.nodes.size() - 1);
    EXPECT_TRUE(refused([](WideBvh& t) { t.pairs[3].first = 0xffffffffu; })) << "out of range";
    EXPECT_TRUE(refused([](WideBvh& t) { t.pairs[3].second = 1280; })) << "one too far";
    EXPECT_TRUE(refused([](WideBvh& t) { t.pairs[3] = t.pairs[4]; })) << "twice";
    EXPECT_TRUE(refused([](WideBvh& t) { t.pairs[3].second = t.pairs[3].first; })) << "a pair with itself";
    EXPECT_TRUE(refused([](WideBvh& t) { std::swap(t.pairs[3].second, t.pairs[9].second); }))
        << "pairs without a common edge";
    EXPECT_TRUE(refused([](WideBvh& t) { t.pairs[3].second = TrianglePair::kNone; })) << "half a pair";
    EXPECT_TRUE(refused([](WideBvh& t) { t.nodes[0].childBase = 0; })) << "a cycle";
    EXPECT_TRUE(refused([](WideBvh& t) { t.nodes[0].childBase += 1; })) << "another child";
    EXPECT_TRUE(refused([&](WideBvh& t) { t.nodes[0].childBase = last; })) << "children past the end";
    EXPECT_TRUE(refused([](WideBvh& t) { t.nodes[0].childBase = 0xfffffffcu; })) << "children that wrap";
    EXPECT_TRUE(refused([&](WideBvh& t) { t.nodes[last].pairBase += 1; })) << "another leaf's pair";
    EXPECT_TRUE(refused([&](WideBvh& t) { t.nodes[last].pairBase = 0xffffffffu; })) << "a leaf past the end";
    EXPECT_TRUE(refused([&](WideBvh& t) {
        auto& meta = t.nodes[last].meta[slotOf(t.nodes[last], false)];
        meta = static_cast<std::uint8_t>((meta & 31) | 5 << 5);
    })) << "a count that is none";
    EXPECT_TRUE(refused([&](WideBvh& t) { t.nodes[0].meta[slotOf(t.nodes[0], true)] ^= 1; }))
        << "another slot";
    EXPECT_TRUE(refused([&](WideBvh& t) { t.nodes[0].meta[slotOf(t.nodes[0], true)] = 0; })) << "no child";
    EXPECT_TRUE(refused([](WideBvh& t) { t.depth += 1; })) << "another depth";
    EXPECT_TRUE(refused([](WideBvh& t) { t.nodes.push_back({}); })) << "a node that nothing leads to";
    EXPECT_TRUE(refused([](WideBvh& t) { t.pairs.pop_back(); })) << "a pair less";
}

/// The stack of a traversal has a place for each level.
TEST_F(TreeCacheTest, ReturnsNoTreeThatIsTooDeep) {
    for (const std::uint32_t depth : {shared::kMaxTreeDepth + 1, shared::kMaxTreeDepth}) {
        triangles_.resize(2 * depth);
        built_ = buildWideBvh(geometry_, triangles_);
        std::vector<TrianglePair> singles;
        for (const std::uint32_t triangle : triangles_)
            singles.push_back({triangle});
        WideBvh chain{std::vector<shared::WideNode>(depth), singles, depth, 1.0};
        for (std::uint32_t i = 0; i < depth; ++i) {
            shared::WideNode& node = chain.nodes[i];
            node.pairBase = 2 * i;
            node.meta[1] = 3 << 5;
            if (i + 1 == depth) continue;
            node.innerMask = 1;
            node.meta[0] = shared::kMetaInner | 24;
            node.childBase = i + 1;
        }
        fs::remove_all(cache_);
        EXPECT_EQ(accepted(chain), depth == shared::kMaxTreeDepth);
    }
}

}  // namespace
}  // namespace duolux
