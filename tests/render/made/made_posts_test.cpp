// Must hold: heights of made terrain are the same on the GPU as on the CPU, to the bit.
#include <cstring>
#include <vector>

#include "render/device/resources.h"
#include "render/pipelines/pipeline_parts.h"
#include "spirv/post_heights_comp.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/made_posts.h"

namespace oro {
namespace {

// As post_heights.comp takes it.
struct PostWork {
    VkDeviceAddress rule, rows, columns, heights;
    std::uint32_t row_count, column_count, first_post, pole_rows;
};

class MadePosts : public test::GpuTest {
  protected:
    template <class T>
    Buffer filled(const std::vector<T>& values) const {
        auto buffer =
            create_buffer(*gpu_, values.size() * sizeof(T),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::upload, "made");
        EXPECT_TRUE(buffer.ok()) << buffer.error().line();
        std::memcpy(buffer->mapped, values.data(), values.size() * sizeof(T));
        return std::move(buffer).value();
    }

    std::vector<std::int32_t> on_gpu(const MadeTerrain& made) const {
        std::vector<MadeRow> row_places;
        for (int row = 0; row < made.rows(); ++row)
            row_places.push_back(made_row(made.north - row, made.posts_per_deg));
        const Buffer rule = filled(std::vector<gpu::MadeRule>{made_rule(made)}), rows = filled(row_places),
                     columns = filled(made_columns(made, 0, made.columns()));
        const std::size_t posts =
            static_cast<std::size_t>(made.rows()) * static_cast<std::size_t>(made.columns());
        auto heights = create_buffer(
            *gpu_, posts * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
            MemoryKind::readback, "made heights");
        EXPECT_TRUE(heights.ok()) << heights.error().line();
        const std::int64_t pole = 90 * made.posts_per_deg;
        const PostWork work{rule.address,
                            rows.address,
                            columns.address,
                            heights->address,
                            static_cast<std::uint32_t>(made.rows()),
                            static_cast<std::uint32_t>(made.columns()),
                            static_cast<std::uint32_t>(made.north + made.west),
                            (made.north == pole ? 1U : 0U) | (made.south == -pole ? 2U : 0U)};
        run(work, static_cast<std::uint32_t>((posts + 63) / 64));
        std::vector<std::int32_t> steps(posts);
        std::memcpy(steps.data(), heights->mapped, posts * 4);
        return steps;
    }

    void run(const PostWork& work, std::uint32_t groups) const {
        const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(PostWork)};
        VkPipelineLayoutCreateInfo layout_info{};
        layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
        layout_info.pushConstantRangeCount = 1;
        layout_info.pPushConstantRanges = &range;
        VkPipelineLayout layout{};
        ASSERT_EQ(vkCreatePipelineLayout(gpu_->device(), &layout_info, nullptr, &layout), VK_SUCCESS);
        {
            const auto shader = create_shader(*gpu_, post_heights_comp_spirv, "post heights");
            ASSERT_TRUE(shader.ok()) << shader.error().line();
            VkComputePipelineCreateInfo info{};
            info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
            info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, *shader, nullptr);
            info.layout = layout;
            VkPipeline handle{};
            ASSERT_EQ(vkCreateComputePipelines(gpu_->device(), VK_NULL_HANDLE, 1, &info, nullptr, &handle),
                      VK_SUCCESS);
            const OwnedPipeline pipeline(gpu_->device(), handle);
            auto commands = Commands::create(*gpu_, "post heights");
            ASSERT_TRUE(commands.ok()) << commands.error().line();
            const auto done = commands->run(*gpu_, [&](VkCommandBuffer buffer) {
                vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_COMPUTE, handle);
                vkCmdPushConstants(buffer, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof work, &work);
                vkCmdDispatch(buffer, groups, 1, 1);
                memory_barrier(buffer, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                               VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
                               VK_ACCESS_2_HOST_READ_BIT);
            });
            EXPECT_TRUE(done.ok()) << done.error().line();
        }
        vkDestroyPipelineLayout(gpu_->device(), layout, nullptr);
    }
};

TEST_F(MadePosts, AMillionOfEachKindAreThoseOfTheCpu) {
    for (int kind = 0; kind < 8; ++kind) {
        const MadeTerrain made = test::made_example(static_cast<MadeKind>(kind));
        EXPECT_EQ(on_gpu(made), test::heights_of(made)) << "kind " << kind;
    }
}

// Round the whole Earth, both poles and 180 degrees.
TEST_F(MadePosts, OfAWholeWorldAreThoseOfTheCpu) {
    for (int kind = 0; kind < 8; ++kind) {
        MadeTerrain made = test::made_example(static_cast<MadeKind>(kind));
        made.posts_per_deg = 2;
        made.west = -360;
        made.east = 360;
        made.south = -180;
        made.north = 180;
        made.cell_shift = 28;
        made.octaves = 20;
        made.radius_m = 1000000;
        EXPECT_EQ(on_gpu(made), test::heights_of(made)) << "kind " << kind;
    }
}

}  // namespace
}  // namespace oro
