// A Vulkan layer that makes a device fail, so that tests can check how the program reacts. Environment
// variables:
//   DUOLUX_FAULT_LOST=N      the device is lost at the N-th submission (from 0), and stays lost
//   DUOLUX_FAULT_MEMORY=N    the N-th allocation (from 0) finds no device memory
//   DUOLUX_FAULT_HEAP=BYTES  all memory heaps are that large
// Tests enable it by VK_LAYER_PATH and VK_INSTANCE_LAYERS. One device per process.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace {

PFN_vkGetInstanceProcAddr nextInstanceProc = nullptr;
PFN_vkGetDeviceProcAddr nextDeviceProc = nullptr;
PFN_vkGetPhysicalDeviceMemoryProperties nextMemoryProperties = nullptr;
PFN_vkGetPhysicalDeviceMemoryProperties2 nextMemoryProperties2 = nullptr;
VkInstance instanceOfAll = VK_NULL_HANDLE;
VkDevice deviceOfAll = VK_NULL_HANDLE;
std::atomic<std::uint64_t> submissions{0}, allocations{0};
std::atomic<bool> lost{false};

constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

std::uint64_t setting(const char* name) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : kNever;
}

template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(nextDeviceProc(deviceOfAll, name));
}

/// The link in a chain of structures by which the loader tells the layer what comes next.
template <typename Link>
Link* findLink(const void* chain, VkStructureType type) {
    for (auto* link = static_cast<Link*>(const_cast<void*>(chain)); link != nullptr;
         link = static_cast<Link*>(const_cast<void*>(link->pNext))) {
        if (link->sType == type && link->function == VK_LAYER_LINK_INFO) return link;
    }
    return nullptr;
}

VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                   VkInstance* instance) {
    auto* link =
        findLink<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    nextInstanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(nextInstanceProc(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, allocator, instance);
    if (result != VK_SUCCESS) return result;
    instanceOfAll = *instance;
    // Later, the loader would return this layer's own functions.
    nextMemoryProperties = reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(
        nextInstanceProc(*instance, "vkGetPhysicalDeviceMemoryProperties"));
    nextMemoryProperties2 = reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties2>(
        nextInstanceProc(*instance, "vkGetPhysicalDeviceMemoryProperties2"));
    return result;
}

VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                 const VkAllocationCallbacks* allocator, VkDevice* device) {
    auto* link = findLink<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    const PFN_vkGetInstanceProcAddr instanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    nextDeviceProc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(instanceProc(instanceOfAll, "vkCreateDevice"));
    const VkResult result = create(physical, info, allocator, device);
    deviceOfAll = *device;
    return result;
}

VkResult VKAPI_CALL queueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                VkFence fence) {
    if (submissions++ == setting("DUOLUX_FAULT_LOST")) lost = true;
    if (lost) return VK_ERROR_DEVICE_LOST;
    return next<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, infos, fence);
}

VkResult VKAPI_CALL waitForFences(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                  std::uint64_t timeout) {
    // Work that the driver still has in flight must end before it is destroyed, even on a lost device.
    const VkResult result = next<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, timeout);
    return lost ? VK_ERROR_DEVICE_LOST : result;
}

VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                   const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
    if (allocations++ == setting("DUOLUX_FAULT_MEMORY")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return next<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, allocator, memory);
}

void limitHeaps(VkPhysicalDeviceMemoryProperties& memory) {
    const std::uint64_t bytes = setting("DUOLUX_FAULT_HEAP");
    for (std::uint32_t i = 0; bytes != kNever && i < memory.memoryHeapCount; ++i)
        memory.memoryHeaps[i].size = bytes;
}

void VKAPI_CALL memoryProperties(VkPhysicalDevice physical, VkPhysicalDeviceMemoryProperties* memory) {
    nextMemoryProperties(physical, memory);
    limitHeaps(*memory);
}

void VKAPI_CALL memoryProperties2(VkPhysicalDevice physical, VkPhysicalDeviceMemoryProperties2* memory) {
    nextMemoryProperties2(physical, memory);
    limitHeaps(memory->memoryProperties);
}

PFN_vkVoidFunction own(const char* name) {
    const struct {
        const char* name;
        PFN_vkVoidFunction function;
    } functions[] = {
        {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(createInstance)},
        {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(createDevice)},
        {"vkQueueSubmit", reinterpret_cast<PFN_vkVoidFunction>(queueSubmit)},
        {"vkWaitForFences", reinterpret_cast<PFN_vkVoidFunction>(waitForFences)},
        {"vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(allocateMemory)},
        {"vkGetPhysicalDeviceMemoryProperties", reinterpret_cast<PFN_vkVoidFunction>(memoryProperties)},
        {"vkGetPhysicalDeviceMemoryProperties2", reinterpret_cast<PFN_vkVoidFunction>(memoryProperties2)},
    };
    for (const auto& [ownName, function] : functions) {
        if (std::strcmp(name, ownName) == 0) return function;
    }
    return nullptr;
}

PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* name) {
    const PFN_vkVoidFunction function = own(name);
    return function != nullptr ? function : nextDeviceProc(device, name);
}

PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(deviceProc);
    const PFN_vkVoidFunction function = own(name);
    return function != nullptr ? function : nextInstanceProc(instance, name);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* interface) {
    interface->loaderLayerInterfaceVersion = 2;
    interface->pfnGetInstanceProcAddr = instanceProc;
    interface->pfnGetDeviceProcAddr = deviceProc;
    interface->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
