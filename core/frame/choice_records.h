// What a device chooses the pages of one grid from: records of all its pages, whatever the eye, and what
// depends on that.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/result.h"
#include "core/frame/frame_plan.h"
#include "core/frame/model_view.h"
#include "core/frame/page_numbers.h"
#include "core/frame/region_pages.h"
#include "shaders/plan/shared_choice.h"

namespace oro {

// Whether a device can choose the pages of a region: it has no net and does not go round the Earth, its
// records come at once, and they take at most so many bytes.
bool can_choose_on_device(const RegionPages& pages, std::uint64_t most_bytes);

// Fills the records of all pages. records: as many as numbers has pages. Errors: as RegionPages::record().
Result<void> fill_choice_records(const RegionPages& pages, const PageNumbers& numbers,
                                 std::span<gpu::ChoicePage> records);

// What of a choice depends on the eye, by the same expressions as plan_grid(); the rest of the terms is 0.
// The view is on the ellipsoid, and light goes straight.
gpu::ChoiceTerms choice_terms(const RegionPages& pages, const PageNumbers& numbers, const FrameView& view,
                              const ModelView& model, double shading_spacing_px);

}  // namespace oro
