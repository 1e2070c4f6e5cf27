#include "host/render/render.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "host/app/commands.h"
#include "host/app/exposure_warning.h"
#include "host/app/film_images.h"
#include "host/app/machine_options.h"
#include "host/app/render_choices.h"
#include "host/app/render_options.h"
#include "host/app/render_warnings.h"
#include "host/app/report.h"
#include "host/app/signals.h"
#include "host/base/clock.h"
#include "host/base/error.h"
#include "host/base/file.h"
#include "host/cli/console.h"
#include "host/cli/options.h"
#include "host/cli/outputs.h"
#include "host/cli/progress.h"
#include "host/loaders/scene_file.h"

namespace duolux {

namespace {

/// One run of `duolux render`: its stages, in the order of run().
class RenderCommand {
  public:
    explicit RenderCommand(const RenderOptions& options) : options_(options) {}

    void run() {
        checkOutputFiles();
        load();
        choose();
        Device device = openDevice(options_.device);
        const RenderOutput output = trace(device);
        warnAbout(output);
        write(output, device.info());
        end(output);
    }

  private:
    void checkOutputFiles();
    void load();
    void choose();
    RenderOutput trace(Device& device);
    void warnAbout(const RenderOutput& output);
    void write(const RenderOutput& output, const DeviceInfo& device);
    void end(const RenderOutput& output);

    void warnAndKeep(const std::string& warning) {
        warn(warning);
        scene_.warnings.emplace_back(warning);
    }
    std::uint64_t pixels() const { return std::uint64_t{scene_.settings.width} * scene_.settings.height; }
    std::uint64_t samplesInAll() const { return pixels() * samples_.size(); }
    FilmOrigin origin(const RenderStatistics& statistics) const {
        return originOf(scene_, scene_.settings, samples_, statistics.directLightInClosedForm);
    }

    const RenderOptions& options_;
    const Clock::time_point start_ = Clock::now();
    StageSeconds seconds_;
    std::vector<std::string> images_;
    std::vector<OutputFile> files_;  ///< images and all others
    LoadedScene scene_;
    std::optional<Checkpoint> resumed_;
    SampleRange samples_;
    RenderControl control_;
    std::optional<RenderFailure> failure_;
    WriteAll write_;
};

void RenderCommand::checkOutputFiles() {
    requireScenePath(options_.scene);
    images_ = options_.outputs;
    if (images_.empty()) images_.push_back(std::filesystem::path(options_.scene).stem().string() + ".png");
    for (const std::string& image : images_)
        files_.push_back({"-o", image});
    if (!options_.report.empty() && options_.report != "-")
        files_.push_back({"--report", options_.report, false});
    if (!options_.checkpoint.empty()) files_.push_back({"--checkpoint", options_.checkpoint, false});
    // A checkpoint may replace the one from which the render resumes.
    checkOutputs(files_,
                 {options_.scene, isSameFile(options_.resume, options_.checkpoint) ? "" : options_.resume});
}

void RenderCommand::load() {
    const Overrides overrides = parseOverrides(options_);
    scene_ = loadScene(options_.scene, overrides.choices(options_));
    checkNotRead(files_, scene_.files);
    requireNoOtherFile(options_.checkpoint);
    overrides.applyTo(scene_.settings, options_);
    requireUseOfLayers(options_, images_, scene_.settings);
    if (scene_.settings.integrator == Integrator::kLightTracer) warnOfSmoothSurfaces(scene_);
    for (const Warning& warning : scene_.warnings)
        warn(warning.text);
    if (!options_.resume.empty()) resumed_ = readCheckpoint(options_.resume);
    samples_ = chooseSamples(options_, overrides.range, resumed_, scene_.settings.spp);
}

void RenderCommand::choose() {
    control_.samples = samples_;
    control_.timeLimit = options_.timeLimit;
    control_.tuning = options_.tuning.choice();
    control_.directLight = chooseDirectLight(options_, scene_.settings);
    if (resumed_) resumeFrom(*resumed_, options_, scene_, samples_, control_);
    seconds_.load = secondsSince(start_);
}

/// Renders. If the device fails before the end, returns the output so far and sets failure_.
RenderOutput RenderCommand::trace(Device& device) {
    const Progress::Style style = Progress::styleForStderr(options_.quiet);
    Progress progress(style);
    // A large film takes seconds to prepare.
    constexpr std::uint64_t kManyPixels = 1u << 24;
    if (!resumed_ && (style == Progress::Style::kBar || pixels() >= kManyPixels)) {
        progress.begin(static_cast<double>(samplesInAll()));
    }
    control_.onStage = [&](std::string_view what) { progress.stage(what); };
    control_.onStart = deferSignals;
    control_.onProgress = [&](const RenderProgress& p) {
        if (p.samplesTotal == 0) return true;  // all samples were resumed
        progress.update({static_cast<double>(p.samplesDone), static_cast<double>(p.samplesTotal), p.seconds,
                         options_.timeLimit});
        return !stopStatus();
    };
    if (!options_.checkpoint.empty()) {
        control_.onCheckpoint = [&](const Film& film, const RenderStatistics& statistics) {
            try {
                writeCheckpoint(options_.checkpoint, origin(statistics), film, statistics);
            } catch (const std::exception& e) {  // the next checkpoint may succeed
                progress.leaveLine();
                warn(e.what());
            }
        };
    }
    const auto renderWhatCanBe = [&] {
        try {
            return render(device, scene_, control_);
        } catch (const RenderFailure& e) {
            failure_ = e;
            return std::move(e.output());
        }
    };
    RenderOutput output = renderWhatCanBe();
    deferSignals();  // even if all samples were resumed
    progress.finish();
    return output;
}

void RenderCommand::warnAbout(const RenderOutput& output) {
    for (const std::string& warning :
         resultWarnings(scene_.settings, samples_, output, failure_.has_value(), stopStatus().has_value())) {
        warnAndKeep(warning);
    }
    if (output.film.lightPaths() > 0) {
        const std::string dim = dimEmitterWarning(scene_, output.film.lightPaths());
        if (!dim.empty()) warnAndKeep(dim);
    }
    // The warning requires at least one sample of every pixel.
    if (!failure_ && output.film.totalSamples() + output.film.lightPaths() >= output.film.samples().size()) {
        const bool clips = std::any_of(images_.begin(), images_.end(), isPngPath);
        const std::string exposure = exposureWarning(scene_, output.film.rows(), options_.exposure, clips);
        if (!exposure.empty()) warnAndKeep(exposure);
    }
    if (failure_) scene_.warnings.emplace_back(failure_->what());
}

void RenderCommand::write(const RenderOutput& output, const DeviceInfo& device) {
    const Clock::time_point start = Clock::now();
    const FilmOrigin filmOrigin = origin(output.statistics);
    if (!options_.checkpoint.empty() && !output.statistics.gaps) {
        write_(options_.checkpoint, [&](const std::filesystem::path& path) {
            writeCheckpoint(path, filmOrigin, output.film, output.statistics);
        });
    }
    writeImages(write_, images_, output.film.rows(),
                filmImageOptions(filmOrigin, output.film, options_.exposure));
    seconds_.write = secondsSince(start);
    seconds_.total = secondsSince(start_);
    if (options_.report.empty()) return;
    write_(options_.report, [&](const std::filesystem::path& path) {
        writeReport(path, renderReport(scene_, samples_, device, output.statistics, seconds_));
    });
}

/// Throws if the render failed, was interrupted, or some file was not written.
void RenderCommand::end(const RenderOutput& output) {
    const std::string there =
        fmt::format("{} of {} {}", output.film.totalSamples() + output.film.lightPaths(), samplesInAll(),
                    samplesName(scene_.settings));
    if (failure_) {
        write_.sayFailures();
        throw MachineError(
            write_.failed()
                ? fmt::format("{}; {} were traced, but not all files were written", failure_->what(), there)
                : fmt::format("{}; wrote the result so far, {}", failure_->what(), there));
    }
    if (const auto status = stopStatus(); status && (output.statistics.stopped || write_.failed())) {
        write_.sayFailures();
        throw Stopped(*status,
                      fmt::format("{}: wrote the result so far, {}",
                                  *status == ExitStatus::kTerminated ? "terminated" : "interrupted", there));
    }
    write_.finish();
}

}  // namespace

void addRenderCommand(CLI::App& app) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand("render", "Render a scene to images");
    addRenderOptions(*command, *options);
    command->callback([options, command] {
        sortWords(*command, *options);
        RenderCommand(*options).run();
    });
}

}  // namespace duolux
