#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "host/bvh/wide_bvh.h"

namespace duolux {

/// Keeps built trees on disk, each in a file named by a hash of its content. Never fails: if a tree cannot be
/// read, it is built. Processes may share a folder. Files with other names or another header are never
/// touched. A folder that another user owns or can write to is not used.
class TreeCache {
  public:
    /// Building a smaller tree takes about as long as reading it.
    static constexpr std::size_t kFewestTriangles = 1u << 16;
    static constexpr std::uint64_t kMostBytes = 1ull << 30;

    /// `folder` need not exist. `mostBytes`: limit on the size of all trees; beyond it, the least recently
    /// used trees are deleted.
    explicit TreeCache(std::filesystem::path folder, std::uint64_t mostBytes = kMostBytes)
        : folder_(std::move(folder)), mostBytes_(mostBytes) {}

    /// The tree of buildWideBvh(geometry, triangles), read from the folder or built.
    WideBvh tree(const Geometry& geometry, std::span<const std::uint32_t> triangles) const;

  private:
    void keep(const std::filesystem::path& path, const WideBvh& tree,
              const std::array<std::uint64_t, 2>& key) const;
    void makeRoom() const;

    std::filesystem::path folder_;
    std::uint64_t mostBytes_;
};

/// The tree of buildWideBvh(geometry, triangles). Trees of at least kFewestTriangles triangles are kept in
/// `folder`, unless that is empty.
WideBvh cachedWideBvh(const std::filesystem::path& folder, const Geometry& geometry,
                      std::span<const std::uint32_t> triangles);

}  // namespace duolux
