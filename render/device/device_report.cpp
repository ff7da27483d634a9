#include "render/device/device_report.h"

#include <algorithm>
#include <cstring>

#include "render/device/raster_request.h"

namespace oro {
namespace {

// What a device has cannot be told where asking fails: that is no lack.
Result<bool> has_extension(VkPhysicalDevice physical, const char* wanted) {
    std::uint32_t count = 0;
    ORO_VK(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr));
    std::vector<VkExtensionProperties> all(count);
    ORO_VK(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, all.data()));
    return std::any_of(all.begin(), all.end(), [&](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, wanted) == 0;
    });
}

void describe_properties(VkPhysicalDevice physical, DeviceReport& report) {
    VkPhysicalDeviceMeshShaderPropertiesEXT mesh{};
    mesh.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_PROPERTIES_EXT;
    VkPhysicalDeviceVulkan12Properties vulkan12{};
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES;
    VkPhysicalDeviceVulkan11Properties vulkan11{};
    vulkan11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    vulkan11.pNext = &vulkan12;
    properties.pNext = &vulkan11;
    VkPhysicalDeviceVulkan13Properties vulkan13{};
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES;
    vulkan12.pNext = &vulkan13;
    if (report.mesh_shader) vulkan13.pNext = &mesh;
    vkGetPhysicalDeviceProperties2(physical, &properties);
    const VkPhysicalDeviceLimits& limits = properties.properties.limits;
    report.name = properties.properties.deviceName;
    report.driver = std::string(vulkan12.driverName) + " " + vulkan12.driverInfo;
    report.vulkan_version = properties.properties.apiVersion;
    report.subgroup_size = vulkan11.subgroupSize;
    report.mesh_ballots = vulkan13.minSubgroupSize == vulkan13.maxSubgroupSize &&
                          (vulkan11.subgroupSupportedStages & VK_SHADER_STAGE_MESH_BIT_EXT) != 0 &&
                          (vulkan11.subgroupSupportedOperations & VK_SUBGROUP_FEATURE_BALLOT_BIT) != 0 &&
                          vulkan11.subgroupSize <= mesh.maxMeshWorkGroupInvocations;
    report.max_picture_side_px =
        std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight,
                  limits.maxViewportDimensions[0], limits.maxViewportDimensions[1]});
    report.mesh = {mesh.maxPreferredTaskWorkGroupInvocations,
                   mesh.maxPreferredMeshWorkGroupInvocations,
                   mesh.maxTaskWorkGroupInvocations,
                   mesh.maxMeshWorkGroupInvocations,
                   mesh.maxMeshOutputVertices,
                   mesh.maxMeshOutputPrimitives,
                   mesh.maxTaskWorkGroupTotalCount};
}

Result<void> describe_lacks(VkPhysicalDevice physical, const GpuOptions& options, DeviceReport& report) {
    VkPhysicalDeviceMeshShaderFeaturesEXT mesh{};
    mesh.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_FEATURES_EXT;
    VkPhysicalDeviceVulkan13Features vulkan13{};
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    VkPhysicalDeviceVulkan12Features vulkan12{};
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &vulkan12;
    vulkan12.pNext = &vulkan13;
    if (report.mesh_shader) vulkan13.pNext = &mesh;
    vkGetPhysicalDeviceFeatures2(physical, &features);
    if (!vulkan12.bufferDeviceAddress) report.lacks.push_back(DeviceLack::buffer_device_address);
    if (!vulkan12.scalarBlockLayout) report.lacks.push_back(DeviceLack::scalar_block_layout);
    if (!vulkan13.synchronization2) report.lacks.push_back(DeviceLack::synchronization2);
    if (!vulkan13.dynamicRendering) report.lacks.push_back(DeviceLack::dynamic_rendering);
    if (!vulkan13.maintenance4) report.lacks.push_back(DeviceLack::maintenance4);
    report.mesh_shader = report.mesh_shader && mesh.meshShader && mesh.taskShader;
    report.mesh_ballots = report.mesh_ballots && report.mesh_shader && vulkan13.computeFullSubgroups;
    report.compute_raster =
        !options.without_compute_raster && features.features.shaderInt64 && vulkan12.shaderBufferInt64Atomics;
    report.fragment_stores = features.features.fragmentStoresAndAtomics == VK_TRUE;
    if (!report.mesh_shader && !report.compute_raster) report.lacks.push_back(DeviceLack::way_of_drawing);
    if (!graphics_queue_family(physical)) report.lacks.push_back(DeviceLack::queue);
    if (!options.presents) return {};
    ORO_TRY(const bool presents, has_extension(physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME));
    if (!presents) report.lacks.push_back(DeviceLack::swapchain);
    return {};
}

std::vector<VkQueueFamilyProperties> queue_families(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    return families;
}

}  // namespace

std::optional<std::uint32_t> graphics_queue_family(VkPhysicalDevice physical) {
    const std::vector<VkQueueFamilyProperties> families = queue_families(physical);
    constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < families.size(); ++i) {
        if ((families[i].queueFlags & wanted) == wanted && families[i].timestampValidBits > 0) return i;
    }
    return std::nullopt;
}

std::uint64_t timestamp_mask(VkPhysicalDevice physical, std::uint32_t queue_family) {
    const std::uint32_t bits = queue_families(physical)[queue_family].timestampValidBits;
    return bits >= 64 ? UINT64_MAX : (std::uint64_t{1} << bits) - 1;
}

Result<DeviceReport> describe_device(VkPhysicalDevice physical, const GpuOptions& options) {
    DeviceReport report;
    VkPhysicalDeviceProperties plain{};
    vkGetPhysicalDeviceProperties(physical, &plain);
    report.name = plain.deviceName;
    report.kind = plain.deviceType;
    report.vulkan_version = plain.apiVersion;
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            report.memory_bytes = std::max<std::uint64_t>(report.memory_bytes, memory.memoryHeaps[i].size);
    }
    if (plain.apiVersion < VK_API_VERSION_1_3) {
        report.lacks.push_back(DeviceLack::vulkan_1_3);
        return report;
    }
    if (!options.without_mesh_shader) {
        ORO_TRY(report.mesh_shader, has_extension(physical, VK_EXT_MESH_SHADER_EXTENSION_NAME));
    }
    describe_properties(physical, report);
    ORO_CHECK(describe_lacks(physical, options, report));
    return report;
}

Result<RasterPath> raster_path_for(const std::string& request, const DeviceReport& device) {
    const std::optional<RasterRequest> named = raster_request_named(request);
    const bool wants_mesh =
        named == RasterRequest::mesh || (named == RasterRequest::automatic && device.mesh_shader);
    if (wants_mesh ? device.mesh_shader : device.compute_raster)
        return wants_mesh ? RasterPath::mesh : RasterPath::compute;
    return Error{
        ErrorKind::no_device, "--pipeline " + request,
        device.name +
            (wants_mesh
                 ? " has no VK_EXT_mesh_shader; --pipeline compute draws without it, or get a current driver"
                 : " has no 64-bit atomics in buffers; --pipeline mesh draws without them")};
}

std::string name_of(RasterPath path) {
    return path == RasterPath::mesh ? "mesh" : "compute";
}

}  // namespace oro
