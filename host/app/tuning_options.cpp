#include "host/app/tuning_options.h"

#include <vector>

#include "host/cli/options.h"

namespace duolux {

namespace {

constexpr Layout kLayouts[] = {Layout::kTexel, Layout::kStorage, Layout::kRayQuery};
constexpr KernelKind kKernels[] = {KernelKind::kRefilling, KernelKind::kPlain};

/// The value with this name, if any.
template <typename T, std::size_t N>
std::optional<T> byName(const T (&values)[N], const std::string& name) {
    for (const T value : values) {
        if (name == nameOf(value)) return value;
    }
    return std::nullopt;
}

template <typename T, std::size_t N>
std::vector<std::string> namesOf(const T (&values)[N]) {
    std::vector<std::string> names;
    for (const T value : values)
        names.emplace_back(nameOf(value));
    return names;
}

}  // namespace

TuningChoice TuningOptions::choice() const {
    return {byName(kLayouts, layout), byName(kKernels, kernel)};
}

void addTuningOptions(CLI::App& command, TuningOptions& options) {
    command
        .add_option("--layout", options.layout,
                    "How rays find triangles: by a tree in texel buffers (default on CPUs) or in storage "
                    "buffers (default on GPUs), or by the device's ray queries, see 'duolux devices'")
        ->type_name("NAME")
        ->check(oneOf(namesOf(kLayouts)));
    command
        .add_option("--kernel", options.kernel,
                    "Lanes whose rays are done get new ones (refilling: default) or wait for the others "
                    "(plain: always with ray queries)")
        ->type_name("NAME")
        ->check(oneOf(namesOf(kKernels)));
}

}  // namespace duolux
