#include "core/frame/frame_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/frame/detail_rule.h"
#include "core/frame/frame_tables.h"
#include "core/frame/model_view.h"
#include "core/frame/plan_memory.h"
#include "core/lod/levels.h"
#include "core/terrain/page_on_net.h"

namespace oro {
namespace {

// What of a device's terms depends on the camera, but for the tables. planes: as they are tested.
void set_view(gpu::PlanTerms& terms, const glm::dmat3& view_from_ecef, const Ecef& eye_ecef,
              const SeenHorizon& horizon, const std::array<Plane, 5>& planes) {
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            terms.view_from_ecef[3 * column + row] = view_from_ecef[column][row];
    for (int axis = 0; axis < 3; ++axis) {
        terms.eye_ecef[axis] = eye_ecef.m[axis];
        terms.horizon[axis] = horizon.eye.direction[axis];
    }
    for (int i = 0; i < static_cast<int>(planes.size()); ++i)
        for (int axis = 0; axis < 4; ++axis)
            terms.planes[4 * i + axis] = planes[static_cast<std::size_t>(i)][axis];
}

// Null where the processor makes all of the plan.
PlanSources* sources_for(PlanMemory& memory, const ModelView& model, const Geodetic& eye) {
    PlanSources* const sources = memory.sources();
    if (sources == nullptr || !model.culls_nodes() || model.curvature_per_m() != 0.0) return nullptr;
    return sources->is_near(eye.lon_deg) ? sources : nullptr;
}

// One frame's choice among a region's pages.
class PageChoice {
  public:
    PageChoice(PlanMemory& memory, const Residency& residency, const Camera& camera, const Tile& tile,
               double tau_px, double shading_spacing_px, const ModelView& model)
        : pages_(memory.pages()),
          memory_(memory),
          turn_(memory.begin_frame()),
          residency_(residency),
          view_(level_view(camera, tau_px)),
          rule_(view_, wgs84_a_m * pages_.facts().grid.row_step_rad(), shading_spacing_px),
          model_(model),
          view_from_ecef_(camera.view_from_ecef()),
          eye_ecef_(camera.eye_ecef()),
          planes_(frustum_planes_view(projection_of_tile(camera, tile))),
          horizon_(model.horizon(pages_.facts().shape.occluder)) {
        for (Plane& plane : planes_) plane.w += model.rounding_m();
    }

    Result<void> choose();
    void apply_occlusion_feedback(const IsHidden& is_hidden);
    void number_pages(GridPlan& plan);
    [[nodiscard]] PlanSources* sources(const Geodetic& eye) const;
    void list_pages(FrameTables& tables, PlanSources* sources, GridPlan& plan) const;

  private:
    std::vector<KeptPage*>& level(int number) { return memory_.wanted[static_cast<std::size_t>(number)]; }
    // Null where it is null or this choice does not want it.
    [[nodiscard]] KeptPage* wanted(KeptPage* page) const {
        return page != nullptr && page->wanted.turn == turn_ ? page : nullptr;
    }
    [[nodiscard]] double gap_reach_m(double distance_m) const {
        return 2.0 * std::max(view_.tau_px, gpu::least_gap_px) / view_.pixels_per_tangent * distance_m;
    }
    bool hidden(const HorizonCone& cone, const ViewSphere& seen);
    bool hidden_by_bound(const PageIndex& index);
    void want(KeptPage& page);
    void want_unknown(KeptPage& page);
    Result<void> descend(KeptPage& page);
    void open_level(int number);
    [[nodiscard]] gpu::uint number_of(KeptPage* page) const {
        const KeptPage* const found = wanted(page);
        return found == nullptr ? gpu::no_page : found->wanted.number;
    }
    void leave_to_device(const FrameTables& tables, PlanSources& sources, GridPlan& plan) const;
    void set_place(const KeptPage& page, gpu::FramePage& frame) const;
    void set_frame_page(KeptPage& page, bool by_device, gpu::FramePage& frame) const;
    void set_from_eye(const PageSummary& page, gpu::FramePage& frame) const;
    void set_neighbours(KeptPage& page, gpu::FramePage& frame) const;

    const RegionPages& pages_;
    PlanMemory& memory_;
    std::uint64_t turn_;
    const Residency& residency_;
    LevelView view_;
    DetailRule rule_;
    const ModelView& model_;
    glm::dmat3 view_from_ecef_;
    Ecef eye_ecef_;
    std::array<Plane, 5> planes_;
    SeenHorizon horizon_;
    std::size_t beyond_frustum_{};
    std::size_t beyond_horizon_{};
};

bool PageChoice::hidden(const HorizonCone& cone, const ViewSphere& seen) {
    if (beyond_frustum(planes_, seen.centre_m, seen.radius_m)) {
        ++beyond_frustum_;
        return true;
    }
    if (beyond_horizon(horizon_.eye, {cone.direction, cone.angle_rad * horizon_.stretch})) {
        ++beyond_horizon_;
        return true;
    }
    return false;
}

// Whether a page need not be asked for its record, which may take long.
bool PageChoice::hidden_by_bound(const PageIndex& index) {
    if (!model_.culls_nodes()) return false;
    const std::optional<PageBound> bound = pages_.bound(index);
    return bound && hidden(bound->horizon, model_.seen_at(bound->centre.m, bound->radius_m).sphere);
}

// A page of which its place alone is known: it is missing. Who asks for it has culled it by its bound.
void PageChoice::want_unknown(KeptPage& page) {
    double distance_m = 0.0;
    if (const std::optional<PageBound> bound = pages_.bound(page.index()); bound && model_.culls_nodes()) {
        const ViewSphere seen = model_.seen_at(bound->centre.m, bound->radius_m).sphere;
        distance_m = std::max(0.0, glm::length(seen.centre_m) - seen.radius_m);
    }
    page.wanted = {.turn = turn_, .distance_m = distance_m};
    level(page.index().level).push_back(&page);
}

void PageChoice::want(KeptPage& page) {
    if (!page.has_record) return want_unknown(page);
    const PageRecord& record = page.record;
    if (page.reach_m < 0.0) return;
    ViewSphere seen = model_.culls_nodes() ? model_.seen_at(page.centre_ecef_m, page.reach_m).sphere
                                           : model_.seen_page(pages_.facts().grid, record);
    // What closes gaps reaches out by pixels.
    if (!pages_.has_posts()) seen.radius_m += gap_reach_m(glm::length(seen.centre_m) + seen.radius_m);
    if (hidden(record.horizon, seen)) return;
    page.wanted = {.turn = turn_,
                   .distance_m = std::max(0.0, glm::length(seen.centre_m) - seen.radius_m),
                   .address = residency_(page.index())};
    level(page.index().level).push_back(&page);
}

// What of a page must be drawn finer.
Result<void> PageChoice::descend(KeptPage& page) {
    if (!page.has_record) return {};
    const PageSummary& summary = page.record.summary;
    const bool may_stand = model_.may_stand(page.record);
    for (std::size_t i = 0; i < 4; ++i) {
        if ((page.has_child >> i & 1U) == 0) continue;
        const PageQuarter& quarter = page.record.quarters[i];
        // Where nothing is, on any level, all is good.
        const bool is_empty = quarter.lod_radius_m < 0.0;
        bool enough = may_stand && quarter.largest_error_m < gpu::unfit_error_m, fine = true;
        if (!is_empty) {
            const ModelView::SeenAt seen =
                model_.culls_nodes() ? model_.seen_at(page.quarter_ecef_m[i], quarter.lod_radius_m)
                                     : model_.seen_at(summary, quarter.centre_m, quarter.lod_radius_m);
            const double distance_m = glm::length(seen.sphere.centre_m);
            enough = enough && rule_.good_enough(quarter, seen.sphere, distance_m, seen.stretch);
            fine = rule_.fine_enough_to_shade(summary.index.level, seen.sphere, distance_m);
        }
        if (enough) page.wanted.fallback_quarters |= 1U << static_cast<unsigned>(i);
        if (enough && fine) continue;
        const int number = static_cast<int>(i);
        const PageIndex& above = page.index();
        if (hidden_by_bound({2 * above.row + number / 2, 2 * above.column + number % 2, above.level - 1}))
            continue;
        ORO_TRY(KeptPage* const child, memory_.child(page, i));
        want(*child);
    }
    return {};
}

// A page is open when it and all above it are there, and no page of the level above beside it is missing:
// what is drawn beside it is then at most one level coarser.
void PageChoice::open_level(int number) {
    const bool top = number == pages_.levels() - 1;
    for (KeptPage* const page : level(number)) {
        KeptPage::Wanted& state = page->wanted;
        state.open = state.address != 0;
        if (top) continue;
        KeptPage& parent = *memory_.parent(*page);
        state.open = state.open && parent.wanted.open;
        for (std::size_t i = 0; i < 4 && state.open; ++i) {
            const KeptPage* const beside = wanted(memory_.beside(*page, i));
            state.open = beside == nullptr || beside->wanted.open;
        }
        const PageIndex& index = page->index();
        const auto quarter = static_cast<unsigned>(2 * (index.row % 2) + index.column % 2);
        if (!state.open)
            parent.wanted.fallback_quarters |= (1U << quarter) | (1U << (gpu::stands_for_missing + quarter));
    }
}

Result<void> PageChoice::choose() {
    const int top = pages_.levels() - 1;
    const PageLayout layout = pages_.layout(top);
    for (int row = 0; row < layout.rows; ++row)
        for (int column = 0; column < layout.columns; ++column) {
            if (hidden_by_bound({row, column, top})) continue;
            ORO_TRY(KeptPage* const page, memory_.page({row, column, top}));
            want(*page);
        }
    for (int number = top; number >= 0; --number) {
        open_level(number);
        if (number == 0) break;
        for (KeptPage* const page : level(number)) ORO_CHECK(descend(*page));
    }
    return {};
}

// A page that shows needs those without which it is not opened: the one above it and those beside that.
void PageChoice::apply_occlusion_feedback(const IsHidden& is_hidden) {
    for (int number = 0; number < pages_.levels(); ++number) {
        const bool top = number == pages_.levels() - 1;
        for (KeptPage* const page : level(number)) {
            page->wanted.shows = page->wanted.shows || !is_hidden || !is_hidden(page->index());
            if (top || !page->wanted.shows) continue;
            memory_.parent(*page)->wanted.shows = true;
            for (std::size_t i = 0; i < 4; ++i)
                if (KeptPage* const beside = wanted(memory_.beside(*page, i))) beside->wanted.shows = true;
        }
    }
}

void PageChoice::number_pages(GridPlan& plan) {
    // With its distance, so that sorting asks no page but where two are as far.
    struct Near {
        double distance_m;
        KeptPage* page;
    };
    std::vector<Near> open;
    std::vector<const KeptPage*> missing;
    for (const std::vector<KeptPage*>& of_level : memory_.wanted) {
        plan.pages_wanted += of_level.size();
        for (KeptPage* const page : of_level) {
            if (page->wanted.open) open.push_back({page->wanted.distance_m, page});
            if (page->wanted.address == 0)
                missing.push_back(page);
            else if (!page->wanted.shows || !page->wanted.open)
                plan.hidden.push_back(page->index());
        }
    }
    const auto key_of = [](const PageIndex& index) {
        return std::tuple(index.level, index.row, index.column);
    };
    const auto is_nearer = [&](const KeptPage* a, const KeptPage* b) {
        const double one_m = a->wanted.distance_m, other_m = b->wanted.distance_m;
        return one_m != other_m ? one_m < other_m : key_of(a->index()) < key_of(b->index());
    };
    std::ranges::sort(plan.hidden, {}, key_of);
    // Near pages first: what they hide fails the depth test before it is shaded. Ties by number: one order
    // for one input.
    std::sort(open.begin(), open.end(), [&](const Near& a, const Near& b) {
        return a.distance_m != b.distance_m ? a.distance_m < b.distance_m
                                            : key_of(a.page->index()) < key_of(b.page->index());
    });
    // What shows first, of that what others wait for, then what is near.
    std::sort(missing.begin(), missing.end(), [&](const KeptPage* a, const KeptPage* b) {
        if (a->wanted.shows != b->wanted.shows) return a->wanted.shows;
        if (a->index().level != b->index().level) return a->index().level > b->index().level;
        return is_nearer(a, b);
    });
    plan.page_indices.reserve(open.size());
    memory_.planned.reserve(open.size());
    for (const auto& [distance_m, page] : open) {
        memory_.planned.push_back(page);
        page->wanted.number = static_cast<std::uint32_t>(plan.page_indices.size());
        plan.page_indices.push_back(page->index());
    }
    for (const KeptPage* const page : missing) {
        plan.missing.push_back(page->index());
        plan.missing_hidden += page->wanted.shows ? 0 : 1;
    }
    plan.pages_beyond_frustum = beyond_frustum_;
    plan.pages_beyond_horizon = beyond_horizon_;
}

void PageChoice::set_neighbours(KeptPage& page, gpu::FramePage& frame) const {
    constexpr int side = static_cast<int>(gpu::meshlets_per_side);
    const PageIndex& index = page.index();
    frame.quarter = static_cast<gpu::uint>(2 * (index.row % 2) + index.column % 2);
    frame.parent = number_of(memory_.parent(page));
    for (std::size_t i = 0; i < 4; ++i) {
        frame.neighbours[i] = number_of(memory_.beside(page, i));
        frame.children[i] = number_of(page.children[i]);
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

// Matrices, planes and directions; whether the frustum may hide some of it.
void PageChoice::set_place(const KeptPage& page, gpu::FramePage& frame) const {
    const PageSummary& summary = page.record.summary;
    const glm::dmat3 view_from_page = view_from_ecef_ * summary.ecef_from_page;
    const glm::dmat3 page_from_view = glm::transpose(view_from_page);
    const glm::dvec3 origin_view = model_.origin_m(summary);
    const ModelView::SeenAt seen = model_.culls_nodes()
                                       ? model_.seen_at(page.centre_ecef_m, summary.radius_m)
                                       : model_.seen_at(summary, summary.centre_m, summary.radius_m);
    frame.view_from_page = gpu::mat3(view_from_page);
    frame.origin_view = gpu::vec3(origin_view);
    bool inside_all = true;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
        const glm::dvec3 normal(planes_[i]);
        const Plane for_nodes = model_.plane_for_nodes(planes_[i], seen.across_m, summary.radius_m);
        frame.planes[i] = gpu::vec4(gpu::vec3(page_from_view * normal),
                                    static_cast<float>(glm::dot(normal, origin_view) + for_nodes.w));
        inside_all =
            inside_all && glm::dot(normal, seen.sphere.centre_m) + planes_[i].w > seen.sphere.radius_m;
    }
    frame.horizon_direction = gpu::vec3(horizon_.eye.direction - summary.horizon.direction);
    if (inside_all) frame.cull &= ~gpu::cull_by_frustum;
}

void PageChoice::set_frame_page(KeptPage& page, bool by_device, gpu::FramePage& frame) const {
    const PageSummary& summary = page.record.summary;
    frame.cull =
        gpu::cull_by_frustum | (horizon_.eye.angle_rad < std::numbers::pi ? gpu::cull_by_horizon : 0U);
    if (!by_device) set_place(page, frame);
    // What closes gaps reaches out of its bounds; what lies between grids has no horizons.
    const bool is_skirt = pages_.is_skirt(summary.index);
    if (!model_.culls_nodes() || is_skirt) frame.cull = 0;
    if (!pages_.has_posts()) frame.cull &= ~gpu::cull_by_horizon;
    if (is_skirt) frame.cull |= gpu::is_skirt;
    if (pages_.facts().grid.net && pages_.has_posts() && reaches_far(summary))
        frame.cull |= gpu::places_from_plane;
    if (!model_.may_stand(page.record)) frame.cull |= gpu::never_coarsen;
    if (model_.culls_nodes() && !is_skirt) frame.cull |= gpu::cull_by_occlusion;
    const std::uint64_t address = page.wanted.address;
    frame.block = {static_cast<gpu::uint>(address), static_cast<gpu::uint>(address >> 32U)};
    frame.level = static_cast<gpu::uint>(summary.index.level);
    if (pages_.facts().grid.net) set_from_eye(summary, frame);
    frame.fallback_quarters = page.wanted.fallback_quarters;
    set_neighbours(page, frame);
}

PlanSources* PageChoice::sources(const Geodetic& eye) const {
    return sources_for(memory_, model_, eye);
}

void PageChoice::list_pages(FrameTables& tables, PlanSources* sources, GridPlan& plan) const {
    if (sources != nullptr) tables.leave_to(*sources);
    plan.pages.resize(memory_.planned.size());
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        KeptPage& page = *memory_.planned[i];
        set_frame_page(page, sources != nullptr, plan.pages[i]);
        tables.place(page.index(), plan.pages[i]);
    }
    if (sources != nullptr) leave_to_device(tables, *sources, plan);
}

void PageChoice::leave_to_device(const FrameTables& tables, PlanSources& sources, GridPlan& plan) const {
    plan.device.on = true;
    gpu::PlanTerms& terms = plan.device.terms;
    tables.set_eye(terms);
    terms.page_count = static_cast<gpu::uint>(plan.pages.size());
    set_view(terms, view_from_ecef_, eye_ecef_, horizon_, planes_);
    std::vector<gpu::uint>& numbers = plan.device.numbers;
    numbers.reserve(tables.row_sources().size() + tables.column_sources().size() + plan.pages.size());
    numbers.insert(numbers.end(), tables.row_sources().begin(), tables.row_sources().end());
    numbers.insert(numbers.end(), tables.column_sources().begin(), tables.column_sources().end());
    for (const KeptPage* const page : memory_.planned)
        numbers.push_back(sources.page(page->record.summary, page->centre_ecef_m));
}

}  // namespace

Result<GridPlan> plan_grid(PlanMemory& memory, const Residency& residency, const FrameView& view,
                           const HeightQuantization& coding, double shading_spacing_px,
                           const IsHidden& is_hidden) {
    const auto& [camera, tile, tau_px, model] = view;
    const RegionPages& pages = memory.pages();
    const ModelView model_view(camera, model, coding);
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
    choice.list_pages(tables, choice.sources(camera.eye), plan);
    plan.row_terms = tables.take_rows();
    plan.column_terms = tables.take_columns();
    plan.constants = frame_constants(pages, camera, tile, tau_px, model, coding);
    plan.constants.page_count = static_cast<gpu::uint>(plan.pages.size());
    plan.constants.placing_slack_m = static_cast<float>(model_view.rounding_m()) * 1.001F;
    return plan;
}

std::optional<GridPlan> plan_without_pages(PlanMemory& memory, const FrameView& view,
                                           const HeightQuantization& coding) {
    const auto& [camera, tile, tau_px, model] = view;
    const ModelView model_view(camera, model, coding);
    PlanSources* const sources = sources_for(memory, model_view, camera.eye);
    if (sources == nullptr) return std::nullopt;
    const RegionPages& pages = memory.pages();
    FrameTables tables(pages.facts().grid, camera.eye, model.earth, &memory.angles());
    tables.leave_to(*sources);
    GridPlan plan;
    tables.set_eye(plan.device.terms);
    std::array<Plane, 5> planes = frustum_planes_view(projection_of_tile(camera, tile));
    for (Plane& plane : planes) plane.w += model_view.rounding_m();
    set_view(plan.device.terms, camera.view_from_ecef(), camera.eye_ecef(),
             model_view.horizon(pages.facts().shape.occluder), planes);
    plan.constants = frame_constants(pages, camera, tile, tau_px, model, coding);
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
