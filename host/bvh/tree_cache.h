#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "host/bvh/wide_bvh.h"

namespace duolux {

/// Keeps built trees on disk, each in a file named by its content. Never fails: without the file, it builds.
/// Processes may share a folder. Files of other names, or that begin otherwise, are never touched; a folder
/// that another user owns, or may write to, is not used.
class TreeCache {
  public:
    /// Trees of fewer triangles are built about as fast as they are read.
    static constexpr std::size_t kFewestTriangles = 1u << 16;
    static constexpr std::uint64_t kMostBytes = 1ull << 30;

    /// `folder` need not exist. `mostBytes`: of all trees; beyond that those not used for longest are
    /// deleted.
    explicit TreeCache(std::filesystem::path folder, std::uint64_t mostBytes = kMostBytes)
        : folder_(std::move(folder)), mostBytes_(mostBytes) {}

    /// $XDG_CACHE_HOME/duolux, or ~/.cache/duolux; none if DUOLUX_NO_CACHE is set or nobody is at home.
    static std::optional<TreeCache> ofUser();

    /// What buildWideBvh would build.
    WideBvh tree(const Geometry& geometry, std::span<const std::uint32_t> triangles) const;

  private:
    void keep(const std::filesystem::path& path, const WideBvh& tree,
              const std::array<std::uint64_t, 2>& key) const;
    void makeRoom() const;

    std::filesystem::path folder_;
    std::uint64_t mostBytes_;
};

/// What buildWideBvh would build, from the user's cache if it is there; of larger scenes kept for the next
/// time.
WideBvh cachedWideBvh(const Geometry& geometry, std::span<const std::uint32_t> triangles);

/// Over all triangles.
WideBvh cachedWideBvh(const Geometry& geometry);

}  // namespace duolux
