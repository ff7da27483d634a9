// What a frame draws: the pages that can be seen from an eye at the detail that tau asks for, with all that
// places them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/frame/casters.h"
#include "core/frame/height_quantization.h"
#include "core/frame/page_numbers.h"
#include "core/frame/region_pages.h"
#include "core/growth/growth_plan.h"
#include "core/growth/meadow_plan.h"
#include "shaders/plan/shared_choice.h"
#include "shaders/plan/shared_plan.h"
#include "shaders/shared.h"

namespace oro {

struct ClusterPlan {
    bool on{};  // clusters are drawn, and no nodes of pages: these are for shading alone
    std::vector<gpu::DrawnCluster> drawn;  // the processor's cut, then what is coarser and there
    std::size_t in_cut{};                  // of these: those of the cut
    std::vector<gpu::ClusterBox> boxes;    // of each
    std::vector<gpu::AskedGroup> asked;    // DrawnCluster::made_by
    // Groups and clusters that the cut lacks; where there are any, coarser clusters stand in for them, and
    // the picture still has no cracks.
    std::size_t missing{};
    std::size_t without_room{};  // of those: clusters that the GPU may not hold beside the others
    std::size_t groups_opened{};
    std::size_t beyond_frustum{};
    std::size_t beyond_horizon{};
};

// Where a frame is seen from and how finely: the same for all that it draws.
struct FrameView {
    Camera camera;
    Tile tile;           // of the camera's picture
    double tau_px{1.0};  // 0: full resolution
    WorldModel model{};  // what of the world is drawn
    // Of the tile.
    [[nodiscard]] std::uint32_t width_px() const { return static_cast<std::uint32_t>(tile.width_px); }
    [[nodiscard]] std::uint32_t height_px() const { return static_cast<std::uint32_t>(tile.height_px); }
};

// What the device makes of a plan by itself before it draws it (shaders/plan), to the bit as a plan has it:
// where that is on, the plan has no tables, and its pages lack their matrices, planes and directions; their
// gpu::cull_by_frustum says that they may have it. All but addresses of the frame's own buffers.
struct DevicePlan {
    bool on{};
    gpu::PlanTerms terms{};
    // Of its rows and columns of pages and of its pages, one kind after the other
    // (core/frame/plan_sources.h).
    std::vector<gpu::uint> numbers;
    // The device chooses the pages, too: the plan has none, and what it says of pages that are missing or
    // hidden is what the last frame that told of it was chosen of (FrameFeedback::choice). choice lacks
    // addresses of the frame's own buffers.
    bool chooses{};
    gpu::ChoiceTerms choice{};
    std::vector<gpu::BlockChange> changes;  // pages that came and went, up to that change
    std::uint64_t change_number{};
    std::size_t pages_read{};  // of how many wanted pages the frame tells at most
    std::shared_ptr<const PageNumbers> page_numbers;
};

// What a frame draws of one grid, ready for the GPU but for the addresses of its buffers and the style.
struct GridPlan {
    gpu::FrameConstants constants{};
    std::vector<gpu::FramePage> pages;  // nearest first; parents of drawn pages, too
    std::vector<PageIndex> page_indices;
    std::vector<gpu::RowTerms> row_terms;        // 129 for each row of pages of a level
    std::vector<gpu::ColumnTerms> column_terms;  // 129 for each column of pages of a level
    DevicePlan device;                           // in place of these, where the plan's memory has sources
    // Pages that the frame should have and has not, most wanted first. Where there are any, coarser ones
    // stand in; the picture still has no cracks. The last `missing_hidden` of them would not show.
    std::vector<PageIndex> missing;
    std::size_t missing_hidden{};
    std::vector<PageIndex> hidden;  // pages that are there, and do not show either, or wait for missing ones
    std::size_t
        pages_wanted{};  // those of `pages` and `missing`, and those that wait for a missing neighbour
    std::size_t pages_beyond_frustum{};
    std::size_t pages_beyond_horizon{};
    ClusterPlan clusters;     // off until draw_clusters()
    CasterPlan casters;       // none until plan_casters()
    GrowthPlan growth;        // none until plan_growth()
    MeadowPlan meadow;        // none until plan_meadow()
    bool request_feedback{};  // the frame tells which of its nodes or clusters show
                              // (core/frame/visibility_feedback.h)
    // Triangles of meshes that cast shadows on all grids of the frame (core/seam/mesh_casters.h): the device
    // address of their tree's nodes, 0 where there are none; their number, after which the triangles come;
    // and where its origin is, ECEF.
    std::uint64_t mesh_casters{};
    std::size_t mesh_nodes{};
    glm::dvec3 mesh_origin_m{0.0};
    // The most pages that it may have, whoever chooses them.
    [[nodiscard]] std::size_t page_room() const {
        return device.chooses ? device.choice.capacity : pages.size();
    }
    // Terms of rows and columns of posts, whoever makes them.
    [[nodiscard]] std::size_t row_count() const {
        return device.on ? gpu::page_posts * std::size_t{device.terms.row_count} : row_terms.size();
    }
    [[nodiscard]] std::size_t column_count() const {
        return device.on ? gpu::page_posts * std::size_t{device.terms.column_count} : column_terms.size();
    }
    // Of whose heights the pages' blocks are: one number, one set of heights. 0: nobody says so.
    std::uint64_t heights{};
};

// One frame: the grids that it draws, at least one. Which of them comes first makes no difference to what is
// seen.
struct FramePlan {
    FrameView view;
    std::vector<GridPlan> grids;
    // Whether nothing is missing, of any grid.
    [[nodiscard]] bool is_settled() const {
        return std::ranges::all_of(
            grids, [](const GridPlan& grid) { return grid.missing.empty() && grid.clusters.missing == 0; });
    }
    // Whether nothing is missing that might show, of any grid.
    [[nodiscard]] bool shows_all() const {
        return std::ranges::all_of(grids, [](const GridPlan& grid) {
            return grid.missing.size() == grid.missing_hidden && grid.clusters.missing == 0;
        });
    }
    // Whether any page of any grid may be in view.
    [[nodiscard]] bool wants_pages() const {
        return std::ranges::any_of(grids, [](const GridPlan& grid) { return grid.pages_wanted > 0; });
    }
};

// Device address of a page's block, 0 where it is not on the GPU.
using Residency = std::function<std::uint64_t(const PageIndex& page)>;

// Whether other ground is known to hide all of a page (core/frame/visibility_feedback.h).
using IsHidden = std::function<bool(const PageIndex& page)>;

// Chooses the pages of one grid for a frame, from the top down: of those that can be seen (conservative: none
// that can is left out) each whose parent is not good enough for the view's tau everywhere, or has its posts
// too far apart to shade slopes from (more than shading_spacing_px). Between neighbours that are there the
// levels differ by at most one, whatever is missing. On another Earth than WGS84 tau is kept as well as that
// Earth agrees with it. coding: of the heights on the GPU. is_hidden: asked of each of them; it changes
// nothing but the order of those that are missing. Errors: a page's record that cannot be read; more pages
// than triangle ids can number.
Result<GridPlan> plan_grid(const RegionPages& pages, const Residency& residency, const FrameView& view,
                           const HeightQuantization& coding = {},
                           double shading_spacing_px = gpu::shading_spacing_px,
                           const IsHidden& is_hidden = {});

}  // namespace oro
