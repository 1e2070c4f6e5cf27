#include "host/base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <optional>
#include <random>
#include <system_error>
#include <vector>

#include "host/base/error.h"
#include "host/base/stream.h"

namespace duolux {

namespace fs = std::filesystem;

fs::path folderOf(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

std::string readFile(const fs::path& path) {
    std::error_code ec;
    const fs::file_status status = fs::status(path, ec);
    // Opening a pipe would wait until another program writes to it.
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw InputError(path.string(), "",
                         fs::is_directory(status) ? "is a directory" : "is a pipe or a device",
                         "expected a file");
    }
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) throw InputError(path.string(), "", fmt::format("cannot open: {}", std::strerror(errno)), "");
    std::string bytes;
    in.seekg(0, std::ios::end);
    const std::streamoff size = in.tellg();
    in.seekg(0);
    if (size > 0) {
        bytes.resize(static_cast<std::size_t>(size));
        in.read(bytes.data(), size);
        bytes.resize(static_cast<std::size_t>(in.gcount()));
    }
    if (in.bad()) throw InputError(path.string(), "", "cannot read to the end", "");
    return bytes;
}

namespace {

using Write = std::function<void(FileWriter&)>;

[[noreturn]] void fail(int error) {
    throw std::system_error(error, std::generic_category());
}

struct Descriptor {
    int value;
    ~Descriptor() {
        if (value >= 0) ::close(value);
    }
};

/// Waits until a file or folder is on the disk, if the file system supports this.
void synchroniseDescriptor(int descriptor) {
    if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS) return;
    fail(errno);
}

/// The file to which a path refers.
struct Destination {
    fs::path path;                   ///< after resolving symbolic links
    std::optional<struct stat> old;  ///< the existing file
    bool isStream = false;           ///< a device, a pipe, or a file that is already open: appended to
};

/// Links in /proc represent open files.
bool isInProc(const fs::path& folder) {
    struct statfs status {};
    return ::statfs(folder.c_str(), &status) == 0 && status.f_type == PROC_SUPER_MAGIC;
}

/// In a shared folder such as /tmp, another user's link may lead anywhere. As in the kernel
/// (protected_symlinks), only links of this user and of the folder's owner are followed there.
bool mayFollow(const struct stat& link, const fs::path& folder) {
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0) return false;
    const bool shared = (status.st_mode & S_ISVTX) != 0 && (status.st_mode & S_IWOTH) != 0;
    return !shared || link.st_uid == ::geteuid() || link.st_uid == status.st_uid;
}

Destination destinationOf(const fs::path& name) {
    Destination destination{name, std::nullopt};
    struct stat status {};
    if (::stat(name.c_str(), &status) == 0) {
        destination.old = status;
        if (S_ISDIR(status.st_mode)) fail(EISDIR);
        destination.isStream = !S_ISREG(status.st_mode);
    } else if (errno != ENOENT) {
        fail(errno);
    }
    constexpr int kMostLinks = 40;
    struct stat link {};
    for (int links = 0; !destination.isStream; ++links) {
        fs::path& path = destination.path;
        if (::lstat(path.c_str(), &link) != 0 || !S_ISLNK(link.st_mode)) break;
        if (links == kMostLinks) fail(ELOOP);
        const fs::path folder = folderOf(path);
        if (!mayFollow(link, folder)) fail(EACCES);
        if (isInProc(folder)) {
            destination.isStream = true;
        } else {
            path = path.parent_path() / fs::read_symlink(path);
        }
    }
    return destination;
}

/// Requires permission to write the file itself, although replacing it needs only the folder's permission.
void requirePermission(const Destination& destination) {
    if (!destination.old) return;
    const char* path = destination.path.c_str();
    if (destination.isStream) {
        if (::faccessat(AT_FDCWD, path, W_OK, AT_EACCESS) != 0) fail(errno);
        return;
    }
    constexpr mode_t kWritable = S_IWUSR | S_IWGRP | S_IWOTH;  // root could write without them
    if ((destination.old->st_mode & kWritable) == 0) throw std::runtime_error("the file is write-protected");
    const Descriptor file{::open(path, O_WRONLY | O_NONBLOCK | O_CLOEXEC)};
    if (file.value < 0) fail(errno);
}

/// Whether the error means that the folder accepts no new files; an existing file may still be writable.
bool isFolderForbidden(int error) {
    return error == EACCES || error == EPERM || error == EROFS;
}

/// A new file with an unpredictable name. The destructor removes it unless it was renamed.
class Temporary {
  public:
    /// Throws std::system_error.
    Temporary(const fs::path& folder, mode_t mode) {
        constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
        constexpr int kRandomLetters = 12;
        std::random_device random;
        do {
            std::string name = ".duolux-";
            for (int i = 0; i < kRandomLetters; ++i)
                name += kLetters[random() % kLetters.size()];
            path_ = folder / name;
            descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
        } while (descriptor_ < 0 && errno == EEXIST);
        if (descriptor_ < 0) fail(errno);
        writer_.emplace(descriptor_);
    }
    ~Temporary() {
        if (!path_.empty()) ::unlink(path_.c_str());
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    FileWriter& writer() { return *writer_; }

    /// Copies owner and permissions from the file to be replaced, as far as permitted.
    void takeOver(const struct stat& old) const {
        struct stat own {};
        if (::fstat(descriptor_, &own) == 0 && (own.st_uid != old.st_uid || own.st_gid != old.st_gid) &&
            ::fchown(descriptor_, old.st_uid, old.st_gid) != 0) {
            static_cast<void>(::fchown(descriptor_, static_cast<uid_t>(-1), old.st_gid));
        }
        static_cast<void>(::fchmod(descriptor_, old.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO)));
    }

    /// Returns 0, or the error code of a failed rename.
    int renameTo(const fs::path& path) {
        if (::rename(path_.c_str(), path.c_str()) != 0) return errno;
        path_.clear();
        return 0;
    }

  private:
    fs::path path_;
    int descriptor_ = -1;
    std::optional<FileWriter> writer_;
};

/// Overwrites a file that cannot be replaced, or appends to a stream.
void copyInto(const Destination& destination, int source) {
    const Descriptor target{destination.isStream
                                ? openStream(destination.path)
                                : ::open(destination.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY)};
    if (target.value < 0) fail(errno);
    std::vector<char> bytes(std::size_t{1} << 16);
    off_t at = 0;
    for (ssize_t count = 0; (count = ::pread(source, bytes.data(), bytes.size(), at)) != 0; at += count) {
        if (count < 0) fail(errno);
        writeAll(target.value, bytes.data(), static_cast<std::size_t>(count));
    }
    if (destination.isStream) return;
    if (::ftruncate(target.value, at) != 0) fail(errno);
    synchroniseDescriptor(target.value);
}

/// A file in memory, for contents that are complete before any of them are written to their destination.
int fileInMemory() {
    const int file = ::memfd_create("duolux", MFD_CLOEXEC);
    if (file < 0) fail(errno);
    return file;
}

/// Waits until the entries of a folder are on the disk. Skipped if the folder cannot be read.
void synchroniseFolder(const fs::path& folder) {
    const Descriptor opened{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (opened.value >= 0) synchroniseDescriptor(opened.value);
}

/// Throws std::system_error.
void writeTo(const Destination& destination, const Write& write) {
    requirePermission(destination);
    std::optional<Temporary> temporary;
    const fs::path folder = folderOf(destination.path);
    const bool exists = destination.old.has_value();
    if (!destination.isStream) {
        try {
            temporary.emplace(folder, exists ? 0600 : 0666);
        } catch (const std::system_error& e) {
            if (!exists || !isFolderForbidden(e.code().value())) throw;
        }
    }
    if (!temporary) {
        FileWriter memory(fileInMemory());
        write(memory);
        memory.synchronise();
        copyInto(destination, memory.descriptor());
        return;
    }
    write(temporary->writer());
    temporary->writer().synchronise();
    if (exists) temporary->takeOver(*destination.old);
    const int error = temporary->renameTo(destination.path);
    if (error == 0) {
        synchroniseFolder(folder);
        return;
    }
    if (!exists || !(isFolderForbidden(error) || error == EBUSY || error == EXDEV)) fail(error);
    copyInto(destination, temporary->writer().descriptor());
}

/// Calls `step` with the destination of a name. Exceptions become a MachineError that names the file.
void withDestination(const fs::path& name, const std::function<void(const Destination&)>& step) {
    std::string file = name.string();
    const auto failed = [&](std::string_view problem) {
        return MachineError(fmt::format("{}: cannot write: {}", file, problem));
    };
    try {
        const Destination destination = destinationOf(name);
        if (destination.path != name) file += fmt::format(" (a link to {})", destination.path.string());
        step(destination);
    } catch (const Error&) {
        throw;
    } catch (const std::system_error& e) {
        throw failed(e.code().message());
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        throw failed(e.what());
    }
}

}  // namespace

FileWriter::FileWriter(int descriptor) : file_(::fdopen(descriptor, "w")) {
    if (file_ != nullptr) return;
    const int error = errno;
    ::close(descriptor);
    fail(error);
}

FileWriter::~FileWriter() {
    static_cast<void>(std::fclose(file_));
}

void FileWriter::write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(errno);
}

std::uint64_t FileWriter::position() const {
    return static_cast<std::uint64_t>(::ftello(file_));
}

void FileWriter::seek(std::uint64_t position) {
    if (::fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) fail(errno);
}

void FileWriter::synchronise() {
    if (std::fflush(file_) != 0) fail(errno);
    synchroniseDescriptor(::fileno(file_));
}

int FileWriter::descriptor() const {
    return ::fileno(file_);
}

void writeFileAtomically(const fs::path& path, const Write& write) {
    withDestination(path, [&](const Destination& destination) { writeTo(destination, write); });
}

void writeFile(const fs::path& path, std::string_view bytes) {
    writeFileAtomically(path, [&](FileWriter& file) { file.write(bytes); });
}

bool isSameFile(const fs::path& a, const fs::path& b) {
    // Compares device and inode of the files or, if they do not exist, of their folders.
    const auto isSame = [](const fs::path& x, const fs::path& y) {
        struct stat first {};
        struct stat second {};
        return ::stat(x.c_str(), &first) == 0 && ::stat(y.c_str(), &second) == 0 &&
               first.st_dev == second.st_dev && first.st_ino == second.st_ino;
    };
    if (isSame(a, b)) return true;
    try {
        const Destination x = destinationOf(a), y = destinationOf(b);
        return !x.old && !y.old && x.path.filename() == y.path.filename() &&
               isSame(folderOf(x.path), folderOf(y.path));
    } catch (const std::system_error&) {
        return false;  // such a path can be neither read nor written
    }
}

void checkWritable(const fs::path& path) {
    withDestination(path, [](const Destination& destination) {
        requirePermission(destination);
        if (destination.isStream) return;
        try {
            const Temporary probe(folderOf(destination.path), 0600);
        } catch (const std::system_error& e) {
            if (!destination.old || !isFolderForbidden(e.code().value())) throw;
        }
    });
}

}  // namespace duolux
