// Physical devices that nobody has, as tests describe them; each draws as the driver's first one does.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

namespace oro::test {

// What lies below the layer, of a name.
using FunctionBelow = PFN_vkVoidFunction (*)(const char* name);

// Takes on a list: "discrete Big GPU;software Slow without mesh_shader,atomics". A device is a kind
// (discrete, integrated, virtual, software), a name, and what it lacks: mesh_shader, atomics, swapchain,
// timestamps, vulkan13, addresses (bufferDeviceAddress), or whole_timestamps (of 64 bits, 36 count; the
// others are noise). "none" is a list without a device; "" leaves the driver's own.
void make_up_devices(const std::string& list, VkInstance instance, FunctionBelow next);

// The driver's device behind one of these (or itself).
VkPhysicalDevice real_device(VkPhysicalDevice device);

// What the Vulkan functions of like names tell of them.
VkResult enumerate_made_up(VkInstance instance, std::uint32_t* count, VkPhysicalDevice* devices);
VkResult extensions_of_made_up(VkPhysicalDevice device, const char* layer, std::uint32_t* count,
                               VkExtensionProperties* extensions);
VKAPI_ATTR void VKAPI_CALL made_up_properties(VkPhysicalDevice device,
                                              VkPhysicalDeviceProperties* properties);
VKAPI_ATTR void VKAPI_CALL made_up_properties2(VkPhysicalDevice device,
                                               VkPhysicalDeviceProperties2* properties);
VKAPI_ATTR void VKAPI_CALL made_up_features2(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features);
VKAPI_ATTR void VKAPI_CALL made_up_memory(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory);
VKAPI_ATTR void VKAPI_CALL made_up_queue_families(VkPhysicalDevice device, std::uint32_t* count,
                                                  VkQueueFamilyProperties* families);

// Where the devices have timestamps of 36 bits: takes away what does not fit, puts noise there, and lets them
// begin anew after the first.
void spoil_timestamps(std::uint64_t* ticks, std::uint32_t count);

}  // namespace oro::test
