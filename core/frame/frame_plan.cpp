#include "core/frame/frame_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/frame/frame_tables.h"
#include "core/frame/model_view.h"
#include "core/frame/page_table.h"
#include "core/frame/plan_memory.h"
#include "core/lod/levels.h"
#include "core/lod/levels_gpu.h"
#include "core/terrain/page_on_net.h"

namespace oro {
namespace {

// A page that can be seen and is needed.
struct WantedPage {
    const PageRecord* record;
    std::uint64_t address{};  // 0: not on the GPU
    bool open{};              // takes part in the frame
    bool shows{};             // or may, or is needed by one that may
    std::uint32_t fallback_quarters{};
    double distance_m{};
    std::uint32_t number{gpu::no_page};  // in the frame
    [[nodiscard]] const PageIndex& index() const { return record->summary.index; }
};

// Those of a level.
class WantedLevel {
  public:
    std::vector<WantedPage> pages;

    void add(const WantedPage& page) {
        places_.insert(page.index().row, page.index().column, static_cast<std::uint32_t>(pages.size()));
        pages.push_back(page);
    }
    // Null where it is none of them.
    [[nodiscard]] WantedPage* find(int row, int column) {
        const std::uint32_t place = places_.find(row, column);
        return place == PageTable::none ? nullptr : &pages[place];
    }
    [[nodiscard]] const WantedPage* find(int row, int column) const {
        const std::uint32_t place = places_.find(row, column);
        return place == PageTable::none ? nullptr : &pages[place];
    }

  private:
    PageTable places_;
};

// One frame's choice among a region's pages.
class PageChoice {
  public:
    PageChoice(PlanMemory& memory, const Residency& residency, const Camera& camera, const Tile& tile,
               double tau_px, double shading_spacing_px, const ModelView& model)
        : pages_(memory.pages()),
          memory_(memory),
          residency_(residency),
          view_(level_view(camera, tau_px)),
          model_(model),
          view_from_ecef_(camera.view_from_ecef()),
          eye_ecef_(camera.eye_ecef()),
          planes_(frustum_planes_view(projection_of_tile(camera, tile))),
          horizon_(model.horizon(pages_.facts().shape.occluder)),
          post_spacing_m_(wgs84_a_m * pages_.facts().grid.row_step_rad()),
          shading_spacing_px_(shading_spacing_px),
          levels_(static_cast<std::size_t>(pages_.levels())) {
        for (Plane& plane : planes_) plane.w += model.rounding_m();
    }

    Result<void> choose();
    void apply_occlusion_feedback(const IsHidden& is_hidden);
    void number_pages(GridPlan& plan);
    void list_pages(FrameTables& tables, GridPlan& plan) const;

  private:
    WantedLevel& level(int number) { return levels_[static_cast<std::size_t>(number)]; }
    [[nodiscard]] const WantedLevel& level(int number) const {
        return levels_[static_cast<std::size_t>(number)];
    }
    [[nodiscard]] bool good_enough(const PageSummary& page, const PageQuarter& quarter) const;
    [[nodiscard]] bool fine_enough_to_shade(const PageSummary& page, const PageQuarter& quarter) const;
    [[nodiscard]] double gap_reach_m(double distance_m) const {
        return 2.0 * std::max(view_.tau_px, gpu::least_gap_px) / view_.pixels_per_tangent * distance_m;
    }
    bool hidden(const PageRecord& page, const ViewSphere& seen);
    Result<void> want(const PageIndex& index);
    Result<void> descend(WantedPage& page);
    void open_level(int number);
    [[nodiscard]] std::array<PageIndex, 4> neighbours_of_parent(const PageIndex& index,
                                                                std::array<bool, 4>& there) const;
    [[nodiscard]] std::uint32_t number_of(const PageIndex& index) const;
    [[nodiscard]] gpu::FramePage frame_page(const WantedPage& page) const;
    void set_from_eye(const PageSummary& page, gpu::FramePage& frame) const;
    void set_neighbours(const PageIndex& index, gpu::FramePage& frame) const;

    const RegionPages& pages_;
    PlanMemory& memory_;
    const Residency& residency_;
    LevelView view_;
    const ModelView& model_;
    glm::dmat3 view_from_ecef_;
    Ecef eye_ecef_;
    std::array<Plane, 5> planes_;
    SeenHorizon horizon_;
    double post_spacing_m_;  // of level 0, along the meridian
    double shading_spacing_px_;
    std::vector<WantedLevel> levels_;
    std::size_t beyond_frustum_{};
    std::size_t beyond_horizon_{};
};

bool PageChoice::good_enough(const PageSummary& page, const PageQuarter& quarter) const {
    if (quarter.largest_error_m >= gpu::unfit_error_m) return false;
    if (quarter.lod_radius_m < 0.0) return true;  // nothing there, on any level
    const ViewSphere seen = model_.seen(page, quarter.centre_m, quarter.lod_radius_m);
    const double stretch = model_.stretch(page, quarter.centre_m, quarter.lod_radius_m);
    return gpu::projected_error_px(gpu::vec3(seen.centre_m), static_cast<float>(seen.radius_m),
                                   quarter.largest_error_m * static_cast<float>(stretch),
                                   view_.pixels_per_tangent, view_.corner_tangent) <= view_.tau_px;
}

// Are the page's posts close enough on the screen, all over a quarter, to shade slopes from?
bool PageChoice::fine_enough_to_shade(const PageSummary& page, const PageQuarter& quarter) const {
    if (quarter.lod_radius_m < 0.0) return true;
    const ViewSphere seen = model_.seen(page, quarter.centre_m, quarter.lod_radius_m);
    const double distance_m = glm::length(seen.centre_m) - seen.radius_m;
    const double spacing_m = std::ldexp(post_spacing_m_, page.index.level);
    return spacing_m * static_cast<double>(view_.pixels_per_tangent) <= shading_spacing_px_ * distance_m;
}

bool PageChoice::hidden(const PageRecord& page, const ViewSphere& seen) {
    if (beyond_frustum(planes_, seen.centre_m, seen.radius_m)) {
        ++beyond_frustum_;
        return true;
    }
    if (beyond_horizon(horizon_.eye, {page.horizon.direction, page.horizon.angle_rad * horizon_.stretch})) {
        ++beyond_horizon_;
        return true;
    }
    return false;
}

Result<void> PageChoice::want(const PageIndex& index) {
    ORO_TRY(const PageRecord* const record, memory_.record(index));
    if (record->reach_m < 0.0) return {};
    ViewSphere seen = model_.seen_page(pages_.facts().grid, *record);
    // What closes gaps reaches out by pixels.
    if (pages_.is_seam()) seen.radius_m += gap_reach_m(glm::length(seen.centre_m) + seen.radius_m);
    if (hidden(*record, seen)) return {};
    WantedPage page{.record = record};
    page.distance_m = std::max(0.0, glm::length(seen.centre_m) - seen.radius_m);
    page.address = residency_(index);
    level(index.level).add(page);
    return {};
}

// What of a page must be drawn finer.
Result<void> PageChoice::descend(WantedPage& page) {
    const PageSummary& summary = page.record->summary;
    if (summary.index.level == 0) return {};
    const PageLayout below = pages_.layout(summary.index.level - 1);
    for (int i = 0; i < 4; ++i) {
        const PageIndex child{2 * summary.index.row + i / 2, 2 * summary.index.column + i % 2,
                              summary.index.level - 1};
        if (child.row >= below.rows || child.column >= below.columns) continue;
        const PageQuarter& quarter = page.record->quarters[static_cast<std::size_t>(i)];
        const bool enough = model_.may_stand(*page.record) && good_enough(summary, quarter);
        if (enough) page.fallback_quarters |= 1U << static_cast<unsigned>(i);
        if (!enough || !fine_enough_to_shade(summary, quarter)) ORO_CHECK(want(child));
    }
    return {};
}

// Pages of the level above that hold what lies beyond a page's rims: north, east, south, west.
std::array<PageIndex, 4> PageChoice::neighbours_of_parent(const PageIndex& index,
                                                          std::array<bool, 4>& there) const {
    const PageLayout layout = pages_.layout(index.level);
    constexpr std::array<std::pair<int, int>, 4> steps{{{-1, 0}, {0, 1}, {1, 0}, {0, -1}}};
    std::array<PageIndex, 4> parents;
    for (std::size_t i = 0; i < 4; ++i) {
        const int row = index.row + steps[i].first;
        int column = index.column + steps[i].second;
        const bool beyond = column < 0 || column >= layout.columns;
        if (beyond && pages_.wraps_longitude()) column = (column + layout.columns) % layout.columns;
        there[i] = row >= 0 && row < layout.rows && column >= 0 && column < layout.columns;
        parents[i] = {row / 2, column / 2, index.level + 1};
    }
    return parents;
}

// A page is open when it and all above it are there, and no page of the level above beside it is missing:
// what is drawn beside it is then at most one level coarser.
void PageChoice::open_level(int number) {
    const bool top = number == pages_.levels() - 1;
    for (WantedPage& page : level(number).pages) {
        page.open = page.address != 0;
        if (top) continue;
        WantedLevel& above = level(number + 1);
        const PageIndex& index = page.index();
        WantedPage& parent = *above.find(index.row / 2, index.column / 2);
        std::array<bool, 4> there{};
        const std::array<PageIndex, 4> neighbours = neighbours_of_parent(index, there);
        page.open = page.open && parent.open;
        for (std::size_t i = 0; i < 4 && page.open; ++i) {
            if (!there[i]) continue;
            const WantedPage* const beside = above.find(neighbours[i].row, neighbours[i].column);
            page.open = beside == nullptr || beside->open;
        }
        const auto quarter = static_cast<unsigned>(2 * (index.row % 2) + index.column % 2);
        if (!page.open)
            parent.fallback_quarters |= (1U << quarter) | (1U << (gpu::stands_for_missing + quarter));
    }
}

Result<void> PageChoice::choose() {
    const int top = pages_.levels() - 1;
    const PageLayout layout = pages_.layout(top);
    for (int row = 0; row < layout.rows; ++row)
        for (int column = 0; column < layout.columns; ++column) ORO_CHECK(want({row, column, top}));
    for (int number = top; number >= 0; --number) {
        open_level(number);
        for (WantedPage& page : level(number).pages) ORO_CHECK(descend(page));
    }
    return {};
}

// A page that shows needs those without which it is not opened: the one above it and those beside that.
void PageChoice::apply_occlusion_feedback(const IsHidden& is_hidden) {
    for (int number = 0; number < pages_.levels(); ++number) {
        const bool top = number == pages_.levels() - 1;
        for (WantedPage& page : level(number).pages) {
            const PageIndex& index = page.index();
            page.shows = page.shows || !is_hidden || !is_hidden(index);
            if (top || !page.shows) continue;
            WantedLevel& above = level(number + 1);
            above.find(index.row / 2, index.column / 2)->shows = true;
            std::array<bool, 4> there{};
            const std::array<PageIndex, 4> neighbours = neighbours_of_parent(index, there);
            for (std::size_t i = 0; i < 4; ++i) {
                if (!there[i]) continue;
                WantedPage* const beside = above.find(neighbours[i].row, neighbours[i].column);
                if (beside != nullptr) beside->shows = true;
            }
        }
    }
}

void PageChoice::number_pages(GridPlan& plan) {
    std::vector<WantedPage*> open;
    std::vector<const WantedPage*> missing;
    for (WantedLevel& wanted : levels_) {
        plan.pages_wanted += wanted.pages.size();
        for (WantedPage& page : wanted.pages) {
            if (page.open) open.push_back(&page);
            if (page.address == 0)
                missing.push_back(&page);
            else if (!page.shows || !page.open)
                plan.hidden.push_back(page.index());
        }
    }
    const auto key_of = [](const PageIndex& index) {
        return std::tuple(index.level, index.row, index.column);
    };
    const auto key = [&](const WantedPage& page) { return key_of(page.index()); };
    std::ranges::sort(plan.hidden, {}, key_of);
    // Near pages first: what they hide fails the depth test before it is shaded. Ties by number: one order
    // for one input.
    std::sort(open.begin(), open.end(), [&](const WantedPage* a, const WantedPage* b) {
        return a->distance_m != b->distance_m ? a->distance_m < b->distance_m : key(*a) < key(*b);
    });
    // What shows first, of that what others wait for, then what is near.
    std::sort(missing.begin(), missing.end(), [&](const WantedPage* a, const WantedPage* b) {
        const PageIndex& one = a->index();
        const PageIndex& other = b->index();
        if (a->shows != b->shows) return a->shows;
        if (one.level != other.level) return one.level > other.level;
        return a->distance_m != b->distance_m ? a->distance_m < b->distance_m : key(*a) < key(*b);
    });
    for (WantedPage* page : open) {
        page->number = static_cast<std::uint32_t>(plan.page_indices.size());
        plan.page_indices.push_back(page->index());
    }
    for (const WantedPage* page : missing) {
        plan.missing.push_back(page->index());
        plan.missing_hidden += page->shows ? 0 : 1;
    }
    plan.pages_beyond_frustum = beyond_frustum_;
    plan.pages_beyond_horizon = beyond_horizon_;
}

std::uint32_t PageChoice::number_of(const PageIndex& index) const {
    if (index.level >= pages_.levels()) return gpu::no_page;
    const WantedPage* const found = level(index.level).find(index.row, index.column);
    return found == nullptr ? gpu::no_page : found->number;
}

void PageChoice::set_neighbours(const PageIndex& index, gpu::FramePage& frame) const {
    constexpr int side = static_cast<int>(gpu::meshlets_per_side);
    frame.quarter = static_cast<gpu::uint>(2 * (index.row % 2) + index.column % 2);
    frame.parent = number_of({index.row / 2, index.column / 2, index.level + 1});
    std::array<bool, 4> there{};
    const std::array<PageIndex, 4> neighbours = neighbours_of_parent(index, there);
    for (std::size_t i = 0; i < 4; ++i)
        frame.neighbours[i] = there[i] ? number_of(neighbours[i]) : gpu::no_page;
    for (int i = 0; i < 4; ++i) {
        const PageIndex child{2 * index.row + i / 2, 2 * index.column + i % 2, index.level - 1};
        frame.children[i] = index.level == 0 ? gpu::no_page : number_of(child);
    }
    frame.last_column = frame.west_column = gpu::meshlets_per_side - 1;
    if (!pages_.wraps_longitude()) return;
    const int nodes = level_grid(pages_.facts().grid, index.level).column.nodes();
    frame.last_column = static_cast<gpu::uint>(std::min(side - 1, nodes - 1 - index.column * side));
    if (index.column == 0) frame.west_column = static_cast<gpu::uint>((nodes - 1) / 2 % side);
}

// From the eye to the page's origin, on the lattice: 64 bits along each axis.
void PageChoice::set_from_eye(const PageSummary& page, gpu::FramePage& frame) const {
    const LatticePoint origin = lattice_point(page.origin_ecef.m), eye = lattice_point(eye_ecef_.m);
    for (int axis = 0; axis < 3; ++axis) {
        const auto from_eye = static_cast<std::uint64_t>(origin.steps[static_cast<std::size_t>(axis)] -
                                                         eye.steps[static_cast<std::size_t>(axis)]);
        frame.from_eye_low[axis] = static_cast<gpu::uint>(from_eye);
        frame.from_eye_high[axis] = static_cast<gpu::uint>(from_eye >> 32U);
    }
}

gpu::FramePage PageChoice::frame_page(const WantedPage& page) const {
    const PageSummary& summary = page.record->summary;
    const glm::dmat3 view_from_page = view_from_ecef_ * summary.ecef_from_page;
    const glm::dvec3 origin_view = model_.origin_m(summary);
    const ViewSphere seen = model_.seen(summary, summary.centre_m, summary.radius_m);
    gpu::FramePage frame{};
    frame.view_from_page = gpu::mat3(view_from_page);
    frame.origin_view = gpu::vec3(origin_view);
    bool inside_all = true;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
        const glm::dvec3 normal(planes_[i]);
        const Plane for_nodes = model_.plane_for_nodes(planes_[i], summary);
        frame.planes[i] = gpu::vec4(gpu::vec3(glm::transpose(view_from_page) * normal),
                                    static_cast<float>(glm::dot(normal, origin_view) + for_nodes.w));
        inside_all = inside_all && glm::dot(normal, seen.centre_m) + planes_[i].w > seen.radius_m;
    }
    frame.horizon_direction = gpu::vec3(horizon_.eye.direction - summary.horizon.direction);
    frame.cull = (inside_all ? 0U : gpu::cull_by_frustum) |
                 (horizon_.eye.angle_rad < std::numbers::pi ? gpu::cull_by_horizon : 0U);
    if (!model_.culls_nodes() || pages_.is_seam()) frame.cull = 0;
    if (pages_.is_skirt(summary.index)) frame.cull |= gpu::is_skirt;
    if (pages_.facts().grid.net && !pages_.is_seam() && reaches_far(summary))
        frame.cull |= gpu::places_from_plane;
    if (!model_.may_stand(*page.record)) frame.cull |= gpu::never_coarsen;
    if (model_.culls_nodes() && !pages_.is_seam()) frame.cull |= gpu::cull_by_occlusion;
    frame.block = {static_cast<gpu::uint>(page.address), static_cast<gpu::uint>(page.address >> 32U)};
    frame.level = static_cast<gpu::uint>(summary.index.level);
    if (pages_.facts().grid.net) set_from_eye(summary, frame);
    frame.fallback_quarters = page.fallback_quarters;
    set_neighbours(summary.index, frame);
    return frame;
}

void PageChoice::list_pages(FrameTables& tables, GridPlan& plan) const {
    for (const PageIndex& index : plan.page_indices) {
        gpu::FramePage frame = frame_page(*level(index.level).find(index.row, index.column));
        tables.place(index, frame);
        plan.pages.push_back(frame);
    }
}

}  // namespace

Result<GridPlan> plan_grid(PlanMemory& memory, const Residency& residency, const FrameView& view,
                           const HeightQuantization& coding, double shading_spacing_px,
                           const IsHidden& is_hidden) {
    const auto& [camera, tile, tau_px, model] = view;
    const RegionPages& pages = memory.pages();
    const ModelView model_view(camera, model, coding);
    memory.begin_frame();
    PageChoice choice(memory, residency, camera, tile, tau_px, shading_spacing_px, model_view);
    ORO_CHECK(choice.choose());
    choice.apply_occlusion_feedback(is_hidden);
    GridPlan plan;
    choice.number_pages(plan);
    if (plan.page_indices.size() > gpu::pages_max)
        return Error{ErrorKind::failed, "frame",
                     std::to_string(plan.page_indices.size()) + " pages of terrain in one frame, at most " +
                         std::to_string(gpu::pages_max) + " can be drawn (a larger --tau needs fewer)"};
    FrameTables tables(pages.facts().grid, camera.eye, model.earth, &memory.angles());
    choice.list_pages(tables, plan);
    plan.row_terms = tables.take_rows();
    plan.column_terms = tables.take_columns();
    plan.constants = frame_constants(pages, camera, tile, tau_px, model, coding);
    plan.constants.page_count = static_cast<gpu::uint>(plan.pages.size());
    plan.constants.placing_slack_m = static_cast<float>(model_view.rounding_m()) * 1.001F;
    return plan;
}

Result<GridPlan> plan_grid(const RegionPages& pages, const Residency& residency, const FrameView& view,
                           const HeightQuantization& coding, double shading_spacing_px,
                           const IsHidden& is_hidden) {
    PlanMemory memory(pages);
    return plan_grid(memory, residency, view, coding, shading_spacing_px, is_hidden);
}

}  // namespace oro
