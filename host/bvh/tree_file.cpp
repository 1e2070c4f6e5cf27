#include "host/bvh/tree_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <type_traits>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace duolux {

namespace {

/// The header of a file. The nodes follow, then the pairs.
struct Header {
    char magic[8];
    TreeKey key;
    std::uint64_t nodes, pairs;
    double sahCost;
    std::uint64_t depth;
    TreeKey checksum;  ///< of the remaining bytes of the file
};
static_assert(sizeof(Header) == 72 && std::is_trivially_copyable_v<Header>);

constexpr char kMagic[8] = {'D', 'u', 'o', 'l',
                            'u', 'x', 'T', '2'};  // the last character is the format's version

/// XXH3 with 128 bits (Collet 2020), which is as fast as memory.
class Hash {
  public:
    Hash() { XXH3_128bits_reset(&state_); }

    template <typename T>
    void add(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        XXH3_128bits_update(&state_, values.data(), values.size_bytes());
    }

    TreeKey result() const {
        const XXH128_hash_t hash = XXH3_128bits_digest(&state_);
        return {hash.low64, hash.high64};
    }

  private:
    XXH3_state_t state_;
};

TreeKey checksumOf(Header header, const WideBvh& tree) {
    header.checksum = {};
    Hash hash;
    hash.add(std::span<const Header>(&header, 1));
    hash.add(std::span<const shared::WideNode>(tree.nodes));
    hash.add(std::span<const TrianglePair>(tree.pairs));
    return hash.result();
}

/// Calls read() or write() until all bytes are transferred or a call fails.
template <typename Call, typename Byte>
bool passAll(Call call, int file, Byte* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t passed = call(file, bytes, count);
        if (passed < 0 && errno == EINTR) continue;
        if (passed <= 0) return false;
        bytes += passed;
        count -= static_cast<std::size_t>(passed);
    }
    return true;
}

template <typename T>
bool writeAll(int file, std::span<const T> values) {
    return passAll(::write, file, reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

template <typename T>
bool readAll(int file, std::span<T> values) {
    return passAll(::read, file, reinterpret_cast<char*>(values.data()), values.size_bytes());
}

/// Whether the leaves hold each of the triangles exactly once, and every pair has a common edge.
bool holdsJust(const WideBvh& tree, const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    const std::uint32_t most = *std::max_element(triangles.begin(), triangles.end());
    std::vector<char> wanted(std::size_t{most} + 1, 0);
    for (const std::uint32_t triangle : triangles)
        wanted[triangle] = 1;
    std::size_t found = 0;
    const auto find = [&](std::uint32_t triangle) {
        if (triangle > most || wanted[triangle] == 0) return false;
        wanted[triangle] = 0;
        ++found;
        return true;
    };
    for (const TrianglePair& pair : tree.pairs) {
        if (!find(pair.first)) return false;
        if (!pair.isSingle() && (!find(pair.second) || !cornersOf(geometry, pair))) return false;
    }
    return found == triangles.size();
}

/// Whether a traversal terminates and stays within the arrays and its stack. Children must follow their
/// parents.
bool isTree(const WideBvh& tree) {
    const std::size_t nodes = tree.nodes.size();
    std::vector<std::uint8_t> level(nodes, 0);
    std::vector<char> entrySeen(tree.pairs.size(), 0);
    level[0] = 1;
    std::uint32_t deepest = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
        const shared::WideNode& node = tree.nodes[i];
        if (level[i] == 0 || level[i] > shared::kMaxTreeDepth) return false;
        deepest = std::max<std::uint32_t>(deepest, level[i]);
        std::uint64_t child = node.childBase;
        for (unsigned slot = 0; slot < 8; ++slot) {
            const unsigned meta = node.meta[slot];
            if ((node.innerMask >> slot & 1) != 0) {
                if (meta != (shared::kMetaInner | (24 + slot))) return false;
                if (child <= i || child >= nodes || level[child] != 0) return false;
                level[child++] = static_cast<std::uint8_t>(level[i] + 1);
                continue;
            }
            if (meta == 0) continue;
            const unsigned unary = meta >> 5;
            if (unary != 1 && unary != 3 && unary != 7) return false;
            for (int k = 0; k < std::popcount(unary); ++k) {
                const std::uint64_t entry =
                    std::uint64_t{node.pairBase} + (meta & 31) + static_cast<unsigned>(k);
                if (entry >= entrySeen.size() || entrySeen[entry] != 0) return false;
                entrySeen[entry] = 1;
            }
        }
    }
    return deepest == tree.depth && std::find(entrySeen.begin(), entrySeen.end(), 0) == entrySeen.end();
}

/// Closes the file at the end of its scope.
struct OpenFile {
    int descriptor = -1;

    /// Opens a regular file for reading. O_NONBLOCK: opening a pipe or a device must not block.
    explicit OpenFile(const std::filesystem::path& path)
        : descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW)) {}
    ~OpenFile() {
        if (descriptor >= 0) ::close(descriptor);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    struct stat status() const {
        struct stat result {};
        static_cast<void>(::fstat(descriptor, &result));
        return result;
    }
};

}  // namespace

TreeKey treeKey(const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    const std::uint64_t sizes[] = {geometry.positions.size(), geometry.triangles.size(), triangles.size()};
    Hash hash;
    hash.add(std::span<const char>(DUOLUX_TREE_BUILDER, sizeof(DUOLUX_TREE_BUILDER)));
    hash.add(std::span<const std::uint64_t>(sizes));
    hash.add(std::span<const glm::vec3>(geometry.positions));
    hash.add(std::span<const glm::uvec3>(geometry.triangles));
    hash.add(triangles);
    return hash.result();
}

std::uint64_t treeFileBytes(const WideBvh& tree) {
    return sizeof(Header) + std::span(tree.nodes).size_bytes() + std::span(tree.pairs).size_bytes();
}

bool writeTree(int file, const WideBvh& tree, const TreeKey& key) {
    Header header{{}, key, tree.nodes.size(), tree.pairs.size(), tree.sahCost, tree.depth, {}};
    std::memcpy(header.magic, kMagic, sizeof(kMagic));
    header.checksum = checksumOf(header, tree);
    return writeAll(file, std::span<const Header>(&header, 1)) &&
           writeAll(file, std::span<const shared::WideNode>(tree.nodes)) &&
           writeAll(file, std::span<const TrianglePair>(tree.pairs));
}

bool isTreeFile(const std::filesystem::path& path) {
    const OpenFile file(path);
    char magic[sizeof(kMagic)];
    return S_ISREG(file.status().st_mode) && readAll(file.descriptor, std::span<char>(magic)) &&
           std::memcmp(magic, kMagic, sizeof(kMagic) - 1) == 0;
}

std::optional<WideBvh> readTree(const std::filesystem::path& path, const TreeKey& key,
                                const Geometry& geometry, std::span<const std::uint32_t> triangles) {
    const OpenFile file(path);
    const struct stat status = file.status();
    if (!S_ISREG(status.st_mode) || status.st_uid != ::geteuid()) return {};
    Header header{};
    if (!readAll(file.descriptor, std::span<Header>(&header, 1))) return {};
    if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0 || header.key != key) return {};
    if (header.pairs > triangles.size() || header.nodes == 0 || header.nodes > triangles.size()) return {};
    WideBvh tree;
    tree.depth = static_cast<std::uint32_t>(header.depth);
    tree.sahCost = header.sahCost;
    const std::uint64_t bytes =
        sizeof(Header) + header.nodes * sizeof(shared::WideNode) + header.pairs * sizeof(TrianglePair);
    if (static_cast<std::uint64_t>(status.st_size) != bytes) return {};
    tree.nodes.resize(header.nodes);
    tree.pairs.resize(header.pairs);
    if (!readAll(file.descriptor, std::span(tree.nodes)) ||
        !readAll(file.descriptor, std::span(tree.pairs)) || checksumOf(header, tree) != header.checksum ||
        !holdsJust(tree, geometry, triangles) || !isTree(tree))
        return {};
    return tree;
}

}  // namespace duolux
