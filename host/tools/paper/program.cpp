#include "host/tools/paper/program.h"

#include <fmt/format.h>

#include "host/base/error.h"
#include "host/base/file.h"
#include "host/cli/process.h"

namespace duolux {

nlohmann::json runProgram(const std::filesystem::path& program, std::vector<std::string> arguments,
                          const std::filesystem::path& report) {
    arguments.insert(arguments.end(), {"--report", report.string()});
    const int status = runProcess(program.string(), arguments);
    if (status != 0) {
        throw MachineError(fmt::format("failed ({}): {} {}",
                                       status == 127 ? "cannot be started" : "see above", program.string(),
                                       fmt::join(arguments, " ")));
    }
    return nlohmann::json::parse(readFile(report));
}

}  // namespace duolux
