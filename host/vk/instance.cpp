#include "host/vk/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>

#include "host/base/memory.h"

namespace duolux {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

/// Address space for the loader with all of Debian's drivers, and for lavapipe's compiler.
constexpr std::uint64_t kAddressSpace = std::uint64_t{5} << 28;  // bytes

vk::raii::Context makeContext() {
    try {
        return vk::raii::Context();
    } catch (const std::exception&) {
        throw NoDriverError(
            "no Vulkan loader found; install libvulkan1 and a driver (mesa-vulkan-drivers has lavapipe)" +
            addressSpaceHint());
    }
}

/// Subscribes to messages of some types.
VkDebugUtilsMessengerCreateInfoEXT messengerInfo(VkDebugUtilsMessageTypeFlagsEXT types,
                                                 PFN_vkDebugUtilsMessengerCallbackEXT callback, void* user) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = types;
    info.pfnUserCallback = callback;
    info.pUserData = user;
    return info;
}

}  // namespace

struct Instance::Log {
    mutable std::mutex mutex;
    std::vector<std::string> validation;
    std::string loaderError, loaderWarning;  // the first of each; later ones only say that no driver loaded

    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT types,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* user) {
        Log& log = *static_cast<Log*>(user);
        const std::lock_guard lock(log.mutex);
        if ((types & VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT) == 0) {
            log.validation.emplace_back(data->pMessage);
            return VK_FALSE;
        }
        const bool isError = (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0;
        std::string& first = isError ? log.loaderError : log.loaderWarning;
        if (first.empty()) first = data->pMessage;
        return VK_FALSE;
    }

    /// Why the loader found no working driver; empty if the loader gives no reason.
    std::string loaderProblem() const {
        const std::lock_guard lock(mutex);
        const bool saysWhy = !loaderError.empty() && loaderError.find("no drivers") == std::string::npos;
        return saysWhy ? loaderError : loaderWarning;
    }

    /// `result`: the result of the failed call.
    NoDriverError failure(vk::Result result) const {
        const std::string problem = loaderProblem();
        const std::string because = problem.empty() ? "" : fmt::format(" ({})", problem);
        if (addressSpaceLimit() < kAddressSpace) {
            return NoDriverError(fmt::format("no Vulkan driver can be loaded{}{}; expected at least {} MiB",
                                             because, addressSpaceHint(), kAddressSpace >> 20));
        }
        if (result == vk::Result::eErrorOutOfHostMemory && problem.empty())
            return NoDriverError("out of memory while loading the Vulkan drivers");
        if (problem.empty()) {
            return NoDriverError(
                "no Vulkan driver found; install one (Debian: mesa-vulkan-drivers, which has lavapipe for "
                "machines without a GPU)");
        }
        return NoDriverError(
            fmt::format("no Vulkan driver can be loaded{}; expected a driver's manifest and the library that "
                        "it names (Debian: mesa-vulkan-drivers)",
                        because));
    }
};

namespace {

void requireValidationLayer(const vk::raii::Context& context) {
    const auto available = context.enumerateInstanceLayerProperties();
    const bool found = std::ranges::any_of(available, [](const vk::LayerProperties& layer) {
        return std::strcmp(layer.layerName, kValidationLayer) == 0;
    });
    if (!found) {
        throw MachineError(
            fmt::format("{} is not installed; install vulkan-validationlayers", kValidationLayer));
    }
}

}  // namespace

Instance::Instance(Validation validation)
    : log_(std::make_unique<Log>()), context_(makeContext()), instance_(nullptr), messenger_(nullptr) {
    const vk::ApplicationInfo application("duolux", 0, "duolux", 0, VK_API_VERSION_1_2);
    std::vector<const char*> layers;
    std::vector<const char*> extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME};  // the loader's own
    // The loader reports why a driver cannot be used while it creates the instance.
    const VkDebugUtilsMessengerCreateInfoEXT loader =
        messengerInfo(VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT, &Log::receive, log_.get());
    vk::InstanceCreateInfo create({}, &application);
    create.setPNext(&loader);
    try {
        const std::array<vk::ValidationFeatureEnableEXT, 1> enables{
            vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
        const vk::ValidationFeaturesEXT features(enables, {}, create.pNext);
        if (validation == Validation::kOn) {
            requireValidationLayer(context_);
            layers.push_back(kValidationLayer);
            extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
            create.setPNext(&features);
        }
        create.setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions);
        instance_ = vk::raii::Instance(context_, create);
        if (validation == Validation::kOn) {
            messenger_ = {instance_, vk::DebugUtilsMessengerCreateInfoEXT(
                                         messengerInfo(VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                                                           VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
                                                       &Log::receive, log_.get()))};
        }
    } catch (const vk::SystemError& e) {
        throw log_->failure(static_cast<vk::Result>(e.code().value()));
    }
}

Instance::~Instance() = default;

std::vector<vk::raii::PhysicalDevice> Instance::devices() const {
    try {
        std::vector<vk::raii::PhysicalDevice> devices = instance_.enumeratePhysicalDevices();
        if (!devices.empty()) return devices;
    } catch (const vk::SystemError& e) {
        throw log_->failure(static_cast<vk::Result>(e.code().value()));
    }
    throw log_->failure(vk::Result::eSuccess);
}

std::vector<std::string> Instance::validationMessages() const {
    const std::lock_guard lock(log_->mutex);
    return log_->validation;
}

}  // namespace duolux
