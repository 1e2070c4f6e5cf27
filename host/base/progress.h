#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace duolux {

/// Where long work stands. Units are whatever the work counts, for example samples.
struct ProgressState {
    double done = 0.0, total = 0.0;   ///< units
    double seconds = 0.0;             ///< since the work began
    std::optional<double> timeLimit;  ///< seconds after which the work stops by itself, done or not
};

/// Part of the work, or of the time limit if that is nearer: 0 to 1.
double progressFraction(const ProgressState& state);

/// Seconds until the work ends at the mean rate so far; nothing while there is no rate.
std::optional<double> secondsLeft(const ProgressState& state);

/// "0:07", "12:34", "1:02:03".
std::string formatDuration(double seconds);

/// " 47 % [=======>       ] 1.32 Msamples/s, 0:12 left", or with `finished` "... 1.32 Msamples/s, 0:23 in
/// all". The bar takes `barWidth` columns; there is none below 3.
std::string progressLine(const ProgressState& state, int barWidth, bool finished);

/// Reports progress to a stream: on a terminal as one line rewritten in place, otherwise as a plain line now
/// and then. All times come from the caller, so it may be called as often as is convenient.
class Progress {
  public:
    enum class Style : std::uint8_t { kQuiet, kPlain, kBar };

    /// The style for standard error: a bar if it is a terminal.
    static Style styleForStderr(bool quiet);

    explicit Progress(Style style, std::FILE* out = stderr) : style_(style), out_(out) {}
    ~Progress() { leaveLine(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(const ProgressState& state);
    void update(double done, double total, double seconds) { update({done, total, seconds, std::nullopt}); }

    /// The last state again, as the final word; nothing if update() was never called.
    void finish();

    /// Ends a line that a bar left open, so that something else can be printed; the next update() begins a
    /// new one.
    void leaveLine();

  private:
    void draw(bool finished);

    Style style_;
    std::FILE* out_;
    ProgressState state_;
    bool started_ = false;
    bool lineOpen_ = false;
    double lastDrawn_ = 0.0;  ///< seconds
};

}  // namespace duolux
