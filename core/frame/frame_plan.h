// What a frame draws: the pages that can be seen from an eye at the detail that tau asks for, with all that
// places them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/frame/casters.h"
#include "core/frame/cluster_plan.h"
#include "core/frame/height_quantization.h"
#include "core/frame/region_pages.h"
#include "shaders/shared.h"

namespace oro {

// One frame of one tile, ready for the GPU but for the addresses of its buffers and the style.
struct FramePlan {
    gpu::FrameConstants constants{};
    std::vector<gpu::FramePage> pages;  // nearest first; parents of drawn pages, too
    std::vector<PageIndex> page_indices;
    std::vector<gpu::RowTerms> row_terms;        // 129 for each row of pages of a level
    std::vector<gpu::ColumnTerms> column_terms;  // 129 for each column of pages of a level
    // Pages that the frame should have and has not, most wanted first. Where there are any, coarser ones
    // stand in; the picture still has no cracks. The last `missing_hidden` of them would not show.
    std::vector<PageIndex> missing;
    std::size_t missing_hidden{};
    std::vector<PageIndex> hidden;  // pages that are there, and do not show either, or wait for missing ones
    std::size_t
        pages_wanted{};  // those of `pages` and `missing`, and those that wait for a missing neighbour
    std::size_t pages_beyond_frustum{};
    std::size_t pages_beyond_horizon{};
    ClusterPlan clusters;  // off until draw_clusters()
    CasterPlan casters;    // none until plan_casters()
    bool wants_sights{};   // the frame tells which of its nodes or clusters show (core/frame/seen_ground.h)
    // Of whose heights the pages' blocks are: one number, one set of heights. 0: nobody says so.
    std::uint64_t heights{};
    // Other grids in the same frame: plans of their own, for the same eye and tile.
    std::vector<FramePlan> beside;
    // Whether nothing is missing, of any grid.
    [[nodiscard]] bool is_settled() const {
        return missing.empty() && clusters.missing == 0 &&
               std::ranges::all_of(beside, [](const FramePlan& other) { return other.missing.empty(); });
    }
    // Whether nothing is missing that might show, of any grid.
    [[nodiscard]] bool shows_all() const {
        return missing.size() == missing_hidden && clusters.missing == 0 &&
               std::ranges::all_of(beside, [](const FramePlan& other) {
                   return other.missing.size() == other.missing_hidden;
               });
    }
    // Whether any page of any grid may be in view.
    [[nodiscard]] bool wants_pages() const {
        return pages_wanted > 0 ||
               std::ranges::any_of(beside, [](const FramePlan& other) { return other.pages_wanted > 0; });
    }
};

// Device address of a page's block, 0 where it is not on the GPU.
using Residency = std::function<std::uint64_t(const PageIndex& page)>;

// Whether other ground is known to hide all of a page (core/frame/seen_ground.h).
using IsHidden = std::function<bool(const PageIndex& page)>;

// Chooses the pages of a frame, from the top down: of those that can be seen (conservative: none that can is
// left out) each whose parent is not good enough for tau_px pixels everywhere, or has its posts too far apart
// to shade slopes from (more than shading_spacing_px). Between neighbours that are there the levels differ by
// at most one, whatever is missing. model: what of the world is drawn; on another Earth than WGS84 tau_px is
// kept as well as that Earth agrees with it. coding: of the heights on the GPU. is_hidden: asked of each of
// them; it changes nothing but the order of those that are missing. Errors: a page's record that cannot be
// read; more pages than triangle ids can number.
Result<FramePlan> plan_frame(const RegionPages& pages, const Residency& residency, const Camera& camera,
                             const Tile& tile, double tau_px, const WorldModel& model = {},
                             const HeightQuantization& coding = {},
                             double shading_spacing_px = gpu::shading_spacing_px,
                             const IsHidden& is_hidden = {});

}  // namespace oro
