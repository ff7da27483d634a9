#include "render/pipelines/choice_pass.h"

#include <algorithm>
#include <span>

#include "render/pipelines/pipeline_parts.h"
#include "spirv/list_pages_comp.h"
#include "spirv/number_pages_comp.h"
#include "spirv/open_pages_comp.h"
#include "spirv/rate_pages_comp.h"
#include "spirv/want_pages_comp.h"

namespace oro {

Result<ChoicePass> ChoicePass::create(const Gpu& gpu) {
    ChoicePass pass;
    ORO_TRY(pass.layout_,
            create_push_layout(gpu, VK_SHADER_STAGE_COMPUTE_BIT, sizeof(gpu::uvec2), "choice of pages"));
    const std::array<std::span<const std::uint32_t>, step_count> words{
        rate_pages_comp_spirv, want_pages_comp_spirv, open_pages_comp_spirv, number_pages_comp_spirv,
        list_pages_comp_spirv};
    constexpr std::array names{"pages rated", "pages wanted", "pages opened", "pages numbered",
                               "pages listed"};
    for (std::size_t i = 0; i < step_count; ++i) {
        ORO_TRY(pass.steps_[i], create_plain_compute(gpu, pass.layout_.get(), words[i], names[i]));
    }
    return pass;
}

void ChoicePass::record(VkCommandBuffer commands, const gpu::ChoiceTerms& terms,
                        VkDeviceAddress terms_address) const {
    const auto groups = [](gpu::uint jobs) {
        return std::max(1U, (jobs + gpu::choice_group - 1) / gpu::choice_group);
    };
    const gpu::uint all = groups(
        std::max({terms.page_count, terms.change_count, terms.row_source_count + terms.column_source_count}));
    const gpu::uint wanted = groups(terms.capacity);
    const std::array<gpu::uint, step_count> counts{all, groups(terms.page_count), 1, wanted, wanted};
    const gpu::uvec2 words = address_words(terms_address);
    vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(words), &words);
    for (std::size_t i = 0; i < step_count; ++i) {
        if (i > 0)
            memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                           VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                           VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, steps_[i].get());
        vkCmdDispatch(commands, counts[i], 1, 1);
    }
}

void ChoicePass::record_end(VkCommandBuffer commands) {
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                       VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT |
                       VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
}

}  // namespace oro
