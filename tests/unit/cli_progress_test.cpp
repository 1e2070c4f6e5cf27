#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "host/cli/progress.h"

namespace duolux {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

TEST(FormatDuration, UsesHoursOnlyWhenThereAreSome) {
    EXPECT_EQ(formatDuration(0.0), "0:00");
    EXPECT_EQ(formatDuration(0.2), "0:01");
    EXPECT_EQ(formatDuration(59.0), "0:59");
    EXPECT_EQ(formatDuration(60.0), "1:00");
    EXPECT_EQ(formatDuration(754.0), "12:34");
    EXPECT_EQ(formatDuration(3723.0), "1:02:03");
    EXPECT_EQ(formatDuration(360000.0), "100:00:00");
    EXPECT_EQ(formatDuration(-5.0), "0:00");
}

TEST(ProgressFraction, TakesTheNearerOfWorkAndTimeLimit) {
    EXPECT_DOUBLE_EQ(progressFraction({0.0, 0.0, 0.0, {}}), 0.0);
    EXPECT_DOUBLE_EQ(progressFraction({25.0, 100.0, 1.0, {}}), 0.25);
    EXPECT_DOUBLE_EQ(progressFraction({25.0, 100.0, 6.0, 10.0}), 0.6);
    EXPECT_DOUBLE_EQ(progressFraction({150.0, 100.0, 6.0, {}}), 1.0);
}

TEST(SecondsLeft, FollowsTheMeanRate) {
    EXPECT_FALSE(secondsLeft({0.0, 100.0, 0.0, {}}).has_value());
    EXPECT_DOUBLE_EQ(*secondsLeft({25.0, 100.0, 10.0, {}}), 30.0);
    EXPECT_DOUBLE_EQ(*secondsLeft({100.0, 100.0, 10.0, {}}), 0.0);
    EXPECT_DOUBLE_EQ(*secondsLeft({25.0, 100.0, 10.0, 12.0}), 2.0);
    EXPECT_DOUBLE_EQ(*secondsLeft({0.0, 100.0, 5.0, 12.0}), 7.0);
}

TEST(ProgressLine, ShowsPercentageRateAndTimeLeft) {
    EXPECT_EQ(progressLine({2.5e6, 10e6, 2.0, {}}, 0, false), " 25 % 1.25 Msamples/s, 0:06 left");
    EXPECT_EQ(progressLine({10e6, 10e6, 8.0, {}}, 0, true), "100 % 1.25 Msamples/s, 8.0 s in all");
    EXPECT_EQ(progressLine({0.0, 10e6, 0.0, {}}, 0, false), "  0 %");
    // Stopped by a time limit: shows the work done, not the time that has passed.
    EXPECT_EQ(progressLine({1e6, 10e6, 8.0, 8.0}, 0, true), " 10 % 0.12 Msamples/s, 8.0 s in all");
    // Nearly complete work is not shown as 100 %.
    EXPECT_THAT(progressLine({9.999e6, 10e6, 8.0, {}}, 0, false), HasSubstr(" 99 %"));
}

TEST(ProgressLine, DrawsABarOfTheGivenWidth) {
    EXPECT_EQ(progressLine({0.0, 1.0, 0.0, {}}, 12, false), "  0 % [          ]");
    EXPECT_EQ(progressLine({0.5, 1.0, 0.0, {}}, 12, false), " 50 % [====>     ], 0:00 left");
    EXPECT_EQ(progressLine({1.0, 1.0, 0.0, {}}, 12, false), "100 % [==========], 0:00 left");
    EXPECT_EQ(progressLine({0.5, 1.0, 0.0, {}}, 2, true), " 50 %, 0.0 s in all");
}

/// The output of a Progress of this style while `use` runs.
template <typename Use>
std::string outputOf(Progress::Style style, Use use) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
    {
        Progress progress(style, file.get());
        use(progress);
    }
    std::rewind(file.get());
    std::array<char, 65536> text{};
    return {text.data(), std::fread(text.data(), 1, text.size(), file.get())};
}

void runForAMinute(Progress& progress) {
    for (int tenth = 0; tenth <= 600; ++tenth)
        progress.update(tenth * 1e5, 600e5, tenth * 0.1);
    progress.finish();
}

TEST(Progress, PrintsNothingWhenQuiet) {
    EXPECT_EQ(outputOf(Progress::Style::kQuiet, runForAMinute), "");
}

TEST(Progress, PrintsAPlainLineEveryTenSecondsAndAtTheEnd) {
    const std::string text = outputOf(Progress::Style::kPlain, runForAMinute);
    const auto lines = std::ranges::count(text, '\n');
    EXPECT_GE(lines, 6);
    EXPECT_LE(lines, 7);
    EXPECT_THAT(text, Not(HasSubstr("\r")));
    EXPECT_THAT(text, Not(HasSubstr("\x1b")));
    EXPECT_THAT(text, EndsWith("100 % 1.00 Msamples/s, 1:00 in all\n"));
}

TEST(Progress, SaysOneLineOfShortWork) {
    const auto use = [](Progress& progress) {
        progress.update(5e5, 1e6, 0.5);
        progress.update(1e6, 1e6, 1.0);
        progress.finish();
        progress.finish();
    };
    EXPECT_EQ(outputOf(Progress::Style::kPlain, use), "100 % 1.00 Msamples/s, 1.0 s in all\n");
}

TEST(Progress, RewritesOneLineOnATerminal) {
    const std::string text = outputOf(Progress::Style::kBar, runForAMinute);
    EXPECT_EQ(std::ranges::count(text, '\n'), 1);
    EXPECT_THAT(text, EndsWith("1:00 in all\x1b[K\n"));
    EXPECT_GT(std::ranges::count(text, '\r'), 100);
}

TEST(Progress, DrawsABarAtMostTenTimesASecond) {
    const auto use = [](Progress& progress) {
        for (int i = 0; i < 1000; ++i)
            progress.update(i, 1000, i * 0.001);
    };
    const std::string text = outputOf(Progress::Style::kBar, use);
    EXPECT_LE(std::ranges::count(text, '\r'), 11);
    EXPECT_GE(std::ranges::count(text, '\r'), 9);
}

TEST(Progress, BeginsBeforeThereIsProgress) {
    const auto use = [](Progress& progress) { progress.begin(1e6); };
    EXPECT_EQ(outputOf(Progress::Style::kPlain, use), "  0 %\n");
    EXPECT_THAT(outputOf(Progress::Style::kBar, use), testing::StartsWith("\r  0 % "));
    EXPECT_EQ(outputOf(Progress::Style::kQuiet, use), "");
}

TEST(Progress, SaysWhatIsPrepared) {
    const auto use = [](Progress& progress) {
        progress.stage("never shown");
        progress.begin(1e6);
        progress.stage("building trees");
        progress.stage("preparing the film");
        progress.update(1e6, 1e6, 1.0);
        progress.finish();
    };
    EXPECT_EQ(
        outputOf(Progress::Style::kPlain, use),
        "  0 %\n  0 %, building trees\n  0 %, preparing the film\n100 % 1.00 Msamples/s, 1.0 s in all\n");
    const std::string bar = outputOf(Progress::Style::kBar, use);
    EXPECT_THAT(bar, HasSubstr("], building trees\x1b[K\r  0 % ["));
    EXPECT_THAT(bar, HasSubstr("], preparing the film\x1b[K\r100 % ["));
    EXPECT_EQ(outputOf(Progress::Style::kQuiet, use), "");
}

TEST(Progress, EndsItsLineWhenTheWorkIsAbandoned) {
    const auto use = [](Progress& progress) { progress.update(1.0, 2.0, 1.0); };
    EXPECT_THAT(outputOf(Progress::Style::kBar, use), EndsWith("\x1b[K\n"));
    EXPECT_EQ(outputOf(Progress::Style::kPlain, use), "");
    EXPECT_EQ(outputOf(Progress::Style::kPlain, [](Progress& progress) { progress.finish(); }), "");
}

}  // namespace
}  // namespace duolux
