// What a device's choice of pages tells the processor: which pages the frame has, and which it lacks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/frame/choice_records.h"

namespace oro {

// The parts of a GridPlan (core/frame/frame_plan.h) that a choice of pages makes, by the same names and in
// the same order.
struct ChosenPages {
    std::vector<PageIndex> page_indices;
    std::vector<PageIndex> missing;
    std::size_t missing_hidden{};
    std::vector<PageIndex> hidden;
    std::size_t pages_wanted{};
    std::size_t pages_beyond_frustum{};
    std::size_t pages_beyond_horizon{};
    bool is_whole{true};  // false: more pages were wanted than there was room for
};

// wanted: counts.wanted of them, or as many as there was room for. is_hidden: as plan_grid() asks it.
ChosenPages chosen_pages(const PageNumbers& numbers, const gpu::ChoiceCounts& counts,
                         std::span<const gpu::WantedPage> wanted, const IsHidden& is_hidden = {});

}  // namespace oro
