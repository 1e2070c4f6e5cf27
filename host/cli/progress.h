#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace duolux {

/// The state of a long task. Units are whatever the task counts, for example samples.
struct ProgressState {
    double done = 0.0, total = 0.0;   ///< units
    double seconds = 0.0;             ///< since the task started
    std::optional<double> timeLimit;  ///< seconds after which the task stops, even if it is not complete
};

/// Fraction of the work that is done, or of the time limit if that ends the task earlier: 0 to 1.
double progressFraction(const ProgressState& state);

/// Seconds until the task ends at the mean rate so far; empty while no rate is known.
std::optional<double> secondsLeft(const ProgressState& state);

/// "0:07", "12:34", "1:02:03".
std::string formatDuration(double seconds);

/// " 47 % [=======>       ] 1.32 Msamples/s, 0:12 left", or with `finished` "... 1.32 Msamples/s, 0:23 in
/// all". The bar takes `barWidth` columns; it is left out if `barWidth` is below 3.
std::string progressLine(const ProgressState& state, int barWidth, bool finished);

/// Reports progress to a stream: on a terminal as one line that is rewritten in place, otherwise as plain
/// lines at intervals. All times come from the caller, who may call update() as often as is convenient.
class Progress {
  public:
    enum class Style : std::uint8_t { kQuiet, kPlain, kBar };

    /// The style for standard error: a bar if it is a terminal.
    static Style styleForStderr(bool quiet);

    explicit Progress(Style style, std::FILE* out = stderr) : style_(style), out_(out) {}
    ~Progress() { leaveLine(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows 0 % before there is anything to report, because preparations take a while.
    void begin(double total);

    /// Shows what is being prepared, until the next update(); ignored before begin().
    void stage(std::string_view what);

    void update(const ProgressState& state);
    void update(double done, double total, double seconds) { update({done, total, seconds, std::nullopt}); }

    /// Writes the final line with the last state; writes nothing if update() was never called.
    void finish();

    /// Ends the line of an open bar, so that something else can be printed. The next update() starts a new
    /// line.
    void leaveLine();

  private:
    void draw(bool finished);

    Style style_;
    std::FILE* out_;
    ProgressState state_;
    std::string stage_;
    bool started_ = false;
    bool lineOpen_ = false;
    double lastDrawn_ = 0.0;  ///< seconds
};

}  // namespace duolux
