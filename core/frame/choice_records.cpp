#include "core/frame/choice_records.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "core/frame/shared_axes.h"
#include "core/lod/levels.h"

namespace oro {
namespace {

constexpr double unit_slack = 1.0e-6;  // of beyond_horizon() (core/earth/culling.cpp)

gpu::ChoicePage record_of(const PageRecord& page, const PageNumbers& numbers, bool is_skirt) {
    const PageSummary& summary = page.summary;
    const PageIndex& index = summary.index;
    const auto ecef_m = [&](const glm::dvec3& in_page_m) {
        return summary.origin_ecef.m + summary.ecef_from_page * in_page_m;
    };
    const auto number_of = [&](const PageIndex& other) {
        return numbers.contains(other) ? numbers.of(other) : gpu::no_page;
    };
    gpu::ChoicePage record{};
    put_axes(ecef_m(summary.centre_m), record.centre_ecef);
    record.reach_m = page.reach_m;
    put_axes(page.horizon.direction, record.horizon);
    record.horizon_angle_rad = page.horizon.angle_rad;
    record.row = static_cast<gpu::uint>(index.row);
    record.column = static_cast<gpu::uint>(index.column);
    record.row_source = numbers.row(index);
    record.column_source = numbers.column(index);
    const double square = glm::dot(page.horizon.direction, page.horizon.direction);
    record.traits = static_cast<gpu::uint>(index.level) |
                    (std::abs(square - 1.0) < unit_slack ? gpu::choice_unit_cone : 0U) |
                    (is_skirt ? gpu::choice_skirt : 0U);
    record.parent = number_of({index.row / 2, index.column / 2, index.level + 1});
    constexpr std::array<std::pair<int, int>, 4> steps{{{-1, 0}, {0, 1}, {1, 0}, {0, -1}}};
    for (std::size_t i = 0; i < 4; ++i) {
        const PageQuarter& quarter = page.quarters[i];
        put_axes(ecef_m(quarter.centre_m), record.quarters[i].centre_ecef);
        record.quarters[i].lod_radius_m = quarter.lod_radius_m;
        record.errors_m[i] = quarter.largest_error_m;
        const PageIndex beyond{index.row + steps[i].first, index.column + steps[i].second, index.level};
        record.beside[i] = numbers.contains(beyond)
                               ? number_of({beyond.row / 2, beyond.column / 2, index.level + 1})
                               : gpu::no_page;
        const int number = static_cast<int>(i);
        record.children[i] =
            number_of({2 * index.row + number / 2, 2 * index.column + number % 2, index.level - 1});
    }
    return record;
}

}  // namespace

bool can_choose_on_device(const RegionPages& pages, std::uint64_t most_bytes) {
    if (pages.facts().grid.net || pages.wraps_longitude()) return false;
    if (pages.levels() > static_cast<int>(std::size(gpu::ChoiceTerms{}.spacing_px_m))) return false;
    if (pages.bound({0, 0, pages.levels() - 1})) return false;
    std::uint64_t bytes = 0;
    for (int level = 0; level < pages.levels(); ++level) {
        const PageLayout layout = pages.layout(level);
        bytes += layout.count() * sizeof(gpu::ChoicePage);
        if (bytes > most_bytes) return false;
    }
    return true;
}

Result<void> fill_choice_records(const RegionPages& pages, const PageNumbers& numbers,
                                 std::span<gpu::ChoicePage> records) {
    assert(records.size() >= numbers.page_count());
    for (std::uint32_t number = 0; number < numbers.page_count(); ++number) {
        const PageIndex index = numbers.page(number);
        ORO_TRY(const PageRecord record, pages.record(index));
        records[number] = record_of(record, numbers, pages.is_skirt(index));
    }
    return {};
}

gpu::ChoiceTerms choice_terms(const RegionPages& pages, const PageNumbers& numbers, const FrameView& view,
                              const ModelView& model, double shading_spacing_px) {
    assert(model.culls_nodes() && model.curvature_per_m() == 0.0);
    const LevelView levels = level_view(view.camera, view.tau_px);
    const SeenHorizon horizon = model.horizon(pages.facts().shape.occluder);
    const glm::dmat3 view_from_ecef = view.camera.view_from_ecef();
    gpu::ChoiceTerms terms{};
    for (int column = 0; column < 3; ++column)
        put_axes(view_from_ecef[column], terms.view_from_ecef, 3 * static_cast<std::size_t>(column));
    put_axes(view.camera.eye_ecef().m, terms.eye_ecef);
    std::size_t at = 0;
    for (Plane plane : frustum_planes_view(projection_of_tile(view.camera, view.tile))) {
        plane.w += model.rounding_m();
        for (int axis = 0; axis < 4; ++axis) terms.planes[at++] = plane[axis];
    }
    put_axes(horizon.eye.direction, terms.horizon);
    terms.horizon_angle_rad = horizon.eye.angle_rad;
    if (!pages.has_posts())
        terms.gap_reach = 2.0 * std::max(levels.tau_px, gpu::least_gap_px) / levels.pixels_per_tangent;
    const auto corner = static_cast<double>(levels.corner_tangent);
    terms.corner_stretch = std::sqrt(1.0 + corner * corner);
    terms.shading_spacing_px = shading_spacing_px;
    const double post_spacing_m = wgs84_a_m * pages.facts().grid.row_step_rad();
    for (int level = 0; level < pages.levels(); ++level)
        terms.spacing_px_m[level] =
            std::ldexp(post_spacing_m, level) * static_cast<double>(levels.pixels_per_tangent);
    terms.pixels_per_tangent = levels.pixels_per_tangent;
    terms.corner_tangent = levels.corner_tangent;
    terms.tau_px = levels.tau_px;
    if (pages.has_posts())
        terms.cull = gpu::cull_by_frustum | gpu::cull_by_occlusion |
                     (horizon.eye.angle_rad < std::numbers::pi ? gpu::cull_by_horizon : 0U);
    terms.page_count = numbers.page_count();
    terms.level_count = static_cast<gpu::uint>(pages.levels());
    terms.row_source_count = numbers.row_count();
    terms.column_source_count = numbers.column_count();
    return terms;
}

}  // namespace oro
