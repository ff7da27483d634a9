#include "core/frame/casters.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "core/frame/cast_map.h"
#include "core/frame/frame_plan.h"
#include "core/frame/model_view.h"
#include "core/frame/plan_memory.h"
#include "core/lod/levels.h"
#include "core/lod/levels_gpu.h"

namespace oro {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Collects the pages.
class CasterChoice {
  public:
    CasterChoice(PlanMemory& memory, const std::function<std::uint64_t(const PageIndex&)>& residency)
        : pages_(memory.pages()), memory_(memory), residency_(residency), turn_(memory.begin_casters()) {}

    // A page and what a map of lines needs below it.
    Result<void> want(const CastMap& map, KeptPage& page);
    // Pages beside those of a plan; theirs above are among them.
    Result<void> want_around(const GridPlan& plan);
    Result<void> list(GridPlan& plan);

  private:
    struct Held {
        KeptPage* page;
        std::uint64_t address;
    };
    // The plan has asked for what it shows.
    [[nodiscard]] std::uint64_t address_of(const KeptPage& page) const {
        const KeptPage::Wanted& planned = page.wanted;
        const bool is_shown = planned.turn == memory_.turn() && planned.open && planned.shows;
        return is_shown && planned.address != 0 ? planned.address : residency_(page.index());
    }
    // False where it was so already.
    bool stamp(std::uint64_t& by) const { return std::exchange(by, turn_) != turn_; }
    Result<void> find_missing(GridPlan& plan);

    const RegionPages& pages_;
    PlanMemory& memory_;
    const std::function<std::uint64_t(const PageIndex&)>& residency_;
    std::uint64_t turn_;
    std::vector<Held> wanted_;
};

Result<void> CasterChoice::want_around(const GridPlan& plan) {
    for (std::size_t i = 0; i < plan.page_indices.size(); ++i) {
        const PageIndex& page = plan.page_indices[i];
        ORO_TRY(KeptPage* const kept, memory_.page_of(plan, i));
        const PageLayout& layout = memory_.layout(page.level);
        for (int row = std::max(0, page.row - 1); row <= std::min(layout.rows - 1, page.row + 1); ++row)
            for (int column = std::max(0, page.column - 1);
                 column <= std::min(layout.columns - 1, page.column + 1); ++column) {
                ORO_TRY(KeptPage* const neighbour,
                        memory_.around(*kept, row - page.row, column - page.column));
                if (!stamp(neighbour->asked_by)) continue;
                if (neighbour->has_record && neighbour->reach_m < 0.0) continue;
                wanted_.push_back({neighbour, address_of(*neighbour)});
            }
    }
    return {};
}

Result<void> CasterChoice::want(const CastMap& map, KeptPage& page) {
    stamp(page.asked_by);
    const PageRecord& record = page.record;
    if (!page.has_record) {
        wanted_.push_back({&page, 0});  // missing, and so is what it may need below it
        return {};
    }
    if (page.reach_m < 0.0) return {};
    const PageIndex& index = page.index();
    wanted_.push_back({&page, address_of(page)});
    const std::int64_t posts = std::int64_t{gpu::page_quads} << std::max(0, index.level - 1);
    for (std::size_t i = 0; i < 4; ++i) {
        if ((page.has_child >> i & 1U) == 0) continue;
        const std::int64_t row = 2 * index.row + static_cast<int>(i / 2),
                           column = 2 * index.column + static_cast<int>(i % 2);
        const CastMap::Need need = map.need(map.patch(row * posts, column * posts, posts));
        const auto error_m = static_cast<double>(record.quarters[i].largest_error_m);
        const double top_m = record.summary.highest_h_m + error_m + 1.0;
        if (!(error_m > need.error_m && top_m >= need.low_m)) continue;
        ORO_TRY(KeptPage* const child, memory_.child(page, i));
        ORO_CHECK(want(map, *child));
    }
    return {};
}

// What is wanted and is not on the GPU.
Result<void> CasterChoice::find_missing(GridPlan& plan) {
    if (std::ranges::all_of(wanted_, [](const Held& held) { return held.address != 0; })) return {};
    for (const PageIndex& index : plan.missing) {
        ORO_TRY(KeptPage* const page, memory_.page(index));
        page->lacked_by = turn_;
    }
    for (const Held& held : wanted_)
        if (held.address == 0 && stamp(held.page->lacked_by)) plan.missing.push_back(held.page->index());
    return {};
}

Result<void> CasterChoice::list(GridPlan& plan) {
    CasterPlan& casters = plan.casters;
    std::vector<PageIndex> low(static_cast<std::size_t>(pages_.levels()),
                               {std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 0});
    std::vector<PageIndex> high(low.size(), {-1, -1, 0});
    casters.pages.reserve(plan.pages.size() + wanted_.size());
    const auto add = [&](KeptPage& page, const gpu::uvec2& block) {
        if (!stamp(page.listed_by)) return;
        const PageIndex& index = page.index();
        casters.pages.push_back({block, static_cast<gpu::uint>(index.level),
                                 static_cast<gpu::uint>(index.row), static_cast<gpu::uint>(index.column)});
        const auto level = static_cast<std::size_t>(index.level);
        low[level].row = std::min(low[level].row, index.row);
        low[level].column = std::min(low[level].column, index.column);
        high[level].row = std::max(high[level].row, index.row);
        high[level].column = std::max(high[level].column, index.column);
    };
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        ORO_TRY(KeptPage* const page, memory_.page_of(plan, i));
        add(*page, plan.pages[i].block);
    }
    for (const auto& [page, address] : wanted_)
        if (address != 0)
            add(*page, {static_cast<gpu::uint>(address), static_cast<gpu::uint>(address >> 32U)});
    ORO_CHECK(find_missing(plan));
    for (std::size_t level = 0; level < low.size(); ++level) {
        if (high[level].row < 0) continue;
        gpu::CasterLevel& held = casters.frame.levels[level];
        held.first_row = static_cast<gpu::uint>(low[level].row);
        held.first_column = static_cast<gpu::uint>(low[level].column);
        held.rows = static_cast<gpu::uint>(high[level].row - low[level].row + 1);
        held.columns = static_cast<gpu::uint>(high[level].column - low[level].column + 1);
        held.first = static_cast<gpu::uint>(casters.table.size());
        casters.table.resize(casters.table.size() + std::size_t{held.rows} * held.columns, gpu::no_page);
    }
    for (std::size_t i = 0; i < casters.pages.size(); ++i) {
        const gpu::CasterPage& page = casters.pages[i];
        const gpu::CasterLevel& held = casters.frame.levels[page.level];
        casters.table[held.first + (page.row - held.first_row) * held.columns + page.column -
                      held.first_column] = static_cast<gpu::uint>(i);
    }
    casters.frame.page_count = static_cast<gpu::uint>(casters.pages.size());
    return {};
}

double error_per_metre(const GridPlan& plan) {
    return caster_error_per_metre(plan.constants.pixels_per_tangent);
}

// A quarter of a plan's page that is seen, and so may be shaded.
struct SeenQuarter {
    std::int64_t row, column, posts;  // its first post in the region, and how many along a side
    ShadowReceiver ground;
};
template <class Found>
Result<void> look_for_quarters(PlanMemory& memory, const FrameView& view, const GridPlan& plan,
                               const Found& found) {
    const double error_per_m = error_per_metre(plan);
    const glm::dmat3 view_from_ecef = view.camera.view_from_ecef();
    const glm::dvec3 eye = view.camera.eye_ecef().m;
    const auto planes = frustum_planes_view(projection_of_tile(view.camera, view.tile));
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        const gpu::FramePage& page = plan.pages[i];
        const PageIndex& index = plan.page_indices[i];
        ORO_TRY(const KeptPage* const known, memory.page_of(plan, i));
        const PageRecord& record = known->record;
        const std::int64_t half = std::int64_t{gpu::page_quads / 2} << index.level;
        for (int quarter = 0; quarter < 4; ++quarter) {
            if (page.children[quarter] != gpu::no_page) continue;
            if (index.level > 0 && (page.fallback_quarters >> static_cast<unsigned>(quarter) & 1U) == 0)
                continue;
            const PageQuarter& part = record.quarters[static_cast<std::size_t>(quarter)];
            if (part.lod_radius_m < 0.0) continue;
            const glm::dvec3& centre_ecef = known->quarter_ecef_m[static_cast<std::size_t>(quarter)];
            const glm::dvec3 centre = view_from_ecef * (centre_ecef - eye);
            const double lift_m =
                0.1 * glm::dot(centre, centre) / mean_radius_m;  // light that bends shows it higher
            if (beyond_frustum(planes, centre, part.lod_radius_m + lift_m)) continue;
            const double distance_m =
                std::max(0.5, 0.999 * (glm::length(centre) - part.lod_radius_m - lift_m));
            const double error_m =
                index.level == 0 ? 0.0 : std::min(1.0e4, static_cast<double>(part.largest_error_m));
            found({2 * index.row * half + quarter / 2 * half,
                   2 * index.column * half + quarter % 2 * half,
                   half,
                   {{centre_ecef},
                    part.lod_radius_m,
                    error_per_m * distance_m,
                    record.summary.lowest_h_m - error_m}});
        }
    }
    return {};
}

Result<double> top_of(const RegionPages& pages, const PageIndex& index) {
    ORO_TRY(const PageRecord record, pages.record(index));
    if (record.reach_m < 0.0) return -infinite;
    double top_m = -infinite;
    const PageLayout below = index.level > 0 ? pages.layout(index.level - 1) : PageLayout{};
    for (int i = 0; i < 4; ++i) {
        const double error_m =
            static_cast<double>(record.quarters[static_cast<std::size_t>(i)].largest_error_m);
        const PageIndex child{2 * index.row + i / 2, 2 * index.column + i % 2, index.level - 1};
        if (index.level == 0 || error_m < 500.0) {
            top_m = std::max(top_m, record.summary.highest_h_m + (index.level == 0 ? 0.0 : error_m));
        } else if (child.row < below.rows && child.column < below.columns) {
            ORO_TRY(const double part_m, top_of(pages, child));
            top_m = std::max(top_m, part_m);
        }
    }
    return top_m;
}

}  // namespace

ShadowRequest shadow_request(const gpu::FrameStyle& style) {
    constexpr double lowest = -0.1;  // sine: even mountains seen from there lie in the Earth's own shadow
    const bool dark = style.air.on == 0 && style.sun_hidden >= 1.0F;
    ShadowRequest request;
    request.sky_openness = style.sky_openness != 0;
    if (style.shadows != 0 && !dark && style.sun_enu.z >= lowest)
        request.sun_enu = glm::normalize(glm::dvec3(style.sun_enu));
    return request;
}

Result<double> region_top_m(const RegionPages& pages) {
    const int top = pages.levels() - 1;
    if (pages.layout(top).count() == 0) return 0.0;
    if (const auto known = pages.known_heights()) return known->highest_h_m;
    ORO_TRY(const double top_m, top_of(pages, {0, 0, top}));
    return std::max(top_m, -1.0e5) + 1.0;
}

// The ground of a seam lies along the rims of grids, a few of their posts wide.
Result<std::vector<ShadowReceiver>> shadow_receivers(PlanMemory& memory, const FrameView& view,
                                                     const GridPlan& plan) {
    const RegionPages& pages = memory.pages();
    constexpr double rim_posts = 3.0;
    std::vector<ShadowReceiver> all;
    if (!pages.has_posts()) return all;
    const double rim_m = rim_posts * mean_radius_m * pages.facts().grid.row_step_rad();
    ORO_CHECK(look_for_quarters(memory, view, plan, [&](const SeenQuarter& quarter) {
        all.push_back(quarter.ground);
        all.back().radius_m += rim_m;
    }));
    return all;
}

Result<std::vector<ShadowReceiver>> shadow_receivers(const RegionPages& pages, const FrameView& view,
                                                     const GridPlan& plan) {
    PlanMemory memory(pages);
    return shadow_receivers(memory, view, plan);
}

// Of a region that is wider than a map of fine cells: those around what is seen, and as fine as may be.
static CastMap::Window window_around(PlanMemory& memory, const std::vector<SeenQuarter>& seen,
                                     const FrameView& view, const glm::dvec3& sun_enu, double top_m) {
    constexpr int cells_most = 128;
    std::int64_t north = std::numeric_limits<std::int64_t>::max(), south = -1, west = north, east = -1;
    double farthest_m = 0.0, lowest_m = top_m;
    for (const SeenQuarter& quarter : seen) {
        north = std::min(north, quarter.row);
        south = std::max(south, quarter.row + quarter.posts - 1);
        west = std::min(west, quarter.column);
        east = std::max(east, quarter.column + quarter.posts - 1);
        farthest_m = std::max(farthest_m, glm::length(quarter.ground.centre.m - view.camera.eye_ecef().m) +
                                              quarter.ground.radius_m);
        lowest_m = std::min(lowest_m, quarter.ground.lowest_m);
    }
    if (south < 0) return {};
    for (int level = 0;; ++level) {
        const CastCells& cells = memory.cast_cells(level);
        const auto cell = [&](std::int64_t post, int count) {
            return static_cast<int>(std::min<std::int64_t>(post / cells.posts(), count - 1));
        };
        const int row = cell(north, cells.layout().rows), column = cell(west, cells.layout().columns);
        const CastMap::Window window =
            CastMap::window_of(cells,
                               {row, column, cell(south, cells.layout().rows) - row + 1,
                                cell(east, cells.layout().columns) - column + 1},
                               sun_enu, farthest_m, lowest_m, top_m);
        if (std::max(window.rows, window.columns) <= cells_most || level + 1 == memory.pages().levels())
            return window;
    }
}

// What lines need from all that a plan shows towards the sun.
static Result<void> map_casters(PlanMemory& memory, const FrameView& view, const glm::dvec3& sun_enu,
                                double top_m, const GridPlan& plan, std::span<const ShadowReceiver> others,
                                std::optional<CastMap>& found) {
    std::vector<SeenQuarter> seen;
    ORO_CHECK(
        look_for_quarters(memory, view, plan, [&](const SeenQuarter& quarter) { seen.push_back(quarter); }));
    const int level = CastCells::level_of_whole(memory.pages());
    const bool is_whole = level == 0 || seen.empty() || !others.empty() || memory.pages().facts().grid.net;
    CastMap::Window window;
    if (!is_whole) window = window_around(memory, seen, view, sun_enu, top_m);
    CastCells& cells = is_whole ? memory.cast_cells(level) : memory.kept_cast_cells();
    if (is_whole) window = CastMap::whole(cells);
    CastMap& map = found.emplace(memory.pages(), cells,
                                 ecef_from_enu(view.camera.eye.lat_deg, view.camera.eye.lon_deg) * sun_enu,
                                 top_m, window);
    for (const SeenQuarter& quarter : seen)
        map.receive(map.patch(quarter.row, quarter.column, quarter.posts), quarter.ground.error_per_slope_m,
                    quarter.ground.lowest_m);
    map.cast();
    for (const ShadowReceiver& receiver : others) map.cast_from_other_grid(receiver);
    return {};
}

Result<void> plan_casters(PlanMemory& memory, const std::function<std::uint64_t(const PageIndex&)>& residency,
                          const FrameView& view, const ShadowRequest& request, double top_m, GridPlan& plan,
                          std::span<const ShadowReceiver> others) {
    const RegionPages& pages = memory.pages();
    const int top = pages.levels() - 1;
    if (pages.layout(top).count() == 0) return {};
    CasterChoice choice(memory, residency);
    bool for_shadows = request.sun_enu.has_value();
    if (for_shadows) {
        std::optional<CastMap> found;
        const CastMap* map = pages.cast_map();
        if (map == nullptr) {
            ORO_CHECK(map_casters(memory, view, *request.sun_enu, top_m, plan, others, found));
            map = &*found;
        }
        for_shadows = !plan.pages.empty() || map->any();
        if (for_shadows) {
            ORO_TRY(KeptPage* const whole, memory.page({0, 0, top}));
            ORO_CHECK(choice.want(*map, *whole));
        }
    }
    if (plan.pages.empty() && !for_shadows) return {};
    if (request.sky_openness) ORO_CHECK(choice.want_around(plan));
    ORO_CHECK(choice.list(plan));
    plan.casters.for_shadows = for_shadows;
    plan.casters.for_openness = request.sky_openness;
    const RegionFacts& facts = pages.facts();
    gpu::Casters& frame = plan.casters.frame;
    frame.level_count = static_cast<gpu::uint>(pages.levels());
    frame.row_rad = static_cast<float>(facts.grid.row_step_rad());
    frame.column_rad = static_cast<float>(facts.grid.column_step_rad());
    frame.top_m = static_cast<float>(top_m);
    frame.error_per_m = static_cast<float>(error_per_metre(plan));
    return {};
}

Result<void> plan_casters(const RegionPages& pages,
                          const std::function<std::uint64_t(const PageIndex&)>& residency,
                          const FrameView& view, const ShadowRequest& request, double top_m, GridPlan& plan,
                          std::span<const ShadowReceiver> others) {
    PlanMemory memory(pages);
    return plan_casters(memory, residency, view, request, top_m, plan, others);
}

}  // namespace oro
