#include "tests/faulty_vulkan/made_up_devices.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <sstream>
#include <vector>

namespace oro::test {
namespace {

constexpr std::uint32_t timestamp_bits = 36;

// What a VkPhysicalDevice points to; the loader's own word comes first.
struct MadeUpDevice {
    void* loader_word{};
    VkPhysicalDeviceType type{};
    std::string name;
    std::vector<std::string> lacks;

    [[nodiscard]] bool lacks_it(const char* what) const {
        return std::find(lacks.begin(), lacks.end(), what) != lacks.end();
    }
};

struct Devices {
    bool made_up{false};
    std::vector<std::unique_ptr<MadeUpDevice>> all;
    VkInstance instance{};
    VkPhysicalDevice real{};
    FunctionBelow next{};
};
Devices& devices() {
    static Devices the;
    return the;
}

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(devices().next(name));
}

const MadeUpDevice* made_up(VkPhysicalDevice device) {
    for (const auto& one : devices().all) {
        if (static_cast<void*>(one.get()) == static_cast<void*>(device)) return one.get();
    }
    return nullptr;
}
bool lacks(VkPhysicalDevice device, const char* what) {
    const MadeUpDevice* const one = made_up(device);
    return one != nullptr && one->lacks_it(what);
}

MadeUpDevice device_from(const std::string& text) {
    MadeUpDevice device;
    const std::size_t space = text.find(' '), without = text.find(" without ");
    const std::string kind = text.substr(0, space);
    device.type = kind == "discrete"     ? VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU
                  : kind == "integrated" ? VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU
                  : kind == "virtual"    ? VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU
                                         : VK_PHYSICAL_DEVICE_TYPE_CPU;
    device.name = text.substr(space + 1, without == std::string::npos ? without : without - space - 1);
    if (without == std::string::npos) return device;
    std::istringstream words(text.substr(without + std::strlen(" without ")));
    for (std::string word; std::getline(words, word, ',');) device.lacks.push_back(word);
    return device;
}

void change(const MadeUpDevice& device, VkPhysicalDeviceProperties& properties) {
    properties.deviceType = device.type;
    std::strncpy(properties.deviceName, device.name.c_str(), sizeof properties.deviceName - 1);
    if (device.lacks_it("vulkan13")) properties.apiVersion = VK_API_VERSION_1_2;
}

// As Vulkan hands out lists.
template <class Value>
VkResult hand_out(const std::vector<Value>& values, std::uint32_t* count, Value* to) {
    const auto all = static_cast<std::uint32_t>(values.size());
    if (to == nullptr) {
        *count = all;
        return VK_SUCCESS;
    }
    *count = std::min(*count, all);
    std::copy_n(values.begin(), *count, to);
    return *count < all ? VK_INCOMPLETE : VK_SUCCESS;
}

}  // namespace

void make_up_devices(const std::string& list, VkInstance instance, FunctionBelow next_proc) {
    Devices& the = devices();
    the.instance = instance;
    the.next = next_proc;
    the.all.clear();
    the.made_up = !list.empty();
    if (!the.made_up) return;
    std::uint32_t count = 1;
    const VkResult found =
        next<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(instance, &count, &the.real);
    if ((found != VK_SUCCESS && found != VK_INCOMPLETE) || count == 0 || list == "none") return;
    std::istringstream texts(list);
    for (std::string text; std::getline(texts, text, ';');) {
        the.all.push_back(std::make_unique<MadeUpDevice>(device_from(text)));
        std::memcpy(&the.all.back()->loader_word, static_cast<void*>(the.real), sizeof(void*));
    }
}

VkPhysicalDevice real_device(VkPhysicalDevice device) {
    return made_up(device) != nullptr ? devices().real : device;
}

VkResult enumerate_made_up(VkInstance instance, std::uint32_t* count, VkPhysicalDevice* to) {
    if (!devices().made_up)
        return next<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(instance, count, to);
    std::vector<VkPhysicalDevice> handles;
    for (const auto& one : devices().all) handles.push_back(reinterpret_cast<VkPhysicalDevice>(one.get()));
    return hand_out(handles, count, to);
}

VkResult extensions_of_made_up(VkPhysicalDevice device, const char* layer, std::uint32_t* count,
                               VkExtensionProperties* to) {
    const auto ask = next<PFN_vkEnumerateDeviceExtensionProperties>("vkEnumerateDeviceExtensionProperties");
    if (layer != nullptr || made_up(device) == nullptr) return ask(real_device(device), layer, count, to);
    std::uint32_t all = 0;
    ask(devices().real, nullptr, &all, nullptr);
    std::vector<VkExtensionProperties> extensions(all);
    ask(devices().real, nullptr, &all, extensions.data());
    std::erase_if(extensions, [&](const VkExtensionProperties& one) {
        const std::string name = one.extensionName;
        return (name == VK_EXT_MESH_SHADER_EXTENSION_NAME && lacks(device, "mesh_shader")) ||
               (name == VK_KHR_SWAPCHAIN_EXTENSION_NAME && lacks(device, "swapchain"));
    });
    return hand_out(extensions, count, to);
}

VKAPI_ATTR void VKAPI_CALL made_up_properties(VkPhysicalDevice device,
                                              VkPhysicalDeviceProperties* properties) {
    next<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(real_device(device), properties);
    if (const MadeUpDevice* const one = made_up(device)) change(*one, *properties);
}

VKAPI_ATTR void VKAPI_CALL made_up_properties2(VkPhysicalDevice device,
                                               VkPhysicalDeviceProperties2* properties) {
    next<PFN_vkGetPhysicalDeviceProperties2>("vkGetPhysicalDeviceProperties2")(real_device(device),
                                                                               properties);
    if (const MadeUpDevice* const one = made_up(device)) change(*one, properties->properties);
}

VKAPI_ATTR void VKAPI_CALL made_up_features2(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features) {
    next<PFN_vkGetPhysicalDeviceFeatures2>("vkGetPhysicalDeviceFeatures2")(real_device(device), features);
    if (lacks(device, "atomics")) features->features.shaderInt64 = VK_FALSE;
    for (auto* part = static_cast<VkBaseOutStructure*>(features->pNext); part != nullptr;
         part = part->pNext) {
        if (part->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES) continue;
        auto* const vulkan12 = reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(part);
        if (lacks(device, "atomics")) vulkan12->shaderBufferInt64Atomics = VK_FALSE;
        if (lacks(device, "addresses")) vulkan12->bufferDeviceAddress = VK_FALSE;
    }
}

VKAPI_ATTR void VKAPI_CALL made_up_memory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory) {
    next<PFN_vkGetPhysicalDeviceMemoryProperties>("vkGetPhysicalDeviceMemoryProperties")(real_device(device),
                                                                                         memory);
}

VKAPI_ATTR void VKAPI_CALL made_up_queue_families(VkPhysicalDevice device, std::uint32_t* count,
                                                  VkQueueFamilyProperties* families) {
    next<PFN_vkGetPhysicalDeviceQueueFamilyProperties>("vkGetPhysicalDeviceQueueFamilyProperties")(
        real_device(device), count, families);
    for (std::uint32_t i = 0; families != nullptr && i < *count; ++i) {
        if (lacks(device, "timestamps")) families[i].timestampValidBits = 0;
        if (lacks(device, "whole_timestamps")) families[i].timestampValidBits = timestamp_bits;
    }
}

void spoil_timestamps(std::uint64_t* ticks, std::uint32_t count) {
    const bool narrow = std::any_of(devices().all.begin(), devices().all.end(),
                                    [](const auto& one) { return one->lacks_it("whole_timestamps"); });
    if (!narrow || count == 0) return;
    constexpr std::uint64_t range = std::uint64_t{1} << timestamp_bits;
    constexpr std::uint64_t noise = 0x9e3779b97f4a7c15U;
    const std::uint64_t first = ticks[0];
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t since_start = ticks[i] - first;
        ticks[i] = ((range - 1 + since_start) & (range - 1)) | (noise * (i + 1) & ~(range - 1));
    }
}

}  // namespace oro::test
