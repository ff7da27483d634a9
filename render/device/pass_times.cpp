#include "render/device/pass_times.h"
#include "render/device/timestamps.h"

#include <algorithm>
#include <cstdint>

namespace oro {

Result<PassTimes> PassTimes::create(const Gpu& gpu) {
    PassTimes times;
    ORO_TRY(times.timestamps_, create_timestamps(gpu, most_passes + 1, "pass times"));
    return times;
}

void PassTimes::begin(VkCommandBuffer commands) {
    names_.clear();
    vkCmdResetQueryPool(commands, timestamps_.get(), 0, most_passes + 1);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_.get(), 0);
}

void PassTimes::end_pass(VkCommandBuffer commands, const char* name) {
    if (names_.size() == most_passes) return;
    names_.push_back(name);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_.get(),
                         static_cast<std::uint32_t>(names_.size()));
}

Result<std::vector<PassTime>> PassTimes::read(const Gpu& gpu) const {
    std::vector<PassTime> passes;
    if (names_.empty()) return passes;
    std::vector<std::uint64_t> ticks(names_.size() + 1);
    ORO_VK(vkGetQueryPoolResults(gpu.device(), timestamps_.get(), 0, static_cast<std::uint32_t>(ticks.size()),
                                 ticks.size() * sizeof(std::uint64_t), ticks.data(), sizeof(std::uint64_t),
                                 VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
    for (std::size_t i = 0; i < names_.size(); ++i) {
        const double s = gpu.seconds_between(ticks[i], ticks[i + 1]);
        const auto known = std::ranges::find(passes, names_[i], &PassTime::pass);
        if (known == passes.end())
            passes.push_back({names_[i], s});
        else
            known->s += s;
    }
    return passes;
}

}  // namespace oro
