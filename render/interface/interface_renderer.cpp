#include "render/interface/interface_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "render/pipelines/pipeline_parts.h"
#include "spirv/interface_frag.h"
#include "spirv/interface_vert.h"

namespace oro {
namespace {

struct Push {
    float scale[2], shift[2];
};

// Corners as Dear ImGui has them.
constexpr VkVertexInputBindingDescription corner_binding{0, sizeof(ImDrawVert), VK_VERTEX_INPUT_RATE_VERTEX};
constexpr std::array<VkVertexInputAttributeDescription, 3> corner_parts{
    {{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, pos)},
     {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, uv)},
     {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(ImDrawVert, col)}}};

// What is drawn lies over what is there, by its opacity.
VkPipelineColorBlendAttachmentState laid_over() {
    VkPipelineColorBlendAttachmentState blend{};
    blend.blendEnable = VK_TRUE;
    blend.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.colorBlendOp = VK_BLEND_OP_ADD;
    blend.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.alphaBlendOp = VK_BLEND_OP_ADD;
    blend.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                           VK_COLOR_COMPONENT_A_BIT;
    return blend;
}

// What of a pipeline is the same whatever it draws over.
struct FixedStates {
    VkPipelineVertexInputStateCreateInfo input{};
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    VkPipelineViewportStateCreateInfo viewport{};
    VkPipelineRasterizationStateCreateInfo raster{};
    VkPipelineMultisampleStateCreateInfo samples{};

    FixedStates() {
        input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
        input.vertexBindingDescriptionCount = 1;
        input.pVertexBindingDescriptions = &corner_binding;
        input.vertexAttributeDescriptionCount = corner_parts.size();
        input.pVertexAttributeDescriptions = corner_parts.data();
        assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
        viewport.viewportCount = viewport.scissorCount = 1;
        raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
        raster.cullMode = VK_CULL_MODE_NONE;
        raster.lineWidth = 1.0F;
        samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    }
};

// A buffer for so many bytes, with room for more to come.
Result<void> grow(const Gpu& gpu, std::size_t bytes, VkBufferUsageFlags usage, const char* name,
                  Buffer& buffer) {
    if (buffer.size >= bytes) return {};
    ORO_TRY(buffer, create_buffer(gpu, bytes + bytes / 2, usage, MemoryKind::upload, name));
    return {};
}

}  // namespace

Result<InterfaceRenderer> InterfaceRenderer::create(const Gpu& gpu, VkFormat format) {
    InterfaceRenderer renderer;
    ORO_TRY(renderer.commands_, Commands::create(gpu, "interface"));
    ORO_CHECK(renderer.create_sets(gpu));
    ORO_CHECK(renderer.create_pipeline(gpu, format));
    return renderer;
}

Result<void> InterfaceRenderer::create_sets(const Gpu& gpu) {
    VkSamplerCreateInfo sampler{};
    sampler.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
    sampler.addressModeU = sampler.addressModeV = sampler.addressModeW =
        VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler_handle{};
    ORO_VK(vkCreateSampler(gpu.device(), &sampler, nullptr, &sampler_handle));
    sampler_ = {gpu.device(), sampler_handle};
    gpu.name(VK_OBJECT_TYPE_SAMPLER, sampler_handle, "interface");
    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    binding.descriptorCount = 1;
    binding.stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
    VkDescriptorSetLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout.bindingCount = 1;
    layout.pBindings = &binding;
    VkDescriptorSetLayout layout_handle{};
    ORO_VK(vkCreateDescriptorSetLayout(gpu.device(), &layout, nullptr, &layout_handle));
    set_layout_ = {gpu.device(), layout_handle};
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    VkDescriptorPool pool_handle{};
    ORO_VK(vkCreateDescriptorPool(gpu.device(), &pool, nullptr, &pool_handle));
    pool_ = {gpu.device(), pool_handle};
    VkDescriptorSetAllocateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set.descriptorPool = pool_handle;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &layout_handle;
    ORO_VK(vkAllocateDescriptorSets(gpu.device(), &set, &set_));
    return {};
}

Result<void> InterfaceRenderer::create_pipeline(const Gpu& gpu, VkFormat format) {
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Push)};
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = layout.pushConstantRangeCount = 1;
    layout.pSetLayouts = &set_layout;
    layout.pPushConstantRanges = &push;
    VkPipelineLayout layout_handle{};
    ORO_VK(vkCreatePipelineLayout(gpu.device(), &layout, nullptr, &layout_handle));
    layout_ = {gpu.device(), layout_handle};
    ORO_TRY(const OwnedShader corners, create_shader(gpu, interface_vert_spirv, "interface corners"));
    ORO_TRY(const OwnedShader pixels, create_shader(gpu, interface_frag_spirv, "interface pixels"));
    const std::array<VkPipelineShaderStageCreateInfo, 2> stages{
        stage(VK_SHADER_STAGE_VERTEX_BIT, corners, nullptr),
        stage(VK_SHADER_STAGE_FRAGMENT_BIT, pixels, nullptr)};
    const FixedStates fixed;
    const VkPipelineColorBlendAttachmentState over = laid_over();
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1;
    blend.pAttachments = &over;
    constexpr std::array<VkDynamicState, 2> states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = states.size();
    dynamic.pDynamicStates = states.data();
    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachmentFormats = &format;
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = stages.size();
    info.pStages = stages.data();
    info.pVertexInputState = &fixed.input;
    info.pInputAssemblyState = &fixed.assembly;
    info.pViewportState = &fixed.viewport;
    info.pRasterizationState = &fixed.raster;
    info.pMultisampleState = &fixed.samples;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout_handle;
    VkPipeline pipeline{};
    ORO_VK(vkCreateGraphicsPipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline));
    pipeline_ = {gpu.device(), pipeline};
    gpu.name(VK_OBJECT_TYPE_PIPELINE, pipeline, "interface");
    return {};
}

Result<void> InterfaceRenderer::take_fonts(const Gpu& gpu, ImFontAtlas& fonts) {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    fonts.GetTexDataAsAlpha8(&pixels, &width, &height);
    const VkExtent2D extent{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    const std::size_t bytes = std::size_t{extent.width} * extent.height;
    ORO_TRY(Image atlas, create_image(gpu, VK_FORMAT_R8_UNORM, extent,
                                      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                      VK_IMAGE_ASPECT_COLOR_BIT, "letters"));
    ORO_TRY(const Buffer staging, create_buffer(gpu, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                MemoryKind::upload, "letters on their way"));
    std::memcpy(staging.mapped, pixels, bytes);
    gpu.wait_idle();
    ORO_CHECK(commands_.run(gpu, [&](VkCommandBuffer commands) {
        const ImageUse fresh{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_COPY_BIT, 0};
        const ImageUse target{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                              VK_ACCESS_2_TRANSFER_WRITE_BIT};
        const ImageUse sampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                               VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
        image_barrier(commands, atlas.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, fresh, target);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {extent.width, extent.height, 1};
        vkCmdCopyBufferToImage(commands, staging.handle.get(), atlas.handle.get(), target.layout, 1, &copy);
        image_barrier(commands, atlas.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, target, sampled);
    }));
    atlas_ = std::move(atlas);
    const VkDescriptorImageInfo image{sampler_.get(), atlas_.view.get(),
                                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image;
    vkUpdateDescriptorSets(gpu.device(), 1, &write, 0, nullptr);
    return {};
}

Result<void> InterfaceRenderer::prepare(const Gpu& gpu, const ImDrawData& lists, std::size_t slot) {
    slot_ = slot;
    const auto corners = static_cast<std::size_t>(lists.TotalVtxCount);
    const auto numbers = static_cast<std::size_t>(lists.TotalIdxCount);
    if (corners == 0 || numbers == 0) return {};
    ORO_CHECK(grow(gpu, corners * sizeof(ImDrawVert), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "interface corners",
                   lists_[slot].corners));
    ORO_CHECK(grow(gpu, numbers * sizeof(ImDrawIdx), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "interface numbers",
                   lists_[slot].numbers));
    std::byte *corner = lists_[slot].corners.mapped, *number = lists_[slot].numbers.mapped;
    for (int i = 0; i < lists.CmdListsCount; ++i) {
        const ImDrawList& list = *lists.CmdLists[i];
        const std::size_t corner_bytes = static_cast<std::size_t>(list.VtxBuffer.Size) * sizeof(ImDrawVert);
        const std::size_t number_bytes = static_cast<std::size_t>(list.IdxBuffer.Size) * sizeof(ImDrawIdx);
        if (corner_bytes > 0) std::memcpy(corner, list.VtxBuffer.Data, corner_bytes);
        if (number_bytes > 0) std::memcpy(number, list.IdxBuffer.Data, number_bytes);
        corner += corner_bytes;
        number += number_bytes;
    }
    return {};
}

void InterfaceRenderer::record(VkCommandBuffer commands, const ImDrawData& lists, VkImageView target,
                               VkExtent2D extent) const {
    if (lists.TotalVtxCount == 0 || lists.TotalIdxCount == 0) return;
    VkRenderingAttachmentInfo attachment{};
    attachment.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    attachment.imageView = target;
    attachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent = extent;
    rendering.layerCount = rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &attachment;
    vkCmdBeginRendering(commands, &rendering);
    const VkViewport viewport{0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0F, 1.0F};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set_, 0,
                            nullptr);
    const VkBuffer corners = lists_[slot_].corners.handle.get();
    constexpr VkDeviceSize from_begin = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &corners, &from_begin);
    vkCmdBindIndexBuffer(commands, lists_[slot_].numbers.handle.get(), 0,
                         sizeof(ImDrawIdx) == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
    const Push push{{2.0F / viewport.width, 2.0F / viewport.height}, {-1.0F, -1.0F}};
    vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(push), &push);
    std::uint32_t first_number = 0;
    std::int32_t first_corner = 0;
    const auto cut = [](float value, std::uint32_t most) {
        return static_cast<std::int32_t>(std::clamp(value, 0.0F, static_cast<float>(most)));
    };
    for (int i = 0; i < lists.CmdListsCount; ++i) {
        const ImDrawList& list = *lists.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const std::int32_t left = cut(command.ClipRect.x, extent.width),
                               top = cut(command.ClipRect.y, extent.height),
                               right = cut(command.ClipRect.z, extent.width),
                               bottom = cut(command.ClipRect.w, extent.height);
            if (command.UserCallback != nullptr || right <= left || bottom <= top) continue;
            const VkRect2D scissor{
                {left, top},
                {static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top)}};
            vkCmdSetScissor(commands, 0, 1, &scissor);
            vkCmdDrawIndexed(commands, command.ElemCount, 1, first_number + command.IdxOffset,
                             first_corner + static_cast<std::int32_t>(command.VtxOffset), 0);
        }
        first_number += static_cast<std::uint32_t>(list.IdxBuffer.Size);
        first_corner += list.VtxBuffer.Size;
    }
    vkCmdEndRendering(commands);
}

}  // namespace oro
