#pragma once

#include <string>

#include "host/tools/paper/experiment.h"

namespace duolux {

/// The tables as Markdown.
std::string markdownTables(const ExperimentSetup& setup, const Experiment& experiment);

/// A page with the pictures (files of setup.folder) and the tables.
std::string htmlReport(const ExperimentSetup& setup, const Experiment& experiment);

/// Every figure, for scripts.
std::string jsonReport(const ExperimentSetup& setup, const Experiment& experiment);

}  // namespace duolux
