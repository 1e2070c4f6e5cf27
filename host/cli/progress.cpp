#include "host/cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace duolux {

namespace {

constexpr double kBarInterval = 0.1;     // seconds between two updates of the bar
constexpr double kPlainInterval = 10.0;  // seconds between two plain lines
constexpr int kMaxBarWidth = 40;
constexpr int kTextWidth = 42;  // columns that the longest usual line needs in addition to its bar

std::string bar(double fraction, int width) {
    const int inner = width - 2;
    const int filled = std::clamp(static_cast<int>(fraction * inner), 0, inner);
    std::string cells(static_cast<std::size_t>(inner), ' ');
    std::fill_n(cells.begin(), filled, '=');
    if (filled > 0 && filled < inner) cells[static_cast<std::size_t>(filled) - 1] = '>';
    return '[' + cells + ']';
}

/// Ignores failures: a render continues even if its progress cannot be shown.
void show(std::FILE* out, const std::string& text) {
    std::fputs(text.c_str(), out);
    std::fflush(out);
}

int barWidthFor(std::FILE* out) {
    winsize size{};
    const int columns = ::ioctl(::fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
    return std::min(columns - kTextWidth, kMaxBarWidth);
}

}  // namespace

double progressFraction(const ProgressState& state) {
    double fraction = state.total > 0.0 ? state.done / state.total : 0.0;
    if (state.timeLimit && *state.timeLimit > 0.0)
        fraction = std::max(fraction, state.seconds / *state.timeLimit);
    return std::clamp(fraction, 0.0, 1.0);
}

std::optional<double> secondsLeft(const ProgressState& state) {
    std::optional<double> left;
    if (state.done > 0.0) left = std::max(0.0, (state.total - state.done) * state.seconds / state.done);
    if (state.timeLimit) {
        const double untilLimit = std::max(0.0, *state.timeLimit - state.seconds);
        left = left ? std::min(*left, untilLimit) : untilLimit;
    }
    return left;
}

std::string formatDuration(double seconds) {
    constexpr double kLongest = 1e9;
    const auto whole = static_cast<long long>(std::ceil(std::clamp(seconds, 0.0, kLongest)));
    const long long hours = whole / 3600;
    const long long minutes = whole / 60 % 60;
    if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
    return fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string progressLine(const ProgressState& state, int barWidth, bool finished) {
    const double fraction = finished ? (state.total > 0.0 ? std::min(state.done / state.total, 1.0) : 0.0)
                                     : progressFraction(state);
    // Rounded down, so that 100 % appears only when the work is complete.
    std::string line = fmt::format("{:3.0f} %", std::floor(100.0 * fraction));
    if (barWidth >= 3) line += ' ' + bar(fraction, barWidth);
    if (state.seconds > 0.0) line += fmt::format(" {:.2f} Msamples/s", state.done / state.seconds * 1e-6);
    if (finished) {
        line += state.seconds < 60.0 ? fmt::format(", {:.1f} s in all", state.seconds)
                                     : fmt::format(", {} in all", formatDuration(state.seconds));
    } else if (const auto left = secondsLeft(state)) {
        line += fmt::format(", {} left", formatDuration(*left));
    }
    return line;
}

Progress::Style Progress::styleForStderr(bool quiet) {
    if (quiet) return Style::kQuiet;
    return ::isatty(STDERR_FILENO) != 0 ? Style::kBar : Style::kPlain;
}

void Progress::begin(double total) {
    state_ = {0.0, total, 0.0, std::nullopt};
    started_ = true;
    if (style_ != Style::kQuiet) draw(false);
}

void Progress::stage(std::string_view what) {
    if (!started_ || style_ == Style::kQuiet) return;
    stage_ = what;
    draw(false);
}

void Progress::update(const ProgressState& state) {
    const bool first = !started_;
    state_ = state;
    stage_.clear();
    started_ = true;
    if (style_ == Style::kQuiet) return;
    if (style_ == Style::kPlain) {
        if (state.seconds - lastDrawn_ < kPlainInterval) return;
    } else if (!first && state.seconds - lastDrawn_ < kBarInterval) {
        return;
    }
    draw(false);
}

void Progress::finish() {
    if (!started_ || style_ == Style::kQuiet) return;
    draw(true);
    leaveLine();
    started_ = false;
}

void Progress::leaveLine() {
    if (lineOpen_) show(out_, "\n");
    lineOpen_ = false;
}

void Progress::draw(bool finished) {
    lastDrawn_ = state_.seconds;
    std::string line = progressLine(state_, style_ == Style::kPlain ? 0 : barWidthFor(out_), finished);
    if (!stage_.empty() && !finished) line += ", " + stage_;
    if (style_ == Style::kPlain) {
        show(out_, line + "\n");
    } else {
        constexpr const char* kEraseToEndOfLine = "\x1b[K";
        show(out_, "\r" + line + kEraseToEndOfLine);
        lineOpen_ = true;
    }
}

}  // namespace duolux
