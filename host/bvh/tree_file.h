#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "host/bvh/wide_bvh.h"

namespace duolux {

/// A 128-bit hash.
using TreeKey = std::array<std::uint64_t, 2>;

/// The key of the tree that this program builds over some triangles. It depends on all input of the builder
/// and on the builder's source code.
TreeKey treeKey(const Geometry& geometry, std::span<const std::uint32_t> triangles);

/// Writes a tree to an open file, in this machine's byte order. Returns whether it was written completely.
bool writeTree(int file, const WideBvh& tree, const TreeKey& key);

/// Number of bytes that writeTree writes.
std::uint64_t treeFileBytes(const WideBvh& tree);

/// Whether a file begins like a tree file of any version of this program.
bool isTreeFile(const std::filesystem::path& path);

/// Reads the tree over `triangles` that was written with this key. Empty if the file holds anything else or
/// belongs to another user. Whatever the file holds, a returned tree has each triangle in exactly one leaf,
/// pairs with a common edge, each node reached once, and a depth within kMaxTreeDepth.
std::optional<WideBvh> readTree(const std::filesystem::path& path, const TreeKey& key,
                                const Geometry& geometry, std::span<const std::uint32_t> triangles);

}  // namespace duolux
