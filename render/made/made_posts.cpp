#include "render/made/made_posts.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "core/made/made_heights.h"
#include "render/device/timestamps.h"
#include "render/pipelines/pipeline_parts.h"
#include "spirv/post_heights_comp.h"

namespace oro {
namespace {

// As post_heights.comp takes it.
struct PostWork {
    VkDeviceAddress rule, rows, columns, heights;
    std::uint32_t row_count, column_count, first_post, pole_rows;
};
constexpr std::uint32_t posts_a_group = 64;
constexpr std::uint32_t posts_a_dispatch = 65535 * posts_a_group;  // every device starts so many workgroups
constexpr VkBufferUsageFlags read_by_shaders =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

template <class T>
Result<Buffer> filled(const Gpu& gpu, std::span<const T> values, const char* name) {
    ORO_TRY(Buffer buffer,
            create_buffer(gpu, values.size_bytes(), read_by_shaders, MemoryKind::upload, name));
    std::memcpy(buffer.mapped, values.data(), values.size_bytes());
    return buffer;
}

}  // namespace

Result<MadePosts> MadePosts::create(const Gpu& gpu, const MadeTerrain& terrain) {
    MadePosts posts(gpu, terrain);
    ORO_CHECK(posts.create_program());
    ORO_CHECK(posts.send_places());
    ORO_TRY(posts.commands_, Commands::create(gpu, "made posts"));
    return posts;
}

Result<void> MadePosts::create_program() {
    ORO_TRY(layout_,
            create_push_layout(*gpu_, VK_SHADER_STAGE_COMPUTE_BIT, sizeof(PostWork), "post heights"));
    ORO_TRY(program_, create_plain_compute(*gpu_, layout_.get(), post_heights_comp_spirv, "post heights"));
    ORO_TRY(timestamps_, create_timestamps(*gpu_, 2, "timestamps of made posts"));
    return {};
}

Result<void> MadePosts::send_places() {
    std::vector<MadeRow> rows;
    for (int row = 0; row < terrain_.rows(); ++row)
        rows.push_back(made_row(terrain_.north - row, terrain_.posts_per_deg));
    const std::vector<MadeColumn> columns = made_columns(terrain_, 0, terrain_.columns());
    const std::array rule{made_rule(terrain_)};
    ORO_TRY(rule_, filled(*gpu_, std::span<const gpu::MadeRule>(rule), "rule of made terrain"));
    ORO_TRY(rows_, filled(*gpu_, std::span<const MadeRow>(rows), "rows of made terrain"));
    ORO_TRY(columns_, filled(*gpu_, std::span<const MadeColumn>(columns), "columns of made terrain"));
    return {};
}

void MadePosts::record_rectangle(VkCommandBuffer commands, const MadeRectangle& rectangle,
                                 VkDeviceAddress heights) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, program_.get());
    const std::int64_t pole = 90 * terrain_.posts_per_deg;
    const int rows_at_once = std::max(1, static_cast<int>(posts_a_dispatch) / rectangle.columns);
    for (int first = 0; first < rectangle.rows; first += rows_at_once) {
        const int rows = std::min(rows_at_once, rectangle.rows - first);
        const std::int64_t north = terrain_.north - rectangle.first_row - first, south = north - rows + 1;
        const PostWork work{
            rule_.address,
            rows_.address + static_cast<std::size_t>(rectangle.first_row + first) * sizeof(MadeRow),
            columns_.address + static_cast<std::size_t>(rectangle.first_column) * sizeof(MadeColumn),
            heights + static_cast<std::size_t>(first) * static_cast<std::size_t>(rectangle.columns) *
                          sizeof(std::int32_t),
            static_cast<std::uint32_t>(rows),
            static_cast<std::uint32_t>(rectangle.columns),
            static_cast<std::uint32_t>(north + terrain_.west + rectangle.first_column),
            (north == pole ? 1U : 0U) | (south == -pole ? 2U : 0U)};
        vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof work, &work);
        const auto posts = static_cast<std::uint32_t>(rows) * static_cast<std::uint32_t>(rectangle.columns);
        vkCmdDispatch(commands, (posts + posts_a_group - 1) / posts_a_group, 1, 1);
    }
}

void MadePosts::record(VkCommandBuffer commands, std::span<const MadeRectangle> rectangles) const {
    vkCmdResetQueryPool(commands, timestamps_.get(), 0, 2);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_.get(), 0);
    VkDeviceAddress heights = made_.address;
    for (const MadeRectangle& one : rectangles) {
        record_rectangle(commands, one, heights);
        heights += one.count() * sizeof(std::int32_t);
    }
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_.get(), 1);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
    const VkBufferCopy copy{0, 0, heights - made_.address};
    vkCmdCopyBuffer(commands, made_.handle.get(), read_.handle.get(), 1, &copy);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

Result<double> MadePosts::make(std::span<const MadeRectangle> rectangles, std::span<std::int32_t> steps) {
    if (made_.size < steps.size_bytes()) {
        ORO_TRY(made_,
                create_buffer(*gpu_, steps.size_bytes(), read_by_shaders | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                              MemoryKind::device, "made heights"));
        ORO_TRY(read_, create_buffer(*gpu_, steps.size_bytes(), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                     MemoryKind::readback, "made heights to read"));
    }
    ORO_CHECK(commands_.run(*gpu_, [&](VkCommandBuffer commands) { record(commands, rectangles); }));
    std::array<std::uint64_t, 2> ticks{};
    ORO_VK(vkGetQueryPoolResults(gpu_->device(), timestamps_.get(), 0, 2, sizeof ticks, ticks.data(),
                                 sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT));
    std::memcpy(steps.data(), read_.mapped, steps.size_bytes());
    return gpu_->seconds_between(ticks[0], ticks[1]);
}

}  // namespace oro
