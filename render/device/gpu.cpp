#include "render/device/gpu.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "core/base/system_room.h"
#include "render/device/device_report.h"
#include "render/device/software_driver.h"

namespace oro {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                            VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data,
                                            void* messages) {
    static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::vector<std::string>* messages) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = keep_message;
    info.pUserData = messages;
    return info;
}

// A driver that finds no room for itself says no more than that it failed: whether that may be why.
std::string words_of_limited_memory() {
    const std::optional<std::uint64_t> limit = memory_limit_bytes();
    if (!limit) return "";
    return "; it may have found too little memory: this program is allowed " + std::to_string(*limit >> 20U) +
           " MiB (ulimit -v)";
}

Error no_driver(const std::string& reason) {
    return {ErrorKind::no_device, "Vulkan",
            "no driver answers (" + reason + words_of_limited_memory() +
                "). Install the one for your GPU, or the software driver: scripts/set-up brings it"};
}

// Better devices first; among equals the driver's own order.
int device_rank(const DeviceReport& report) {
    const int kind = report.kind == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU     ? 3
                     : report.kind == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU ? 2
                     : report.kind == VK_PHYSICAL_DEVICE_TYPE_CPU            ? 0
                                                                             : 1;
    return kind + (report.can_draw() ? 10 : 0);
}

struct Candidate {
    VkPhysicalDevice physical;
    DeviceReport report;
};

// Asked again when devices came between counting and listing them.
Result<std::vector<VkPhysicalDevice>> physical_devices(VkInstance instance) {
    std::vector<VkPhysicalDevice> devices;
    for (;;) {
        std::uint32_t count = 0;
        VkResult found = vkEnumeratePhysicalDevices(instance, &count, nullptr);
        devices.resize(count);
        if (found == VK_SUCCESS && count > 0)
            found = vkEnumeratePhysicalDevices(instance, &count, devices.data());
        if (found == VK_INCOMPLETE) continue;
        devices.resize(count);
        if (is_out_of_memory(found)) return vulkan_checked(found, "vkEnumeratePhysicalDevices(").error();
        if (found != VK_SUCCESS) return no_driver(vulkan_result_name(found));
        if (devices.empty()) return no_driver("no device");
        return devices;
    }
}

Result<std::vector<Candidate>> candidates(VkInstance instance, const GpuOptions& options) {
    ORO_TRY(const std::vector<VkPhysicalDevice> devices, physical_devices(instance));
    std::vector<Candidate> all;
    for (VkPhysicalDevice device : devices) {
        ORO_TRY(DeviceReport report, describe_device(device, options));
        all.push_back({device, std::move(report)});
    }
    std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
        return device_rank(a.report) > device_rank(b.report);
    });
    return all;
}

bool is_named(const Candidate& candidate, std::size_t number, const std::string& wanted) {
    return wanted.empty() || wanted == std::to_string(number) ||
           candidate.report.name.find(wanted) != std::string::npos;
}

Error nothing_suitable(const std::vector<Candidate>& all, const std::string& wanted) {
    std::string list;
    bool named = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!is_named(all[i], i, wanted)) continue;
        named = true;
        list += (list.empty() ? "" : "; ") + all[i].report.name + " lacks ";
        for (std::size_t k = 0; k < all[i].report.lacks.size(); ++k)
            list += (k ? ", " : "") + lack_words(all[i].report.lacks[k]);
    }
    if (!named)
        return {ErrorKind::no_device, "OROGRAPH_DEVICE",
                "no device is called '" + wanted + "' (see orograph doctor)"};
    return {
        ErrorKind::no_device, "GPU",
        "none can draw (" + list +
            "). Get a driver with VK_EXT_mesh_shader: a current one for your GPU, or the software driver of "
            "Mesa 24.1 or later, which scripts/set-up brings"};
}

}  // namespace

GpuOptions gpu_options_from_environment() {
    GpuOptions options;
    if (const char* device = std::getenv("OROGRAPH_DEVICE")) options.device_name = device;
    if (const char* wanted = std::getenv("OROGRAPH_VALIDATION"))
        options.validation = std::strcmp(wanted, "1") == 0;
    if (const char* without = std::getenv("OROGRAPH_WITHOUT")) {
        options.without_mesh_shader = std::strstr(without, "mesh_shader") != nullptr;
        options.without_compute_raster = std::strstr(without, "compute") != nullptr;
    }
    return options;
}

Result<void> Gpu::create_instance(const GpuOptions& options) {
    std::uint32_t version = 0;
    if (vkEnumerateInstanceVersion(&version) != VK_SUCCESS || version < VK_API_VERSION_1_3)
        return no_driver("the Vulkan loader is older than 1.3");
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "Orograph";
    application.apiVersion = VK_API_VERSION_1_3;
    std::vector<const char*> extensions = options.instance_extensions;
    std::vector<const char*> layers;
    VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(&messages_);
    const VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;
    features.pNext = &messenger;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (options.validation) {
        layers.push_back(validation_layer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        info.pNext = &features;
    }
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult made = vkCreateInstance(&info, nullptr, &instance_);
    if (made == VK_ERROR_LAYER_NOT_PRESENT)
        return Error{ErrorKind::failed, "OROGRAPH_VALIDATION",
                     "the validation layer is not installed (vulkan-validationlayers)"};
    if (is_out_of_memory(made)) return vulkan_checked(made, "vkCreateInstance(").error();
    if (made != VK_SUCCESS) return no_driver(vulkan_result_name(made));
    if (options.validation) {
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
        if (create)
            ORO_CHECK(vulkan_checked(create(instance_, &messenger, nullptr, &messenger_),
                                     "vkCreateDebugUtilsMessengerEXT("));
        set_object_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
            vkGetInstanceProcAddr(instance_, "vkSetDebugUtilsObjectNameEXT"));
    }
    return {};
}

Result<void> Gpu::choose_device(const GpuOptions& options) {
    ORO_TRY(const std::vector<Candidate> all, candidates(instance_, options));
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!all[i].report.can_draw() || !is_named(all[i], i, options.device_name)) continue;
        physical_ = all[i].physical;
        report_ = all[i].report;
        queue_family_ = *graphics_queue_family(physical_);
        return {};
    }
    return nothing_suitable(all, options.device_name);
}

Result<void> Gpu::create_device(const GpuOptions& options) {
    if (report_.kind == VK_PHYSICAL_DEVICE_TYPE_CPU) ORO_CHECK(check_room_for_software_driver(report_.name));
    VkPhysicalDeviceMeshShaderFeaturesEXT mesh{};
    mesh.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_FEATURES_EXT;
    mesh.taskShader = mesh.meshShader = VK_TRUE;
    VkPhysicalDeviceVulkan13Features vulkan13{};
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    vulkan13.synchronization2 = vulkan13.dynamicRendering = vulkan13.maintenance4 = VK_TRUE;
    vulkan13.computeFullSubgroups = report_.mesh_ballots ? VK_TRUE : VK_FALSE;
    if (report_.mesh_shader) vulkan13.pNext = &mesh;
    VkPhysicalDeviceVulkan12Features vulkan12{};
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    vulkan12.bufferDeviceAddress = vulkan12.scalarBlockLayout = VK_TRUE;
    vulkan12.shaderBufferInt64Atomics = report_.compute_raster ? VK_TRUE : VK_FALSE;
    vulkan12.pNext = &vulkan13;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.features.shaderInt64 = report_.compute_raster ? VK_TRUE : VK_FALSE;
    VkPhysicalDeviceFeatures2 known{};
    known.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    vkGetPhysicalDeviceFeatures2(physical_, &known);
    features.features.shaderFloat64 = known.features.shaderFloat64;  // PlanPass
    features.features.fragmentStoresAndAtomics = report_.fragment_stores ? VK_TRUE : VK_FALSE;
    features.pNext = &vulkan12;

    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    std::vector<const char*> extensions;
    if (report_.mesh_shader) extensions.push_back(VK_EXT_MESH_SHADER_EXTENSION_NAME);
    if (options.presents) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult made = vkCreateDevice(physical_, &info, nullptr, &device_);
    if (made != VK_SUCCESS && !is_out_of_memory(made) && made != VK_ERROR_DEVICE_LOST)
        return Error{ErrorKind::no_device, report_.name,
                     "cannot be used: vkCreateDevice gave " + vulkan_reason(made) +
                         " (OROGRAPH_DEVICE names another, orograph doctor lists them)"};
    ORO_CHECK(vulkan_checked(made, "vkCreateDevice("));
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical_, &properties);
    timestamp_period_ns_ = static_cast<double>(properties.limits.timestampPeriod);
    timestamp_mask_ = timestamp_mask(physical_, queue_family_);
    draw_mesh_tasks_indirect_ = reinterpret_cast<PFN_vkCmdDrawMeshTasksIndirectEXT>(
        vkGetDeviceProcAddr(device_, "vkCmdDrawMeshTasksIndirectEXT"));
    name(VK_OBJECT_TYPE_QUEUE, queue_, "queue");
    return {};
}

Result<std::unique_ptr<Gpu>> Gpu::create(const GpuOptions& options) {
    std::unique_ptr<Gpu> gpu(new Gpu);
    ORO_CHECK(gpu->create_instance(options));
    ORO_CHECK(gpu->choose_device(options));
    ORO_CHECK(gpu->create_device(options));
    return gpu;
}

Result<std::vector<DeviceReport>> Gpu::survey(const GpuOptions& options) {
    Gpu gpu;
    ORO_CHECK(gpu.create_instance(options));
    ORO_TRY(const std::vector<Candidate> all, candidates(gpu.instance_, options));
    std::vector<DeviceReport> reports;
    for (const Candidate& candidate : all) reports.push_back(candidate.report);
    return reports;
}

Gpu::~Gpu() {
    kept_.reset();
    if (device_) vkDestroyDevice(device_, nullptr);
    if (messenger_) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        if (destroy) destroy(instance_, messenger_, nullptr);
    }
    if (instance_) vkDestroyInstance(instance_, nullptr);
}

double Gpu::seconds_between(std::uint64_t from_ticks, std::uint64_t to_ticks) const {
    return static_cast<double>((to_ticks - from_ticks) & timestamp_mask_) * timestamp_period_ns_ * 1e-9;
}

std::optional<std::uint32_t> Gpu::memory_type(std::uint32_t allowed_bits,
                                              VkMemoryPropertyFlags properties) const {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
        const bool fits = (memory_.memoryTypes[i].propertyFlags & properties) == properties;
        if ((allowed_bits >> i & 1U) && fits) return i;
    }
    return std::nullopt;
}

void Gpu::name(VkObjectType type, std::uint64_t handle, const std::string& text) const {
    if (!set_object_name_ || !device_) return;
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = text.c_str();
    set_object_name_(device_, &info);
}

}  // namespace oro
