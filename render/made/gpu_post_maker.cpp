#include "render/made/gpu_post_maker.h"

#include <cstring>
#include <thread>

#include "render/device/resources.h"
#include "render/pipelines/pipeline_parts.h"
#include "spirv/block_heights_comp.h"

namespace oro {
namespace {

// As block_heights.comp takes it.
struct BlockWork {
    VkDeviceAddress rule, rows, columns, all, coarse;
    std::uint32_t column_count, coarse_octaves;
};
constexpr std::uint32_t columns_a_group = 64;
constexpr std::size_t most_rows = 65535;              // every device starts so many workgroups,
constexpr std::size_t most_posts = 32 * 1024 * 1024;  // ... and these are some 130 MB

class GpuPostMaker : public MadePostMaker {
  public:
    explicit GpuPostMaker(const Gpu& gpu) : gpu_(&gpu) {}

    std::optional<MadeSteps> make(const gpu::MadeRule& rule, std::span<const MadeRow> rows,
                                  std::span<const MadeColumn> columns,
                                  std::uint32_t coarse_octaves) override {
        const std::size_t posts = rows.size() * columns.size();
        if (has_failed_ || rule.kind != gpu::made_fbm || std::this_thread::get_id() != thread_ ||
            rows.size() > most_rows || posts > most_posts)
            return std::nullopt;
        const std::size_t values = coarse_octaves != no_coarse_octaves ? 2 * posts : posts;
        const bool made = prepare(rule, rows, columns, values).ok() &&
                          run(rows.size(), columns.size(), coarse_octaves, values).ok();
        has_failed_ = !made;
        if (!made) return std::nullopt;
        const std::span all(reinterpret_cast<const std::int32_t*>(read_.mapped), values);
        return MadeSteps{all.first(posts), all.subspan(posts)};
    }

  private:
    Result<void> prepare(const gpu::MadeRule& rule, std::span<const MadeRow> rows,
                         std::span<const MadeColumn> columns, std::size_t values);
    Result<void> run(std::size_t rows, std::size_t columns, std::uint32_t coarse_octaves, std::size_t values);
    Result<void> grow(Buffer& buffer, std::size_t bytes, VkBufferUsageFlags usage, MemoryKind kind);

    const Gpu* gpu_;
    std::thread::id thread_{std::this_thread::get_id()};
    bool has_failed_{false};
    OwnedPipelineLayout layout_;
    OwnedPipeline program_;
    Buffer places_;       // the rule, rows, columns
    Buffer made_, read_;  // on the device, and for the host
    std::size_t rows_at_{sizeof(gpu::MadeRule)}, columns_at_{};
    Commands commands_;
};

Result<void> GpuPostMaker::grow(Buffer& buffer, std::size_t bytes, VkBufferUsageFlags usage,
                                MemoryKind kind) {
    if (buffer.size >= bytes) return {};
    return replace_buffer(*gpu_, buffer, bytes + bytes / 2, usage, kind, "posts of blocks");
}

Result<void> GpuPostMaker::prepare(const gpu::MadeRule& rule, std::span<const MadeRow> rows,
                                   std::span<const MadeColumn> columns, std::size_t values) {
    constexpr VkBufferUsageFlags by_shaders =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    if (!program_) {
        ORO_TRY(layout_,
                create_push_layout(*gpu_, VK_SHADER_STAGE_COMPUTE_BIT, sizeof(BlockWork), "posts of blocks"));
        ORO_TRY(program_,
                create_plain_compute(*gpu_, layout_.get(), block_heights_comp_spirv, "posts of blocks"));
        ORO_TRY(commands_, Commands::create(*gpu_, "posts of blocks"));
    }
    columns_at_ = rows_at_ + rows.size_bytes();
    ORO_CHECK(grow(places_, columns_at_ + columns.size_bytes(), by_shaders, MemoryKind::upload));
    ORO_CHECK(grow(made_, values * sizeof(std::int32_t), by_shaders | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                   MemoryKind::device));
    ORO_CHECK(
        grow(read_, values * sizeof(std::int32_t), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback));
    std::memcpy(places_.mapped, &rule, sizeof rule);
    std::memcpy(places_.mapped + rows_at_, rows.data(), rows.size_bytes());
    std::memcpy(places_.mapped + columns_at_, columns.data(), columns.size_bytes());
    return {};
}

Result<void> GpuPostMaker::run(std::size_t rows, std::size_t columns, std::uint32_t coarse_octaves,
                               std::size_t values) {
    const BlockWork work{places_.address,
                         places_.address + rows_at_,
                         places_.address + columns_at_,
                         made_.address,
                         made_.address + rows * columns * sizeof(std::int32_t),
                         static_cast<std::uint32_t>(columns),
                         coarse_octaves};
    return commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        wait_for_earlier(commands);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, program_.get());
        vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof work, &work);
        const auto across = static_cast<std::uint32_t>(columns) + columns_a_group - 1;
        vkCmdDispatch(commands, across / columns_a_group, static_cast<std::uint32_t>(rows), 1);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        const VkBufferCopy copy{0, 0, values * sizeof(std::int32_t)};
        vkCmdCopyBuffer(commands, made_.handle.get(), read_.handle.get(), 1, &copy);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
}

}  // namespace

std::shared_ptr<MadePostMaker> gpu_post_maker(const Gpu& gpu) {
    return std::make_shared<GpuPostMaker>(gpu);
}

}  // namespace oro
