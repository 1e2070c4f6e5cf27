#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "host/bvh/wide_bvh.h"

namespace duolux {

/// 128 bits that tell contents apart.
using TreeKey = std::array<std::uint64_t, 2>;

/// Of the tree that this program builds over some triangles: depends on all that the builder reads, and on
/// the builder's sources.
TreeKey treeKey(const Geometry& geometry, std::span<const std::uint32_t> triangles);

/// Writes a tree for this machine to an open file. Returns whether all of it is there.
bool writeTree(int file, const WideBvh& tree, const TreeKey& key);

/// Bytes that writeTree takes.
std::uint64_t treeFileBytes(const WideBvh& tree);

/// Whether a file begins like one that this program, of whatever version, writes trees to.
bool isTreeFile(const std::filesystem::path& path);

/// The tree over `triangles` of the geometry that was written with this key; none if the file is not just
/// that, or is another user's. Whatever a file holds, a tree that is returned has each triangle in one leaf,
/// neighbours in pairs, each node reached once, and a depth within kMaxTreeDepth.
std::optional<WideBvh> readTree(const std::filesystem::path& path, const TreeKey& key,
                                const Geometry& geometry, std::span<const std::uint32_t> triangles);

}  // namespace duolux
