#include "render/pipelines/pipeline_parts.h"

#include <algorithm>
#include <array>

namespace oro {

// Source: SPIR-V Specification, 2.3 (five words, then instructions that begin with their length and number)
// and 3.23 (loop control).
std::vector<std::uint32_t> with_whole_loops(std::span<const std::uint32_t> words) {
    constexpr std::size_t header_words = 5;
    constexpr std::uint32_t op_loop_merge = 246, unroll = 1, dont_unroll = 2;
    std::vector<std::uint32_t> whole(words.begin(), words.end());
    for (std::size_t at = header_words; at + 3 < whole.size();) {
        const std::uint32_t length = whole[at] >> 16U;
        if ((whole[at] & 0xffffU) == op_loop_merge) whole[at + 3] = (whole[at + 3] & ~unroll) | dont_unroll;
        at += std::max(length, 1U);
    }
    return whole;
}

Result<OwnedShader> create_shader(const Gpu& gpu, std::span<const std::uint32_t> words, const char* name) {
    std::vector<std::uint32_t> whole;
    if (gpu.report().kind == VK_PHYSICAL_DEVICE_TYPE_CPU) words = whole = with_whole_loops(words);
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    VkShaderModule handle{};
    ORO_VK(vkCreateShaderModule(gpu.device(), &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_SHADER_MODULE, handle, name);
    return OwnedShader(gpu.device(), handle);
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, const OwnedShader& shader,
                                      const VkSpecializationInfo* constants) {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = bit;
    info.module = shader.get();
    info.pName = "main";
    info.pSpecializationInfo = constants;
    return info;
}

Result<OwnedPipelineLayout> create_push_layout(const Gpu& gpu, VkShaderStageFlags stages, std::uint32_t bytes,
                                               const char* name) {
    const VkPushConstantRange range{stages, 0, bytes};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    VkPipelineLayout handle{};
    ORO_VK(vkCreatePipelineLayout(gpu.device(), &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, handle, name);
    return OwnedPipelineLayout(gpu.device(), handle);
}

Result<OwnedPipeline> create_plain_compute(const Gpu& gpu, VkPipelineLayout layout,
                                           std::span<const std::uint32_t> words, const char* name) {
    ORO_TRY(const OwnedShader shader, create_shader(gpu, words, name));
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, shader, nullptr);
    info.layout = layout;
    VkPipeline handle{};
    ORO_VK(vkCreateComputePipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_PIPELINE, handle, name);
    return OwnedPipeline(gpu.device(), handle);
}

AllConstants::AllConstants(const VkSpecializationInfo* own, const Pipelines& pipelines) {
    if (own != nullptr) {
        entries_.assign(own->pMapEntries, own->pMapEntries + own->mapEntryCount);
        const auto* const values = static_cast<const std::byte*>(own->pData);
        values_.assign(values, values + own->dataSize);
    }
    constexpr std::uint32_t heights_packed = 100;
    const ListRoom& room = pipelines.list_room;
    const std::array<std::uint32_t, 6> common{
        pipelines.packed_heights ? VK_TRUE : VK_FALSE, room.boxes, room.large, room.tasks, room.clips,
        pipelines.meshes ? VK_TRUE : VK_FALSE};
    for (std::uint32_t id = heights_packed; const std::uint32_t& value : common) {
        entries_.push_back({id++, static_cast<std::uint32_t>(values_.size()), sizeof(value)});
        const auto* const bytes = reinterpret_cast<const std::byte*>(&value);
        values_.insert(values_.end(), bytes, bytes + sizeof(value));
    }
    info_ = {static_cast<std::uint32_t>(entries_.size()), entries_.data(), values_.size(), values_.data()};
}

}  // namespace oro
