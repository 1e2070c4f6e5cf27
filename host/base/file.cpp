#include "host/base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "host/base/error.h"
#include "host/base/temporary_folder.h"

namespace duolux {

std::string readFile(const std::filesystem::path& path) {
    std::error_code ec;
    if (std::filesystem::is_directory(path, ec)) {
        throw InputError(path.string(), "", "is a directory", "expected a file");
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

/// Waits until the file is on the disk, as far as the system can tell.
void synchronise(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return;  // `write` has made none: the rename will say so
    ::fsync(file);
    ::close(file);
}

/// Devices and pipes stay what they are: they get the bytes of a file that was written elsewhere.
void writeInto(const std::filesystem::path& special,
               const std::function<void(const std::filesystem::path&)>& write) {
    const TemporaryFolder folder;
    const std::filesystem::path temporary = folder / special.filename().string();
    write(temporary);
    const std::string bytes = readFile(temporary);
    std::ofstream out(special, std::ios::binary | std::ios::app);
    out << bytes;
    out.close();
    if (!out) throw MachineError(fmt::format("{}: cannot write: {}", special.string(), std::strerror(errno)));
}

}  // namespace

void writeFileAtomically(const std::filesystem::path& name,
                         const std::function<void(const std::filesystem::path&)>& write) {
    std::error_code ec;
    const std::filesystem::path linked = std::filesystem::canonical(name, ec);
    const std::filesystem::path& path = ec ? name : linked;  // none there yet: ec
    if (!ec && !std::filesystem::is_regular_file(path, ec) && !std::filesystem::is_directory(path, ec)) {
        writeInto(path, write);
        return;
    }
    // The extension is kept: some writers choose the format by it.
    std::filesystem::path temporary = path;
    temporary.replace_filename(
        fmt::format(".{}.{}{}", path.stem().string(), ::getpid(), path.extension().string()));
    try {
        write(temporary);
        synchronise(temporary);
        std::filesystem::rename(temporary, path);
    } catch (const Error&) {
        std::filesystem::remove(temporary, ec);
        throw;
    } catch (const std::filesystem::filesystem_error& e) {
        std::filesystem::remove(temporary, ec);
        throw MachineError(fmt::format("{}: cannot write: {}", path.string(), e.code().message()));
    } catch (const std::exception& e) {
        std::filesystem::remove(temporary, ec);
        throw MachineError(fmt::format("{}: cannot write: {}", path.string(), e.what()));
    }
}

void writeFile(const std::filesystem::path& path, std::string_view bytes) {
    writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << bytes;
        out.close();
        if (!out) throw MachineError(path.string() + ": cannot write");
    });
}

}  // namespace duolux
