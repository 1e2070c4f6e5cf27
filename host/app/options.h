#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/film/layers.h"
#include "host/film/sample_range.h"

namespace duolux {

// Parsers and checks for the options of several commands. All throw UsageError.

/// "A,B" as two numbers; empty if malformed.
std::optional<glm::vec2> parsePoint(const std::string& text);

/// "WIDTHxHEIGHT", each from 1 to 16384.
glm::uvec2 parseSize(const std::string& text);

/// "NAME,...", names of layers of a film.
FilmLayerSet parseLayers(const std::string& text);

/// "A:B", the samples [A, B) with A < B.
SampleRange parseSampleRange(const std::string& text);

/// Checks that an option's text is a number in [lower, upper]; rejects NaN.
CLI::Validator between(double lower, double upper);
CLI::Validator wholeNumber(std::uint64_t lower, std::uint64_t upper);

/// Rejects an empty text, for example from an unset variable in a script, and the name of another option.
CLI::Validator notEmpty();

/// Accepts only these names; suggests the most similar one.
CLI::Validator oneOf(std::vector<std::string> names);

/// The arguments of the program, without its name. Three numbers after --look-at and the like become one
/// argument: `1 2 3` (or `1, 2, 3`) is `1,2,3`.
std::vector<std::string> argumentsOf(int argc, const char* const* argv);

/// Adds --strict, which turns tolerated errors in scene files into failures, to a command. `strict` must
/// outlive the command.
void addStrictOption(CLI::App& command, bool& strict);

/// The message for a syntax error on the command line.
std::string describeParseError(const CLI::App& app, const CLI::ParseError& error);

}  // namespace duolux
