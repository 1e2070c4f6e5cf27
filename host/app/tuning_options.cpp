#include "host/app/tuning_options.h"

#include "host/base/named.h"
#include "host/cli/options.h"

namespace duolux {

TuningChoice TuningOptions::choice() const {
    return {named<Layout>(layout), named<KernelKind>(kernel)};
}

void addTuningOptions(CLI::App& command, TuningOptions& options) {
    command
        .add_option("--layout", options.layout,
                    "How rays find triangles: by a tree in texel buffers (default on CPUs) or in storage "
                    "buffers (default on GPUs), or by the device's ray queries, see 'duolux devices'")
        ->type_name("NAME")
        ->check(oneOf(namesOfAll<Layout>()));
    command
        .add_option("--kernel", options.kernel,
                    "Lanes whose rays are finished take new ones (refilling, the default) or wait for the "
                    "others (plain; always with ray queries, and on CPUs where surfaces are not only "
                    "diffuse)")
        ->type_name("NAME")
        ->check(oneOf(namesOfAll<KernelKind>()));
}

}  // namespace duolux
