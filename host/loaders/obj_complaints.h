#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "host/base/printable.h"
#include "host/loaders/obj_statements.h"
#include "host/loaders/obj_tokens.h"
#include "host/loaders/source_text.h"
#include "host/loaders/tally.h"

namespace duolux {

/// Errors in one part of an OBJ file: counts those that are tolerated, and keeps the first other one.
class ObjComplaints {
  public:
    ObjComplaints(const char* begin, Reading reading, Tally<ObjOddity>& oddities)
        : begin_(begin), reading_(reading), oddities_(oddities) {}

    bool strict() const { return reading_ == Reading::kStrict; }
    const std::optional<TextProblem>& problem() const { return problem_; }
    std::size_t offsetOf(const char* at) const { return static_cast<std::size_t>(at - begin_); }

    void count(ObjOddity oddity, const char* at) { oddities_.add(oddity, offsetOf(at)); }

    /// Counts the oddity or, in strict reading, calls `refuse`, which reports it.
    template <typename Refuse>
    void tolerate(ObjOddity oddity, const char* at, const Refuse& refuse) {
        if (strict()) {
            refuse();
        } else {
            count(oddity, at);
        }
    }

    void report(TextProblem problem) {
        if (!problem_) problem_ = std::move(problem);
    }
    void report(const char* at, std::string problem, std::string remedy) {
        report({offsetOf(at), std::move(problem), std::move(remedy)});
    }
    void reportNumber(const char* at, const char* remedy) {
        report(at, fmt::format("{} is not a finite number", inQuotes(tokenAt(at))), remedy);
    }
    void reportCount(const char* line, int count, const char* remedy) {
        report(line, fmt::format("{} numbers", count), remedy);
    }

  private:
    const char* begin_;
    Reading reading_;
    Tally<ObjOddity>& oddities_;
    std::optional<TextProblem> problem_;
};

}  // namespace duolux
