// A Vulkan layer for tests: a dispatch table between the program and its driver in which calls fail on order,
// and which can present devices that nobody has. Controlled by the environment:
//   ORO_FAULT="vkCreateBuffer 3 VK_ERROR_DEVICE_LOST"  the third call of vkCreateBuffer gives that result; a
//   lost
//                                           device stays lost. More of them are separated by semicolons;
//                                           number 0: every call.
//   ORO_FAULT_DEVICES="discrete Big;software Slow without mesh_shader,atomics"  these devices instead of the
//                                           driver's (each draws as the driver's first one does); "none":
//                                           none.
//   ORO_FAULT_LOG=FILE                      a line for each call that could fail ("call vkCreateBuffer"),
//   each
//                                           that was made to ("fault ..."), each message of the validation
//                                           layer, and each object that was alive when its owner went ("leak
//                                           ...").
// Lies above the validation layer, which sees only calls that did not fail.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/faulty_vulkan/made_up_devices.h"
#include "tests/faulty_vulkan/orders.h"

namespace oro::test {
namespace {

struct State {
    int instances{}, devices{}, surfaces{}, messengers{};
    PFN_vkGetInstanceProcAddr next_instance_proc{};
    std::map<std::string, PFN_vkVoidFunction> below;
    PFN_vkGetDeviceProcAddr next_device_proc{};
    VkInstance instance{};
    VkDevice device{};
};
State& state() {
    static State the;
    return the;
}

// What lies below the layer, of a name. Asked while the instance is made: later, where nothing but the loader
// lies below, it would give what lies on top.
PFN_vkVoidFunction below(const char* name) {
    const auto found = state().below.find(name);
    return found != state().below.end() ? found->second : nullptr;
}

// Of the device, of a name.
template <class Function>
Function next_of_device(const char* name) {
    return reinterpret_cast<Function>(state().next_device_proc(state().device, name));
}
template <class Function>
Function next_of_instance(const char* name) {
    return reinterpret_cast<Function>(below(name));
}

// A name as a template's argument.
template <std::size_t N>
struct Name {
    char text[N]{};
    constexpr Name(const char (&name)[N]) { std::copy_n(name, N, text); }  // NOLINT: implicit as it must be
};

// A result that came after the call itself was done: a wait or a presentation that ended badly.
bool happens_all_the_same(const std::string& call, VkResult result) {
    if (result == VK_SUBOPTIMAL_KHR) return true;
    if (result != VK_ERROR_DEVICE_LOST) return false;
    return call == "vkWaitForFences" || call == "vkQueueWaitIdle" || call == "vkDeviceWaitIdle";
}

// A function of the device that can fail: fails when ordered, else is what lies below.
template <Name name, class Function>
struct OfDevice;
template <Name name, class... Arguments>
struct OfDevice<name, VkResult(VKAPI_PTR*)(Arguments...)> {
    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
        const bool was_lost = is_lost();
        const VkResult result = ordered(name.text);
        const auto next = next_of_device<VkResult(VKAPI_PTR*)(Arguments...)>(name.text);
        if (result == VK_SUCCESS) return next(arguments...);
        // Whatever was under way has ended when a device's loss is told; nothing was begun after it.
        if (happens_all_the_same(name.text, result) &&
            !(was_lost && std::strcmp(name.text, "vkWaitForFences") == 0))
            next(arguments...);
        return result;
    }
};

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* device) {
    auto* link =
        const_cast<VkLayerDeviceCreateInfo*>(static_cast<const VkLayerDeviceCreateInfo*>(info->pNext));
    while (link != nullptr && (link->sType != VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO ||
                               link->function != VK_LAYER_LINK_INFO))
        link = const_cast<VkLayerDeviceCreateInfo*>(static_cast<const VkLayerDeviceCreateInfo*>(link->pNext));
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    if (const VkResult result = ordered("vkCreateDevice"); result != VK_SUCCESS) return result;
    State& s = state();
    const auto next_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const auto next_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(next_instance(s.instance, "vkCreateDevice"));
    const VkResult made = create(real_device(physical), info, allocator, device);
    if (made != VK_SUCCESS) return made;
    s.next_device_proc = next_device;
    s.device = *device;
    device_is_new();
    ++s.devices;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
    if (device != VK_NULL_HANDLE) --state().devices;
    next_of_device<PFN_vkDestroyDevice>("vkDestroyDevice")(device, allocator);
}

// A messenger of the program: its messages are also logged.
struct Messenger {
    PFN_vkDebugUtilsMessengerCallbackEXT callback;
    void* user_data;
};
std::vector<std::unique_ptr<Messenger>>& messengers() {
    static std::vector<std::unique_ptr<Messenger>> all;
    return all;
}

VKAPI_ATTR VkBool32 VKAPI_CALL log_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                           VkDebugUtilsMessageTypeFlagsEXT type,
                                           const VkDebugUtilsMessengerCallbackDataEXT* data, void* own) {
    log_line(std::string("validation ") + data->pMessage);
    const auto* const messenger = static_cast<const Messenger*>(own);
    return messenger->callback(severity, type, data, messenger->user_data);
}

VKAPI_ATTR VkResult VKAPI_CALL create_messenger(VkInstance instance,
                                                const VkDebugUtilsMessengerCreateInfoEXT* info,
                                                const VkAllocationCallbacks* allocator,
                                                VkDebugUtilsMessengerEXT* made) {
    if (const VkResult result = ordered("vkCreateDebugUtilsMessengerEXT"); result != VK_SUCCESS)
        return result;
    messengers().push_back(std::make_unique<Messenger>(Messenger{info->pfnUserCallback, info->pUserData}));
    VkDebugUtilsMessengerCreateInfoEXT own = *info;
    own.pfnUserCallback = log_message;
    own.pUserData = messengers().back().get();
    const VkResult result = next_of_instance<PFN_vkCreateDebugUtilsMessengerEXT>(
        "vkCreateDebugUtilsMessengerEXT")(instance, &own, allocator, made);
    if (result == VK_SUCCESS) ++state().messengers;
    return result;
}
VKAPI_ATTR void VKAPI_CALL destroy_messenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger,
                                             const VkAllocationCallbacks* allocator) {
    if (messenger != VK_NULL_HANDLE) --state().messengers;
    next_of_instance<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(
        instance, messenger, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL create_surface(VkInstance instance, const void* info,
                                              const VkAllocationCallbacks* allocator, VkSurfaceKHR* made) {
    if (const VkResult result = ordered("vkCreateXcbSurfaceKHR"); result != VK_SUCCESS) return result;
    const VkResult result =
        next_of_instance<decltype(&create_surface)>("vkCreateXcbSurfaceKHR")(instance, info, allocator, made);
    if (result == VK_SUCCESS) ++state().surfaces;
    return result;
}
VKAPI_ATTR void VKAPI_CALL destroy_surface(VkInstance instance, VkSurfaceKHR surface,
                                           const VkAllocationCallbacks* allocator) {
    if (surface != VK_NULL_HANDLE) --state().surfaces;
    next_of_instance<PFN_vkDestroySurfaceKHR>("vkDestroySurfaceKHR")(instance, surface, allocator);
}

const std::map<std::string, PFN_vkVoidFunction>& hooks();

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkInstance* instance) {
    auto* link =
        const_cast<VkLayerInstanceCreateInfo*>(static_cast<const VkLayerInstanceCreateInfo*>(info->pNext));
    while (link != nullptr && (link->sType != VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO ||
                               link->function != VK_LAYER_LINK_INFO))
        link = const_cast<VkLayerInstanceCreateInfo*>(
            static_cast<const VkLayerInstanceCreateInfo*>(link->pNext));
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    read_orders();
    if (const VkResult result = ordered("vkCreateInstance"); result != VK_SUCCESS) return result;
    State& s = state();
    s.next_instance_proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(s.next_instance_proc(nullptr, "vkCreateInstance"));
    const VkResult made = create(info, allocator, instance);
    if (made != VK_SUCCESS) return made;
    s.instance = *instance;
    ++s.instances;
    s.below.clear();
    for (const auto& [name, own] : hooks()) s.below[name] = s.next_instance_proc(*instance, name.c_str());
    const char* const devices = std::getenv("ORO_FAULT_DEVICES");
    make_up_devices(devices != nullptr ? devices : "", *instance, below);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance, const VkAllocationCallbacks* allocator) {
    const State& s = state();
    for (const auto& [count, what] : {std::pair{s.devices, "device"}, std::pair{s.surfaces, "surface"},
                                      std::pair{s.messengers, "messenger"}}) {
        if (count != 0) log_line(std::string("leak ") + what);
    }
    if (instance != VK_NULL_HANDLE) --state().instances;
    next_of_instance<PFN_vkDestroyInstance>("vkDestroyInstance")(instance, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL enumerate_devices(VkInstance instance, std::uint32_t* count,
                                                 VkPhysicalDevice* devices) {
    if (const VkResult result = ordered("vkEnumeratePhysicalDevices"); result != VK_SUCCESS) return result;
    return enumerate_made_up(instance, count, devices);
}

VKAPI_ATTR VkResult VKAPI_CALL enumerate_extensions(VkPhysicalDevice device, const char* layer,
                                                    std::uint32_t* count, VkExtensionProperties* extensions) {
    if (const VkResult result = ordered("vkEnumerateDeviceExtensionProperties"); result != VK_SUCCESS)
        return result;
    return extensions_of_made_up(device, layer, count, extensions);
}

// A function that asks a physical device about a surface: fails when ordered, else asks the driver's own.
template <Name name, class Function>
struct OfSurface;
template <Name name, class... Arguments>
struct OfSurface<name, VkResult(VKAPI_PTR*)(VkPhysicalDevice, Arguments...)> {
    static VKAPI_ATTR VkResult VKAPI_CALL call(VkPhysicalDevice device, Arguments... arguments) {
        if (const VkResult result = ordered(name.text); result != VK_SUCCESS) return result;
        return next_of_instance<VkResult(VKAPI_PTR*)(VkPhysicalDevice, Arguments...)>(name.text)(
            real_device(device), arguments...);
    }
};

VKAPI_ATTR VkResult VKAPI_CALL get_query_results(VkDevice device, VkQueryPool pool, std::uint32_t first,
                                                 std::uint32_t count, std::size_t size, void* data,
                                                 VkDeviceSize stride, VkQueryResultFlags flags) {
    const VkResult result = OfDevice<"vkGetQueryPoolResults", PFN_vkGetQueryPoolResults>::call(
        device, pool, first, count, size, data, stride, flags);
    if (result == VK_SUCCESS && (flags & VK_QUERY_RESULT_64_BIT) != 0)
        spoil_timestamps(static_cast<std::uint64_t*>(data), count);
    return result;
}

const std::map<std::string, PFN_vkVoidFunction>& hooks() {
#define ORO_DEVICE(function) \
    { #function, reinterpret_cast < PFN_vkVoidFunction>(OfDevice <#function, PFN_##function>::call) }
#define ORO_SURFACE(function) \
    { #function, reinterpret_cast < PFN_vkVoidFunction>(OfSurface <#function, PFN_##function>::call) }
#define ORO_OWN(function, own) \
    { #function, reinterpret_cast < PFN_vkVoidFunction>(own) }
    static const std::map<std::string, PFN_vkVoidFunction> all{
        ORO_OWN(vkCreateInstance, create_instance),
        ORO_OWN(vkDestroyInstance, destroy_instance),
        ORO_OWN(vkCreateDevice, create_device),
        ORO_OWN(vkDestroyDevice, destroy_device),
        ORO_OWN(vkEnumeratePhysicalDevices, enumerate_devices),
        ORO_OWN(vkEnumerateDeviceExtensionProperties, enumerate_extensions),
        ORO_OWN(vkCreateDebugUtilsMessengerEXT, create_messenger),
        ORO_OWN(vkDestroyDebugUtilsMessengerEXT, destroy_messenger),
        ORO_OWN(vkCreateXcbSurfaceKHR, create_surface),
        ORO_OWN(vkDestroySurfaceKHR, destroy_surface),
        ORO_OWN(vkGetQueryPoolResults, get_query_results),
        ORO_OWN(vkGetPhysicalDeviceProperties, made_up_properties),
        ORO_OWN(vkGetPhysicalDeviceProperties2, made_up_properties2),
        ORO_OWN(vkGetPhysicalDeviceFeatures2, made_up_features2),
        ORO_OWN(vkGetPhysicalDeviceMemoryProperties, made_up_memory),
        ORO_OWN(vkGetPhysicalDeviceQueueFamilyProperties, made_up_queue_families),
        ORO_SURFACE(vkGetPhysicalDeviceSurfaceSupportKHR),
        ORO_SURFACE(vkGetPhysicalDeviceSurfaceCapabilitiesKHR),
        ORO_SURFACE(vkGetPhysicalDeviceSurfaceFormatsKHR),
        ORO_DEVICE(vkAllocateMemory),
        ORO_DEVICE(vkMapMemory),
        ORO_DEVICE(vkCreateBuffer),
        ORO_DEVICE(vkBindBufferMemory),
        ORO_DEVICE(vkCreateImage),
        ORO_DEVICE(vkBindImageMemory),
        ORO_DEVICE(vkCreateImageView),
        ORO_DEVICE(vkCreateShaderModule),
        ORO_DEVICE(vkCreateDescriptorSetLayout),
        ORO_DEVICE(vkCreatePipelineLayout),
        ORO_DEVICE(vkCreateGraphicsPipelines),
        ORO_DEVICE(vkCreateComputePipelines),
        ORO_DEVICE(vkCreateDescriptorPool),
        ORO_DEVICE(vkAllocateDescriptorSets),
        ORO_DEVICE(vkCreateCommandPool),
        ORO_DEVICE(vkAllocateCommandBuffers),
        ORO_DEVICE(vkCreateFence),
        ORO_DEVICE(vkCreateSemaphore),
        ORO_DEVICE(vkCreateQueryPool),
        ORO_DEVICE(vkBeginCommandBuffer),
        ORO_DEVICE(vkEndCommandBuffer),
        ORO_DEVICE(vkQueueSubmit2),
        ORO_DEVICE(vkWaitForFences),
        ORO_DEVICE(vkResetFences),
        ORO_DEVICE(vkQueueWaitIdle),
        ORO_DEVICE(vkDeviceWaitIdle),
        ORO_DEVICE(vkCreateSwapchainKHR),
        ORO_DEVICE(vkGetSwapchainImagesKHR),
        ORO_DEVICE(vkAcquireNextImageKHR),
        ORO_DEVICE(vkQueuePresentKHR),
    };
#undef ORO_DEVICE
#undef ORO_SURFACE
#undef ORO_OWN
    return all;
}

PFN_vkVoidFunction hook(const char* name) {
    const auto found = hooks().find(name);
    return found != hooks().end() ? found->second : nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_proc(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(device_proc);
    const PFN_vkVoidFunction next = state().next_device_proc(device, name);
    const PFN_vkVoidFunction own = hook(name);
    return own != nullptr && next != nullptr ? own : next;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_proc(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(instance_proc);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(device_proc);
    // Before there is an instance, whatever its handle says.
    if (instance == VK_NULL_HANDLE || state().next_instance_proc == nullptr) return hook(name);
    const PFN_vkVoidFunction next = state().next_instance_proc(instance, name);
    const PFN_vkVoidFunction own = hook(name);
    return own != nullptr && next != nullptr ? own : next;
}

}  // namespace
}  // namespace oro::test

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
    version->loaderLayerInterfaceVersion = 2;
    version->pfnGetInstanceProcAddr = oro::test::instance_proc;
    version->pfnGetDeviceProcAddr = oro::test::device_proc;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
