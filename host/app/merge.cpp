#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "host/app/commands.h"
#include "host/app/film_images.h"
#include "host/app/render_warnings.h"
#include "host/base/error.h"
#include "host/cli/console.h"
#include "host/cli/options.h"
#include "host/cli/outputs.h"
#include "host/render/checkpoint.h"

namespace duolux {

namespace {

struct MergeOptions {
    std::vector<std::string> outputs, parts;
    float exposure = 0.0f;
};

struct Part {
    SampleRange samples;
    std::string file;
};

/// Throws InputError if two parts share samples, which would count twice.
void requireDisjoint(const Part& part, const std::vector<Part>& others) {
    for (const Part& other : others) {
        const std::uint32_t begin = std::max(part.samples.begin, other.samples.begin);
        const std::uint32_t end = std::min(part.samples.end, other.samples.end);
        if (begin >= end) continue;
        throw InputError(part.file, "",
                         fmt::format("has samples {} to {}, which {} also has", begin, end - 1, other.file),
                         "expected parts of different --sample-range");
    }
}

void warnIfIncomplete(const std::string& file, const Checkpoint& part) {
    const Film& film = part.state.film;
    const std::uint64_t taken = film.totalSamples() + film.lightPaths();
    const std::uint64_t wanted = part.origin.samples.size() * (std::uint64_t{film.width()} * film.height());
    if (taken == wanted) return;
    warn(fmt::format("{} has {} of {} {}; --resume traces the remaining ones", file, taken, wanted,
                     samplesName(part.origin.settings)));
}

void runMerge(const MergeOptions& options) {
    std::vector<OutputFile> files;
    for (const std::string& output : options.outputs)
        files.push_back({"-o", output});
    checkOutputs(files, options.parts);
    std::optional<Checkpoint> sum;
    std::vector<Part> parts;
    for (const std::string& file : options.parts) {
        Checkpoint part = readCheckpoint(file);
        if (sum) requireSameOrigin(file, part.origin, sum->origin, options.parts.front());
        requireDisjoint({part.origin.samples, file}, parts);
        warnIfIncomplete(file, part);
        parts.push_back({part.origin.samples, file});
        if (sum) {
            sum->state.film.add(part.state.film);
            sum->state.filmOverflowed = sum->state.filmOverflowed || part.state.filmOverflowed;
        } else {
            sum = std::move(part);
        }
    }
    if (sum->state.filmOverflowed || sum->state.film.overflowed()) {
        warn(describeOverflow(sum->state.film));
    }
    WriteAll write;
    writeImages(write, options.outputs, sum->state.film.rows(),
                filmImageOptions(sum->origin, sum->state.film, options.exposure));
    write.finish();
}

}  // namespace

void addMergeCommand(CLI::App& app) {
    const auto options = std::make_shared<MergeOptions>();
    CLI::App* command = app.add_subcommand(
        "merge", "Add partial renders; the result is identical to one render of all samples");
    addRepeatable(*command, "-o,--output", options->outputs,
                  fmt::format("Image to write: {}; may be given several times", imageExtensions()))
        ->required()
        ->type_name("FILE");
    command->add_option("--exposure", options->exposure, "Stops by which a PNG is brightened (default: 0)")
        ->type_name("STOPS")
        ->check(between(-64.0, 64.0));
    command
        ->add_option("PART", options->parts,
                     "Checkpoints of one scene with the same settings, but different --sample-range")
        ->required()
        ->type_name("");
    command->callback([options] { runMerge(*options); });
}

}  // namespace duolux
