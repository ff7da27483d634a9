// One frame: pages to ids and depth, ids to colours. The same path for pictures, the window and benchmarks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/frame_plan.h"
#include "render/compute_raster.h"
#include "render/page_store.h"
#include "render/pipelines.h"
#include "render/resources.h"

namespace oro {

// What a frame did and how long the GPU took for it.
struct FrameReport {
    gpu::FrameCounts counts{};
    std::uint64_t pages_drawn{};
    double raster_s{};  // GPU timestamps: from pages to triangle ids, by either path
    double shade_s{};   // the shading pass
};

struct FrameRendererOptions {
    VkExtent2D extent{};           // largest tile, at most the device's limit
    bool several_samples{false};   // will be asked for sample_count > 1
    bool record_positions{false};  // mesh path only
    RasterPath path{RasterPath::mesh};
};

class FrameRenderer {
  public:
    static Result<FrameRenderer> create(const Gpu& gpu, const FrameRendererOptions& options);

    // Takes another size of picture (waits for nothing: draw() has waited).
    Result<void> resize(VkExtent2D extent);

    // Draws one sample of a plan (its tile is within the extent) and waits for it. With sample_count > 1 the
    // picture is complete after the last sample_index. Same plan, pages and style: same bytes, on one driver.
    Result<FrameReport> draw(const PageStore& pages, FramePlan plan, const gpu::FrameStyle& style,
                             std::uint32_t sample_index = 0, std::uint32_t sample_count = 1);

    // The picture's top left width x height pixels as RGBA rows, sRGB.
    Result<std::vector<std::uint8_t>> read_picture(std::uint32_t width, std::uint32_t height);
    // Triangle ids and reversed depths of the last frame (for tests and picking).
    Result<std::vector<std::uint32_t>> read_ids(std::uint32_t width, std::uint32_t height);
    Result<std::vector<float>> read_depths(std::uint32_t width, std::uint32_t height);
    // With record_positions: of every page of the last frame, 129 x 129 positions as the mesh shader placed
    // them.
    [[nodiscard]] std::vector<gpu::vec3> recorded() const;

    [[nodiscard]] const Image& picture() const { return picture_; }
    [[nodiscard]] VkExtent2D extent() const { return options_.extent; }

  private:
    explicit FrameRenderer(const Gpu& gpu) : gpu_(&gpu) {}
    Result<void> create_images();
    Result<void> create_set();
    Result<void> reserve_pages(std::size_t count);
    Result<void> upload(FramePlan& plan, const PageStore& pages, const gpu::FrameStyle& style,
                        std::uint32_t sample_index, std::uint32_t sample_count);
    void record(VkCommandBuffer commands, const FramePlan& plan) const;
    [[nodiscard]] PushBlock push_block() const;
    Result<std::vector<std::uint32_t>> read_visibility_words(std::uint32_t width, std::uint32_t height,
                                                             std::size_t word);
    void record_upload(VkCommandBuffer commands, const FramePlan& plan) const;
    void record_raster(VkCommandBuffer commands, const FramePlan& plan) const;
    void record_shade(VkCommandBuffer commands, const FramePlan& plan) const;
    Result<std::vector<std::byte>> read_image(const Image& image, VkImageAspectFlags aspect,
                                              ImageUse last_use, std::uint32_t width, std::uint32_t height);

    const Gpu* gpu_;
    FrameRendererOptions options_;
    Pipelines pipelines_;
    std::optional<ComputeRaster> compute_;
    Commands commands_;
    Image ids_, depth_, sum_, picture_;
    OwnedDescriptorPool pool_;
    VkDescriptorSet set_{VK_NULL_HANDLE};
    OwnedQueryPool timestamps_;
    Buffer staging_;      // constants, then pages
    Buffer frame_data_;   // the same on the device
    Buffer counts_;       // on the device
    Buffer counts_read_;  // for the host
    Buffer recorded_;
    std::size_t page_capacity_{};
};

}  // namespace oro
