// What every pipeline is made of: shaders, their constants, stages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/device/gpu.h"
#include "render/device/resources.h"
#include "render/pipelines/pipelines.h"

namespace oro {

// SPIR-V words whose loops all stay loops, whatever they ask for. A driver that compiles for processors
// unrolls those of few turns, and then takes up to twice as long for a program: it works on each turn by
// itself.
std::vector<std::uint32_t> with_whole_loops(std::span<const std::uint32_t> words);

// A module of SPIR-V words; where a processor draws, of their with_whole_loops(). Errors: the device.
Result<OwnedShader> create_shader(const Gpu& gpu, std::span<const std::uint32_t> words, const char* name);

// The entry point of a shader; shader and constants must outlive what is returned.
VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, const OwnedShader& shader,
                                      const VkSpecializationInfo* constants);

// A layout of push constants alone: `bytes` of them, which these stages read. Errors: the device.
Result<OwnedPipelineLayout> create_push_layout(const Gpu& gpu, VkShaderStageFlags stages, std::uint32_t bytes,
                                               const char* name);

// A compute program with this layout and no constants of its own, with the shader's name. Errors: the device.
Result<OwnedPipeline> create_plain_compute(const Gpu& gpu, VkPipelineLayout layout,
                                           std::span<const std::uint32_t> words, const char* name);

// A program's own constants, and those that many programs have: all that read heights
// (shaders/place/heights.glsl), all that list triangles (shaders/choose/lists.glsl), and all that place those
// of meshes (shaders/place/mesh.glsl).
class AllConstants {
  public:
    // own: may be null.
    AllConstants(const VkSpecializationInfo* own, const Pipelines& pipelines);
    AllConstants(const AllConstants&) = delete;
    AllConstants& operator=(const AllConstants&) = delete;
    // Points into this.
    [[nodiscard]] const VkSpecializationInfo* info() const { return &info_; }

  private:
    std::vector<VkSpecializationMapEntry> entries_;
    std::vector<std::byte> values_;
    VkSpecializationInfo info_{};
};

// Adds the programs of the mesh path: terrain, terrain_ties and the sizes of their workgroups in Pipelines.
// Errors: the device.
Result<void> add_mesh_pipelines(const Gpu& gpu, const PipelineWants& wants, Pipelines& pipelines);

// Draws clusters; ties: as Pipelines.terrain_ties. Errors: the device.
Result<OwnedPipeline> create_cluster_terrain(const Gpu& gpu, const Pipelines& pipelines, bool ties);

// Adds the programs of the compute rasteriser: raster_clear and those that follow it in Pipelines. Errors:
// the device.
Result<void> add_raster_pipelines(const Gpu& gpu, const PipelineWants& wants, Pipelines& pipelines);

// Adds its programs of clusters, once these are there. Errors: the device.
Result<void> add_cluster_raster(const Gpu& gpu, Pipelines& pipelines);

}  // namespace oro
