// Where a frame's parts lie on the device, and how its images are used: known to what draws a frame and to
// what reads it back.
#pragma once

#include "render/device/resources.h"
#include "shaders/shared.h"

namespace oro {

// The choice of levels, in words: first LivePages, of the frame and of a round, then for so many pages
// `live`, `accepted` and `edges`, and what rounds hand on: `round_live`, `kept`, `drawn` and `drawn_now`.
inline constexpr VkDeviceSize live_pages_words = 16;
inline constexpr VkDeviceSize round_pages_at = 8;
static_assert(sizeof(gpu::LivePages) <= 4 * round_pages_at);
inline constexpr VkDeviceSize live_words = 2;
inline constexpr VkDeviceSize choice_words =
    live_words + gpu::accepted_words + gpu::edges_words + live_words + 3 * gpu::accepted_words;  // a page

inline constexpr ImageUse unused{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
inline constexpr ImageUse as_colour{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
inline constexpr ImageUse as_depth{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
// By the pyramid of the farthest depths, between two rounds.
inline constexpr ImageUse depth_read{VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL,
                                     VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                     VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
inline constexpr ImageUse shader_read{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                      VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
inline constexpr ImageUse shader_write{
    VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};

}  // namespace oro
