#include "host/bvh/tree_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "host/bvh/tree_file.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kExtension = ".tree";
constexpr std::string_view kTemporary = ".XXXXXX";  // suffix of incomplete files

bool isOwnName(std::string_view name) {
    constexpr std::size_t kDigits = 32;
    const std::size_t size = kDigits + kExtension.size();
    return (name.size() == size || name.size() == size + kTemporary.size()) &&
           name.find_first_not_of("0123456789abcdef") == kDigits &&
           name.substr(kDigits, kExtension.size()) == kExtension;
}

/// Whether only this user can read and write files in the folder.
bool isOwnFolder(const fs::path& folder) {
    struct stat status {};
    return ::stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
           (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

}  // namespace

WideBvh TreeCache::tree(const Geometry& geometry, std::span<const std::uint32_t> triangles) const {
    const TreeKey key = treeKey(geometry, triangles);
    const fs::path path = folder_ / fmt::format("{:016x}{:016x}{}", key[1], key[0], kExtension);
    std::optional<WideBvh> kept;
    if (isOwnFolder(folder_)) kept = readTree(path, key, geometry, triangles);
    if (kept) {
        std::error_code ignored;
        fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
        return std::move(*kept);
    }
    WideBvh built = buildWideBvh(geometry, triangles);
    keep(path, built, key);
    return built;
}

void TreeCache::keep(const fs::path& path, const WideBvh& tree, const TreeKey& key) const {
    if (treeFileBytes(tree) > mostBytes_) return;
    std::error_code ignored;
    fs::create_directories(folder_.parent_path(), ignored);
    ::mkdir(folder_.c_str(), 0700);
    if (!isOwnFolder(folder_)) return;
    std::string temporary = path.string().append(kTemporary);
    const int file = ::mkstemp(temporary.data());
    if (file < 0) return;
    // No fsync: a file damaged by a power failure fails its checksum, and the tree is built again.
    const bool written = writeTree(file, tree, key);
    if (::close(file) != 0 || !written || ::rename(temporary.c_str(), path.c_str()) != 0) {
        ::unlink(temporary.c_str());
        return;
    }
    makeRoom();
}

void TreeCache::makeRoom() const {
    struct File {
        fs::file_time_type used;
        std::uint64_t bytes;
        fs::path path;
    };
    std::vector<File> files;
    std::uint64_t total = 0;
    // Other processes may delete files at the same time.
    std::error_code error;
    for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
        if (!isOwnName(entry->path().filename().string()) || !isTreeFile(entry->path())) continue;
        std::error_code gone;
        const std::uint64_t bytes = entry->file_size(gone);
        const fs::file_time_type used = entry->last_write_time(gone);
        if (gone) continue;
        files.push_back({used, bytes, entry->path()});
        total += bytes;
    }
    std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.used < b.used; });
    for (const File& file : files) {
        if (total <= mostBytes_) return;
        fs::remove(file.path, error);
        total -= file.bytes;
    }
}

WideBvh cachedWideBvh(const fs::path& folder, const Geometry& geometry,
                      std::span<const std::uint32_t> triangles) {
    const bool kept = !folder.empty() && triangles.size() >= TreeCache::kFewestTriangles;
    return kept ? TreeCache(folder).tree(geometry, triangles) : buildWideBvh(geometry, triangles);
}

}  // namespace duolux
