#include "host/cli/outputs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <new>
#include <optional>
#include <system_error>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/base/memory.h"
#include "host/cli/console.h"
#include "host/film/image.h"

namespace duolux {

namespace fs = std::filesystem;

namespace {

constexpr const char* kIsRead = "is read by this command";

[[noreturn]] void refuse(const OutputFile& output, std::string_view problem) {
    throw UsageError(fmt::format("{} {}: {}", output.option, output.file, problem));
}

[[noreturn]] void refuseTaken(const OutputFile& output, std::string_view use) {
    refuse(output, fmt::format("{}; expected another file", use));
}

/// The message of the exception that `step` throws, if any.
std::optional<std::string> problemOf(const std::string& file, const std::function<void()>& step) {
    try {
        step();
        return std::nullopt;
    } catch (const Error& e) {
        return e.what();
    } catch (const std::bad_alloc&) {
        return outOfMemory(fmt::format("{}: cannot write", file), "expected a smaller --size, or more memory")
            .what();
    } catch (const std::exception& e) {
        return fmt::format("{}: cannot write: {}", file, e.what());
    }
}

/// Creates a new file in a folder, named after the file that cannot be written. Empty if this fails as well.
fs::path makeFileInstead(const fs::path& folder, const fs::path& path) {
    constexpr std::size_t kLongestPart = 100;  // names are limited to 255 bytes
    std::string extension = path.extension().string();
    if (extension.size() > kLongestPart) extension.clear();
    std::string name =
        (folder / fmt::format("{}-rescued-XXXXXX{}", path.stem().string().substr(0, kLongestPart), extension))
            .string();
    const int file = ::mkostemps(name.data(), static_cast<int>(extension.size()), O_CLOEXEC);
    if (file < 0) return {};
    ::close(file);
    return name;
}

/// Writes a file to another place after its own failed. Returns the new path; empty if no place works.
fs::path writeElsewhere(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    std::error_code ignored;
    std::vector<fs::path> folders{".", fs::temp_directory_path(ignored)};
    const bool isStream = fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
    if (!isStream) folders.insert(folders.begin(), folderOf(path));
    for (const fs::path& folder : folders) {
        const fs::path other = makeFileInstead(folder, path);
        if (other.empty()) continue;
        if (!problemOf(other.string(), [&] { write(other); })) return other;
        fs::remove(other, ignored);
    }
    return {};
}

}  // namespace

void checkOutputs(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs) {
    std::vector<std::pair<fs::path, std::string>> taken;
    for (const std::string& input : inputs) {
        if (!input.empty()) taken.emplace_back(input, kIsRead);
    }
    for (const OutputFile& output : outputs) {
        if (output.image && !isImagePath(output.file))
            refuse(output, fmt::format("is not the name of an image; expected one that ends with {}",
                                       imageExtensions()));
        const fs::path path(output.file);
        std::error_code unseen;  // the path cannot be examined: checkWritable reports it below
        if (!fs::exists(folderOf(path), unseen) && !unseen)
            refuse(output, fmt::format("the folder {} does not exist", folderOf(path).string()));
        if (fs::is_directory(path, unseen)) refuse(output, "is a folder; expected a file name");
        for (const auto& [other, use] : taken) {
            if (isSameFile(path, other)) refuseTaken(output, use);
        }
        taken.emplace_back(path, "is also written by " + output.option);
        if (const auto problem = problemOf(output.file, [&] { checkWritable(path); }))
            throw UsageError(fmt::format("{} {}", output.option, *problem));
    }
}

void checkNotRead(const std::vector<OutputFile>& outputs, const std::vector<fs::path>& inputs) {
    for (const OutputFile& output : outputs) {
        for (const fs::path& input : inputs) {
            if (isSameFile(output.file, input)) refuseTaken(output, kIsRead);
        }
    }
}

void WriteAll::operator()(const std::string& file, const std::function<void(const fs::path&)>& write) {
    std::optional<std::string> problem = problemOf(file, [&] { write(file); });
    if (!problem) return;
    if (file != "-") {
        const fs::path other = writeElsewhere(file, write);
        if (!other.empty()) *problem += fmt::format("; it is in {} instead", other.string());
    }
    failures_.push_back(*problem);
}

void WriteAll::sayFailures() const {
    for (const std::string& failure : failures_)
        say("duolux: " + failure);
}

void WriteAll::finish() const {
    if (!failed()) return;
    for (std::size_t i = 0; i + 1 < failures_.size(); ++i)
        say("duolux: " + failures_[i]);
    throw MachineError(failures_.back());
}

void writeReport(const fs::path& file, const std::string& text) {
    if (file == "-") {
        printResult(text);
    } else {
        writeFile(file, text);
    }
}

}  // namespace duolux
