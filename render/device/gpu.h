// The device: which GPUs there are, what they can do, and the one that draws.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/device/vulkan.h"

namespace oro {

// Limits and preferences that the mesh path is shaped by. Zero on devices without VK_EXT_mesh_shader.
struct MeshShaderLimits {
    std::uint32_t preferred_task_invocations{};
    std::uint32_t preferred_mesh_invocations{};
    std::uint32_t max_task_invocations{};
    std::uint32_t max_mesh_invocations{};
    std::uint32_t max_output_vertices{};
    std::uint32_t max_output_primitives{};
    std::uint32_t max_task_groups_total{};
};

// What Orograph needs and a device may not have.
enum class DeviceLack {
    vulkan_1_3,
    buffer_device_address,
    scalar_block_layout,
    synchronization2,
    dynamic_rendering,
    maintenance4,
    way_of_drawing,  // mesh shaders or 64-bit atomics
    queue,           // for graphics and compute, with timestamps
    swapchain        // where a window is asked for
};

// One device as the driver describes it; device_report.h makes words of it.
struct DeviceReport {
    std::string name;
    VkPhysicalDeviceType kind{};
    std::string driver;              // name and version as the driver gives them
    std::uint32_t vulkan_version{};  // packed, as VK_API_VERSION_MAJOR and its like take it
    bool mesh_shader{};              // VK_EXT_mesh_shader with task shaders: the mesh path runs
    bool fragment_stores{};          // fragment shaders may count
    bool compute_raster{};           // 64-bit integers and atomics in buffers: the compute path runs
    MeshShaderLimits mesh;
    std::uint32_t subgroup_size{};
    bool mesh_ballots{};                  // mesh shaders vote, in whole subgroups of that one size
    std::uint32_t max_picture_side_px{};  // largest image and framebuffer side
    std::uint64_t memory_bytes{};         // of the largest device-local heap
    std::vector<DeviceLack> lacks;

    [[nodiscard]] bool can_draw() const { return lacks.empty(); }
};

struct GpuOptions {
    std::string device_name;  // "" for the best; else part of a device's name, or its number in the list
    bool validation{false};   // the Khronos validation layer, with synchronization validation
    std::vector<const char*> instance_extensions;  // for a window's surface
    bool presents{false};                          // needs VK_KHR_swapchain
    bool without_mesh_shader{false};     // treat every device as one without VK_EXT_mesh_shader (for tests)
    bool without_compute_raster{false};  // ... as one without 64-bit atomics
};
// Options as the environment sets them: OROGRAPH_DEVICE, OROGRAPH_VALIDATION=1,
// OROGRAPH_WITHOUT=mesh_shader,compute.
GpuOptions gpu_options_from_environment();

// The two ways from meshlets to triangle ids.
enum class RasterPath { mesh, compute };

// The way that a request ("auto", "mesh", "compute") means on a device; auto takes mesh shaders where there
// are any, without measuring (render/frame/calibration.h does). Errors (no_device): the device lacks what
// the request names.
Result<RasterPath> raster_path_for(const std::string& request, const DeviceReport& device);
// "mesh" or "compute".
std::string name_of(RasterPath path);

// Instance, device, queue. Not copyable or movable: everything else points to it.
class Gpu {
  public:
    // Errors (no_device): no Vulkan driver, no device that has what is needed; each says how to get one.
    static Result<std::unique_ptr<Gpu>> create(const GpuOptions& options);
    // What a machine has, best first, without making a device. Errors (no_device): no Vulkan driver.
    static Result<std::vector<DeviceReport>> survey(const GpuOptions& options);
    ~Gpu();
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
    [[nodiscard]] VkDevice device() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] std::uint32_t queue_family() const { return queue_family_; }
    [[nodiscard]] const DeviceReport& report() const { return report_; }
    // Seconds from one timestamp of the queue to a later one: over their valid bits, which may have begun
    // anew once.
    [[nodiscard]] double seconds_between(std::uint64_t from_ticks, std::uint64_t to_ticks) const;
    [[nodiscard]] PFN_vkCmdDrawMeshTasksIndirectEXT draw_mesh_tasks_indirect() const {
        return draw_mesh_tasks_indirect_;
    }
    // Messages of the validation layer so far (warnings and errors).
    [[nodiscard]] const std::vector<std::string>& validation_messages() const { return messages_; }

    // What is made once for the device and ends just before it: render/pipelines/pipelines.h keeps its
    // programs there, and nobody else anything. Null until then.
    [[nodiscard]] std::shared_ptr<void>& kept() const { return kept_; }
    // Memory type with all of `properties` among the allowed bits; nothing when the device has none.
    [[nodiscard]] std::optional<std::uint32_t> memory_type(std::uint32_t allowed_bits,
                                                           VkMemoryPropertyFlags properties) const;
    // Waits until nothing is under way: before what frames use is given up. A device that is lost has nothing
    // under way.
    void wait_idle() const { vkDeviceWaitIdle(device_); }
    // Names an object for validation messages and debuggers.
    void name(VkObjectType type, std::uint64_t handle, const std::string& name) const;
    template <class Handle>
    void name(VkObjectType type, Handle handle, const std::string& text) const {
        name(type, reinterpret_cast<std::uint64_t>(handle), text);
    }

  private:
    Gpu() = default;
    Result<void> create_instance(const GpuOptions& options);
    Result<void> choose_device(const GpuOptions& options);
    Result<void> create_device(const GpuOptions& options);

    VkInstance instance_{VK_NULL_HANDLE};
    VkDebugUtilsMessengerEXT messenger_{VK_NULL_HANDLE};
    VkPhysicalDevice physical_{VK_NULL_HANDLE};
    VkDevice device_{VK_NULL_HANDLE};
    VkQueue queue_{VK_NULL_HANDLE};
    std::uint32_t queue_family_{};
    double timestamp_period_ns_{};
    std::uint64_t timestamp_mask_{};  // its valid bits
    DeviceReport report_;
    VkPhysicalDeviceMemoryProperties memory_{};
    std::vector<std::string> messages_;
    mutable std::shared_ptr<void> kept_;
    PFN_vkCmdDrawMeshTasksIndirectEXT draw_mesh_tasks_indirect_{nullptr};
    PFN_vkSetDebugUtilsObjectNameEXT set_object_name_{nullptr};
};

}  // namespace oro
