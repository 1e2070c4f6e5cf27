#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/film/layers.h"
#include "host/film/sample_range.h"

namespace duolux {

// Parsers for the options of the commands. All throw UsageError unless they return an optional.

/// "A,B" as two numbers; empty if malformed.
std::optional<glm::vec2> parsePoint(const std::string& text);

/// "NAME,...", names of layers of a film.
FilmLayerSet parseLayers(const std::string& text);

/// "A:B", the samples [A, B) with A < B.
SampleRange parseSampleRange(const std::string& text);

/// The arguments of the program, without its name. Three numbers after --look-at and the like become one
/// argument: `1 2 3` (or `1, 2, 3`) is `1,2,3`.
std::vector<std::string> argumentsOf(int argc, const char* const* argv);

/// Adds --strict, which turns tolerated errors in scene files into failures, to a command. `strict` must
/// outlive the command.
void addStrictOption(CLI::App& command, bool& strict);

}  // namespace duolux
