// The part of FrameRenderer that brings a frame's results back to the host.
#include <algorithm>
#include <cassert>
#include <cstring>

#include "core/growth/near_trees.h"
#include "render/frame/frame_layout.h"
#include "render/frame/frame_renderer.h"

namespace oro {
namespace {

template <class T>
std::vector<T> as_vector(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

}  // namespace

Result<std::vector<std::byte>> FrameRenderer::read_image(const Image& image, VkImageAspectFlags aspect,
                                                         ImageUse last_use, std::uint32_t width,
                                                         std::uint32_t height) {
    const VkDeviceSize size = VkDeviceSize{4} * width * height;  // every format read back has four bytes
    ORO_TRY(const Buffer buffer, create_buffer(*gpu_, size, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                               MemoryKind::readback, "image read back"));
    ORO_CHECK(commands().run(*gpu_, [&](VkCommandBuffer commands) {
        const ImageUse as_source{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                 VK_ACCESS_2_TRANSFER_READ_BIT};
        image_barrier(commands, image.handle.get(), aspect, last_use, as_source);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {aspect, 0, 0, 1};
        copy.imageExtent = {width, height, 1};
        vkCmdCopyImageToBuffer(commands, image.handle.get(), as_source.layout, buffer.handle.get(), 1, &copy);
        image_barrier(commands, image.handle.get(), aspect, as_source, last_use);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    }));
    return std::vector<std::byte>(buffer.mapped, buffer.mapped + size);
}

Result<std::vector<std::uint8_t>> FrameRenderer::read_picture(std::uint32_t width, std::uint32_t height) {
    ORO_TRY(const std::vector<std::byte> bytes,
            read_image(picture_, VK_IMAGE_ASPECT_COLOR_BIT, shader_write, width, height));
    return as_vector<std::uint8_t>(bytes);
}

Result<void> FrameRenderer::replace_picture(std::span<const std::uint8_t> rgba, std::uint32_t width,
                                            std::uint32_t height) {
    assert(rgba.size() == std::size_t{4} * width * height);
    ORO_TRY(const Buffer buffer, create_buffer(*gpu_, rgba.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                               MemoryKind::upload, "picture with writing"));
    std::memcpy(buffer.mapped, rgba.data(), rgba.size());
    return commands().run(*gpu_, [&](VkCommandBuffer commands) {
        const ImageUse as_target{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                 VK_ACCESS_2_TRANSFER_WRITE_BIT};
        image_barrier(commands, picture_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, shader_write, as_target);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {width, height, 1};
        vkCmdCopyBufferToImage(commands, buffer.handle.get(), picture_.handle.get(), as_target.layout, 1,
                               &copy);
        image_barrier(commands, picture_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, as_target, shader_write);
    });
}

// Words of a buffer on the device.
Result<std::vector<std::uint32_t>> FrameRenderer::read_words(const Buffer& source, VkDeviceSize first,
                                                             std::size_t count) {
    if (count == 0) return std::vector<std::uint32_t>{};
    const VkDeviceSize size = 4 * static_cast<VkDeviceSize>(count);
    ORO_TRY(const Buffer buffer,
            create_buffer(*gpu_, size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback, "read back"));
    ORO_CHECK(commands().run(*gpu_, [&](VkCommandBuffer commands) {
        memory_barrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        const VkBufferCopy copy{4 * first, 0, size};
        vkCmdCopyBuffer(commands, source.handle.get(), buffer.handle.get(), 1, &copy);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    }));
    std::vector<std::uint32_t> words(count);
    std::memcpy(words.data(), buffer.mapped, size);
    return words;
}

Result<std::vector<std::uint32_t>> FrameRenderer::read_ids(std::uint32_t width, std::uint32_t height) {
    if (!compute_) {
        ORO_TRY(const std::vector<std::byte> bytes,
                read_image(ids_, VK_IMAGE_ASPECT_COLOR_BIT, shader_read, width, height));
        return as_vector<std::uint32_t>(bytes);
    }
    assert(width == last_width_px_);
    ORO_TRY(std::vector<std::uint32_t> words,
            read_words(compute_->visibility(), 0, std::size_t{2} * width * height));
    for (std::size_t i = 0; i < words.size() / 2; ++i) words[i] = words[2 * i] == 0 ? 0 : ~words[2 * i];
    words.resize(words.size() / 2);
    return words;
}

Result<std::vector<float>> FrameRenderer::read_depths(std::uint32_t width, std::uint32_t height) {
    assert(options_.keep_depths && width == last_width_px_);
    ORO_TRY(const std::vector<std::uint32_t> bits, read_words(depths_, 0, std::size_t{width} * height));
    std::vector<float> depths(bits.size());
    std::memcpy(depths.data(), bits.data(), bits.size() * sizeof(float));
    return depths;
}

Result<std::vector<std::uint8_t>> FrameRenderer::read_near_trees(std::uint32_t width, std::uint32_t height) {
    std::vector<std::uint8_t> shown(std::size_t{width} * height, 0);
    const FramePlan& plan = *slots_[slot_].plan;
    const auto has_trees = [](const GridPlan& grid) { return !grid.growth.tiles.empty(); };
    if (std::ranges::none_of(plan.grids, has_trees)) return shown;
    ORO_TRY(const std::vector<std::uint32_t> ids, read_ids(width, height));
    for (const GridPlan& grid : plan.grids) {
        NearTrees near_trees(grid.growth, plan.view.camera.eye);
        for (std::size_t i = 0; i < ids.size(); ++i)
            if (near_trees.has(ids[i])) shown[i] = 1;
    }
    return shown;
}

// Some 60 MB at a time.
std::uint32_t FrameRenderer::triangle_rows() const {
    constexpr std::uint32_t pixels = 1U << 20U;
    return std::max(8U, pixels / options_.extent.width / 8U * 8U);
}

// What one of the frame's grids shows: the others' pixels are background to it.
Result<void> FrameRenderer::add_triangles(std::uint32_t grid, std::uint32_t first_row, std::uint32_t rows,
                                          std::vector<ShownTriangle>& shown) {
    ORO_CHECK(commands().run(*gpu_, [&](VkCommandBuffer commands) {
        memory_barrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
        grids_[grid].bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        vkCmdBindPipeline(
            commands, VK_PIPELINE_BIND_POINT_COMPUTE,
            (grids_[grid].cluster_groups() > 0 ? pipelines_->cluster_triangles : pipelines_->triangles)
                .get());
        vkCmdDispatchBase(commands, 0, first_row / 8, 0, (last_width_px_ + 7) / 8, (rows + 7) / 8, 1);
    }));
    constexpr std::size_t words_each = sizeof(gpu::DrawnTriangle) / sizeof(std::uint32_t);
    ORO_TRY(const std::vector<std::uint32_t> words, read_words(triangles_, 0, shown.size() * words_each));
    for (std::size_t i = 0; i < shown.size(); ++i) {
        gpu::DrawnTriangle triangle;
        std::memcpy(&triangle, words.data() + i * words_each, sizeof(triangle));
        if (triangle.rows[0] != gpu::no_triangle) shown[i] = {triangle, grid};
    }
    return {};
}

Result<std::vector<ShownTriangle>> FrameRenderer::read_triangles(std::uint32_t first_row,
                                                                 std::uint32_t rows) {
    assert(options_.keep_triangles && first_row % triangle_rows() == 0 && rows <= triangle_rows());
    ShownTriangle background{};
    std::ranges::fill(background.triangle.rows, gpu::no_triangle);
    std::ranges::fill(background.triangle.columns, gpu::no_triangle);
    std::vector<ShownTriangle> shown(std::size_t{rows} * last_width_px_, background);
    for (std::uint32_t grid = 0; grid < last_grids_.size(); ++grid)
        if (last_grids_[grid] != 0) ORO_CHECK(add_triangles(grid, first_row, rows, shown));
    return shown;
}

Result<std::vector<std::uint32_t>> FrameRenderer::read_accepted(std::size_t pages) {
    return read_words(grids_[0].choice(), live_pages_words + live_words * grids_[0].page_capacity(),
                      pages * gpu::accepted_words);
}

Result<std::vector<std::uint32_t>> FrameRenderer::read_edges(std::size_t pages) {
    return read_words(grids_[0].choice(),
                      live_pages_words + (live_words + gpu::accepted_words) * grids_[0].page_capacity(),
                      pages * gpu::edges_words);
}

Result<std::vector<std::uint32_t>> FrameRenderer::read_cluster_states(std::size_t clusters) {
    return read_words(grids_[0].cluster_states(), 0, clusters);
}

Result<FrameRenderer::PlannedWords> FrameRenderer::read_plan(std::size_t grid) {
    const GridFrame& drawn = grids_[grid];
    const auto part = [&](std::size_t number) {
        const GridFrame::DataPart& bytes = drawn.planned_parts()[number];
        return read_words(drawn.data(), bytes.first / sizeof(std::uint32_t),
                          bytes.size / sizeof(std::uint32_t));
    };
    PlannedWords words;
    ORO_TRY(words.pages, part(0));
    ORO_TRY(words.rows, part(1));
    ORO_TRY(words.columns, part(2));
    return words;
}

Result<std::vector<float>> FrameRenderer::read_air() {
    assert(air_.entries().handle);
    ORO_TRY(const std::vector<std::uint32_t> bits,
            read_words(air_.entries(), 0, std::size_t{4} * gpu::lit_end));
    std::vector<float> values(bits.size());
    std::memcpy(values.data(), bits.data(), bits.size() * sizeof(float));
    return values;
}

std::vector<gpu::vec3> FrameRenderer::recorded(std::size_t most) const {
    std::vector<gpu::vec3> positions(std::min<std::size_t>(most, recorded_.size / sizeof(gpu::vec3)));
    std::memcpy(positions.data(), recorded_.mapped, positions.size() * sizeof(gpu::vec3));
    return positions;
}

}  // namespace oro
