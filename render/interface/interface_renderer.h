// Draws the lists that Dear ImGui makes of panels and text over an image.
#pragma once

#include <imgui.h>

#include <array>
#include <cstddef>

#include "render/device/resources.h"

namespace oro {

// One pipeline over dynamic rendering. Colours are taken as they are: the image holds sRGB codes.
class InterfaceRenderer {
  public:
    InterfaceRenderer() = default;
    // format: of the images that will be drawn over. Errors: the device.
    static Result<InterfaceRenderer> create(const Gpu& gpu, VkFormat format);

    // Takes the letters of an atlas, which are built here where they are not; from then on lists are drawn
    // with them. Waits for the device. Errors: the device.
    Result<void> take_fonts(const Gpu& gpu, ImFontAtlas& fonts);
    // Copies corners to where the device reads them. slot: the frame's, of frames_in_flight; the one that had
    // it before is done. Errors: the device has no memory for them.
    Result<void> prepare(const Gpu& gpu, const ImDrawData& lists, std::size_t slot);
    // Draws the lists that were prepared last over an image, which is in COLOR_ATTACHMENT_OPTIMAL and as
    // large as the lists' display.
    void record(VkCommandBuffer commands, const ImDrawData& lists, VkImageView target,
                VkExtent2D extent) const;

  private:
    Result<void> create_sets(const Gpu& gpu);
    Result<void> create_pipeline(const Gpu& gpu, VkFormat format);

    DeviceOwned<VkSampler, vkDestroySampler> sampler_;
    OwnedSetLayout set_layout_;
    OwnedDescriptorPool pool_;
    VkDescriptorSet set_{VK_NULL_HANDLE};
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
    Image atlas_;
    Commands commands_;
    struct Lists {
        Buffer corners, numbers;  // grown as they need it
    };
    std::array<Lists, frames_in_flight> lists_;
    std::size_t slot_{};  // that was prepared last
};

}  // namespace oro
