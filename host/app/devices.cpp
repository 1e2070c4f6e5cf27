#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/app/commands.h"
#include "host/app/machine_options.h"
#include "host/base/error.h"
#include "host/cli/json.h"
#include "host/device_scene/json.h"
#include "host/vk/device_info.h"
#include "shaders/shared/bvh_layout.h"

namespace duolux {

namespace {

void printDevice(const DeviceInfo& device, bool chosen) {
    constexpr double kMebibyte = 1 << 20;
    fmt::print("{} {}: {}\n", chosen ? "*" : " ", device.index, device.name);
    fmt::print("     kind                   {}\n", nameOf(device.kind));
    fmt::print("     driver                 {}\n", device.driver);
    fmt::print("     Vulkan                 {}\n", device.vulkanVersion);
    fmt::print("     subgroup size          {}\n", device.subgroupSize);
    fmt::print("     memory                 {:.0f} MiB\n",
               static_cast<double>(device.memoryBytes) / kMebibyte);
    fmt::print("     storage buffer range   {:.0f} MiB\n",
               static_cast<double>(device.maxStorageBufferRange) / kMebibyte);
    fmt::print("     texel buffer           {} texels of 16 bytes ({} pairs of triangles at most)\n",
               device.maxTexelBufferElements, device.maxTexelBufferElements / shared::kPairTexels);
    fmt::print("     ray queries            {}\n", device.rayQueries ? "yes" : "no");
    if (!device.unusable.empty()) fmt::print("     unusable               lacks {}\n", device.unusable);
}

nlohmann::ordered_json devicesJson(const std::vector<DeviceInfo>& devices, const DeviceInfo* chosen) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const DeviceInfo& device : devices) {
        nlohmann::ordered_json entry = {{"index", device.index}, {"chosen", &device == chosen}};
        entry.update(toJson(device));
        entry["vulkan"] = device.vulkanVersion;
        entry["subgroup_size"] = device.subgroupSize;
        entry["memory_bytes"] = device.memoryBytes;
        entry["storage_buffer_bytes"] = device.maxStorageBufferRange;
        entry["texel_buffer_texels"] = device.maxTexelBufferElements;
        entry["most_triangle_pairs"] = device.maxTexelBufferElements / shared::kPairTexels;
        entry["ray_queries"] = device.rayQueries;
        entry["lacks"] = device.unusable;
        list.push_back(std::move(entry));
    }
    return {{"version", 1}, {"devices", std::move(list)}};
}

void runDevices(bool json) {
    const std::vector<DeviceInfo> devices = findDevices();
    const DeviceInfo* chosen = nullptr;
    try {
        chosen = &selectDevice(devices, "");
    } catch (const DeviceError&) {
        // No device is usable; the list shows why.
    }
    if (json) {
        fmt::print("{}", jsonText(devicesJson(devices, chosen)));
    } else {
        for (const DeviceInfo& device : devices)
            printDevice(device, &device == chosen);
    }
    if (chosen == nullptr) throw DeviceError("no usable Vulkan device");
    if (!json) fmt::print("\n* is the default for --device.\n");
}

}  // namespace

void addDevicesCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("devices", "List the Vulkan devices and mark the default");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Print JSON");
    command->callback([json] { runDevices(*json); });
}

}  // namespace duolux
