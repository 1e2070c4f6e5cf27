#include "host/vk/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

#include "host/base/error.h"
#include "host/base/memory.h"
#include "host/base/text.h"
#include "host/vk/handles.h"

namespace duolux {

namespace {

constexpr std::array kRayQueryExtensions{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                         VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                         VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

bool hasRayQueries(const vk::raii::PhysicalDevice& physical) {
    const std::vector<vk::ExtensionProperties> there = physical.enumerateDeviceExtensionProperties();
    for (const char* wanted : kRayQueryExtensions) {
        const auto isWanted = [wanted](const vk::ExtensionProperties& extension) {
            return std::strcmp(extension.extensionName, wanted) == 0;
        };
        if (std::none_of(there.begin(), there.end(), isWanted)) return false;
    }
    const auto features =
        physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                              vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                              vk::PhysicalDeviceRayQueryFeaturesKHR>();
    return features.get<vk::PhysicalDeviceVulkan12Features>().bufferDeviceAddress &&
           features.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure &&
           features.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery;
}

/// The features that the kernels need and the device supports.
std::string missingFeature(const vk::raii::PhysicalDevice& physical) {
    const vk::PhysicalDeviceProperties properties = physical.getProperties();
    if (properties.apiVersion < VK_API_VERSION_1_2) return "Vulkan 1.2";
    const auto features =
        physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
    if (!features.get<vk::PhysicalDeviceVulkan12Features>().scalarBlockLayout) return "scalarBlockLayout";
    if (!features.get<vk::PhysicalDeviceFeatures2>().features.shaderStorageBufferArrayDynamicIndexing) {
        return "shaderStorageBufferArrayDynamicIndexing";
    }
    const auto subgroup =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>()
            .get<vk::PhysicalDeviceSubgroupProperties>();
    const vk::SubgroupFeatureFlags needed =
        vk::SubgroupFeatureFlagBits::eBallot | vk::SubgroupFeatureFlagBits::eShuffle;
    if (!(subgroup.supportedStages & vk::ShaderStageFlagBits::eCompute) ||
        (subgroup.supportedOperations & needed) != needed) {
        return "subgroup ballot and shuffle in compute shaders";
    }
    const auto families = physical.getQueueFamilyProperties();
    if (std::none_of(families.begin(), families.end(), [](const vk::QueueFamilyProperties& family) {
            return static_cast<bool>(family.queueFlags & vk::QueueFlagBits::eCompute);
        })) {
        return "a compute queue";
    }
    return "";
}

DeviceInfo describe(const vk::raii::PhysicalDevice& physical, std::uint32_t index) {
    const auto chain =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties,
                                vk::PhysicalDeviceDriverProperties>();
    const vk::PhysicalDeviceProperties& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    DeviceInfo info;
    info.index = index;
    info.name = properties.deviceName.data();
    info.driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
    info.kind = properties.deviceType == vk::PhysicalDeviceType::eCpu ? DeviceKind::kCpu : DeviceKind::kGpu;
    info.vulkanVersion =
        fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(properties.apiVersion),
                    VK_API_VERSION_MINOR(properties.apiVersion), VK_API_VERSION_PATCH(properties.apiVersion));
    info.subgroupSize = chain.get<vk::PhysicalDeviceSubgroupProperties>().subgroupSize;
    info.maxStorageBufferRange = properties.limits.maxStorageBufferRange;
    info.maxTexelBufferElements = properties.limits.maxTexelBufferElements;
    info.maxStorageBuffers = properties.limits.maxPerStageDescriptorStorageBuffers;
    info.maxWorkgroupSize = std::min(properties.limits.maxComputeWorkGroupSize[0],
                                     properties.limits.maxComputeWorkGroupInvocations);
    const vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
            info.memoryBytes = std::max<std::uint64_t>(info.memoryBytes, memory.memoryHeaps[i].size);
        }
    }
    const auto features =
        physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
    info.int64Atomics = features.get<vk::PhysicalDeviceFeatures2>().features.shaderInt64 &&
                        features.get<vk::PhysicalDeviceVulkan12Features>().shaderBufferInt64Atomics;
    info.rayQueries = hasRayQueries(physical);
    info.unusable = missingFeature(physical);
    return info;
}

std::vector<DeviceInfo> describeAll(const std::vector<vk::raii::PhysicalDevice>& devices) {
    std::vector<DeviceInfo> infos;
    for (std::uint32_t i = 0; i < devices.size(); ++i)
        infos.push_back(describe(devices[i], i));
    return infos;
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical, std::uint32_t queueFamily,
                            const DeviceInfo& info) {
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, queueFamily, 1, &priority);
    vk::PhysicalDeviceVulkan12Features features12;
    features12.scalarBlockLayout = VK_TRUE;
    features12.shaderBufferInt64Atomics = info.int64Atomics;
    vk::PhysicalDeviceFeatures2 features({}, &features12);
    features.features.shaderStorageBufferArrayDynamicIndexing = VK_TRUE;
    features.features.shaderInt64 = info.int64Atomics;
    vk::DeviceCreateInfo create({}, queue);
    vk::PhysicalDeviceAccelerationStructureFeaturesKHR structures(VK_TRUE);
    vk::PhysicalDeviceRayQueryFeaturesKHR queries(VK_TRUE);
    if (info.rayQueries) {
        features12.bufferDeviceAddress = VK_TRUE;
        features12.pNext = &structures;
        structures.pNext = &queries;
        create.setPEnabledExtensionNames(kRayQueryExtensions);
    }
    create.setPNext(&features);
    try {
        return vk::raii::Device(physical, create);
    } catch (const vk::SystemError& e) {
        failOn(info, "creating a logical device", e);
    }
}

std::uint32_t computeFamily(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    for (std::uint32_t i = 0; i < families.size(); ++i) {
        if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return i;
    }
    return 0;  // not reached: missingFeature has checked this
}

}  // namespace

std::vector<DeviceInfo> listDevices() {
    const Instance instance(Validation::kOff);
    return describeAll(instance.devices());
}

const DeviceInfo& selectDevice(const std::vector<DeviceInfo>& devices, std::string_view selector) {
    const auto first = [&](auto&& matches) -> const DeviceInfo* {
        for (const DeviceInfo& device : devices) {
            if (device.unusable.empty() && matches(device)) return &device;
        }
        return nullptr;
    };
    const auto isKind = [](DeviceKind kind) {
        return [kind](const DeviceInfo& d) { return d.kind == kind; };
    };
    const std::string wanted = lowerCase(selector);
    const DeviceInfo* found = nullptr;
    std::uint32_t index = 0;
    const auto [end, ec] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (wanted.empty()) {
        found = first(isKind(DeviceKind::kGpu));
        if (found == nullptr) found = first(isKind(DeviceKind::kCpu));
    } else if (wanted == "gpu") {
        found = first(isKind(DeviceKind::kGpu));
    } else if (wanted == "cpu") {
        found = first(isKind(DeviceKind::kCpu));
    } else if (ec == std::errc() && end == wanted.data() + wanted.size()) {
        found = first([&](const DeviceInfo& d) { return d.index == index; });
    } else {
        found =
            first([&](const DeviceInfo& d) { return lowerCase(d.name).find(wanted) != std::string::npos; });
    }
    if (found != nullptr) return *found;
    std::string there;
    for (const DeviceInfo& device : devices) {
        there += fmt::format("{}{} \"{}\"", there.empty() ? "" : ", ", device.index, device.name);
        if (!device.unusable.empty()) there += fmt::format(" (lacks {})", device.unusable);
    }
    if (selector.empty()) throw DeviceError(fmt::format("no usable Vulkan device; found {}", there));
    throw UsageError(fmt::format("no such usable device; found {}", there));
}

void requireDriverSpace(const DeviceInfo& device, std::string_view stage) {
    constexpr std::uint64_t kCompilerSpace = std::uint64_t{512} << 20;  // bytes; 330 MiB were seen in use
    if (device.kind == DeviceKind::kCpu)
        requireAddressSpace(kCompilerSpace, fmt::format("{} on {}", stage, device.name));
}

void failOn(const DeviceInfo& device, std::string_view stage, const vk::SystemError& error) {
    const auto result = static_cast<vk::Result>(error.code().value());
    const std::string line =
        fmt::format("{} failed on {} ({}): {}{}", stage, device.name, device.driver, error.what(),
                    result == vk::Result::eErrorDeviceLost ? "" : addressSpaceHint());
    if (result == vk::Result::eErrorOutOfDeviceMemory || result == vk::Result::eErrorOutOfHostMemory)
        throw MemoryError(line);
    throw DeviceError(line);
}

namespace {

std::unique_ptr<Device::Handles> openDevice(std::string_view selector, Validation validation,
                                            DeviceInfo& info) {
    auto handles = std::make_unique<Device::Handles>(validation);
    std::vector<vk::raii::PhysicalDevice> all = handles->instance.devices();
    info = selectDevice(describeAll(all), selector);
    requireDriverSpace(info, "creating a logical device");
    const vk::raii::PhysicalDevice& physical = handles->physical = std::move(all[info.index]);
    handles->queueFamily = computeFamily(physical);
    handles->device = makeDevice(physical, handles->queueFamily, info);
    handles->queue = vk::raii::Queue(handles->device, handles->queueFamily, 0);
    if (physical.getQueueFamilyProperties()[handles->queueFamily].timestampValidBits > 0) {
        handles->timestampPeriod = static_cast<double>(physical.getProperties().limits.timestampPeriod);
    }
    return handles;
}

}  // namespace

Device::Device(std::string_view selector, Validation validation)
    : handles_(openDevice(selector, validation, info_)) {}

Device::~Device() = default;

std::vector<std::string> Device::validationMessages() const {
    return handles_->instance.validationMessages();
}

}  // namespace duolux
