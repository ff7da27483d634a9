// What of a graphics pipeline that draws ids and depth is no shader.
#pragma once

#include <array>
#include <cstdint>

#include "render/device/vulkan.h"
#include "render/pipelines/pipelines.h"

namespace oro {

// Ids and reversed depth, nothing blended, nothing culled. Its parts point at each other, so it stays where
// it is, and outlives the call that makes a pipeline of it.
class IdRasterState {
  public:
    // ties: only what is as near as what is there.
    explicit IdRasterState(bool ties) {
        viewport_.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
        viewport_.viewportCount = viewport_.scissorCount = 1;
        raster_.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
        raster_.cullMode = VK_CULL_MODE_NONE;  // seen from below, the ground still hides what is behind it
        raster_.lineWidth = 1.0F;
        samples_.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
        samples_.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        depth_.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
        depth_.depthTestEnable = VK_TRUE;
        depth_.depthWriteEnable = ties ? VK_FALSE : VK_TRUE;
        depth_.depthCompareOp = ties ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_GREATER;
        attachment_.colorWriteMask = VK_COLOR_COMPONENT_R_BIT;
        blend_.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
        blend_.attachmentCount = 1;
        blend_.pAttachments = &attachment_;
        dynamics_.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
        dynamics_.dynamicStateCount = static_cast<std::uint32_t>(dynamic.size());
        dynamics_.pDynamicStates = dynamic.data();
        rendering_.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
        rendering_.colorAttachmentCount = 1;
        rendering_.pColorAttachmentFormats = &id_format;
        rendering_.depthAttachmentFormat = depth_format;
    }
    IdRasterState(const IdRasterState&) = delete;
    IdRasterState& operator=(const IdRasterState&) = delete;

    // Puts pointers into this: to all parts but shader stages, the layout and what feeds vertices.
    void put_into(VkGraphicsPipelineCreateInfo& info) const {
        info.pNext = &rendering_;
        info.pViewportState = &viewport_;
        info.pRasterizationState = &raster_;
        info.pMultisampleState = &samples_;
        info.pDepthStencilState = &depth_;
        info.pColorBlendState = &blend_;
        info.pDynamicState = &dynamics_;
    }

  private:
    static constexpr std::array dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineViewportStateCreateInfo viewport_{};
    VkPipelineRasterizationStateCreateInfo raster_{};
    VkPipelineMultisampleStateCreateInfo samples_{};
    VkPipelineDepthStencilStateCreateInfo depth_{};
    VkPipelineColorBlendAttachmentState attachment_{};
    VkPipelineColorBlendStateCreateInfo blend_{};
    VkPipelineDynamicStateCreateInfo dynamics_{};
    VkPipelineRenderingCreateInfo rendering_{};
};

}  // namespace oro
