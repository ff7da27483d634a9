#include "core/frame/casters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <set>

#include "core/earth/model_view.h"
#include "core/frame/frame_plan.h"
#include "core/lod/levels.h"
#include "core/lod/levels_gpu.h"

namespace oro {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double sun_radius_rad = 0.00465;
constexpr int cells_max = 128;  // along a side of the map of what is shaded

// Cells of pages of one level over the region: what the lines from all that is seen towards the sun need.
class CastMap {
  public:
    struct Need {
        double error_m{infinite};  // that casters there may have
        double low_m{infinite};    // nothing below this height matters
    };
    struct Receiver {
        int row, column;
        double error_per_slope_m;
        double lowest_m;
    };

    CastMap(const RegionPages& pages, const glm::dvec3& sun_ecef, double top_m)
        : grid_(pages.facts().grid), sun_ecef_(sun_ecef), top_m_(top_m) {
        while (level_ + 1 < pages.levels() &&
               std::max(pages.layout(level_).rows, pages.layout(level_).columns) > cells_max)
            ++level_;
        layout_ = pages.layout(level_);
        needs_.resize(static_cast<std::size_t>(layout_.rows) * static_cast<std::size_t>(layout_.columns));
        posts_ = std::int64_t{gpu::page_quads} << level_;
        receivers_.resize(needs_.size(), {infinite, infinite});
    }

    // The cells [first, last) of a page's quarter or of a page.
    struct Patch {
        int north, south, west, east;
    };
    [[nodiscard]] Patch patch(std::int64_t row, std::int64_t column, std::int64_t posts) const {
        const auto clamped = [](std::int64_t cell, int count) {
            return static_cast<int>(std::clamp<std::int64_t>(cell, 0, count - 1));
        };
        return {clamped(row / posts_, layout_.rows), clamped((row + posts - 1) / posts_, layout_.rows),
                clamped(column / posts_, layout_.columns),
                clamped((column + posts - 1) / posts_, layout_.columns)};
    }
    void receive(const Patch& patch, double error_per_slope_m, double lowest_m) {
        for (int row = patch.north; row <= patch.south; ++row)
            for (int column = patch.west; column <= patch.east; ++column) {
                Need& need = receivers_[place(row, column)];
                need.error_m = std::min(need.error_m, error_per_slope_m);
                need.low_m = std::min(need.low_m, lowest_m);
            }
    }
    void cast() {
        for (int row = 0; row < layout_.rows; ++row)
            for (int column = 0; column < layout_.columns; ++column)
                if (receivers_[place(row, column)].low_m < infinite) cast_from(row, column);
    }
    [[nodiscard]] Need need(const Patch& patch) const {
        Need all;
        for (int row = patch.north; row <= patch.south; ++row)
            for (int column = patch.west; column <= patch.east; ++column) {
                all.error_m = std::min(all.error_m, needs_[place(row, column)].error_m);
                all.low_m = std::min(all.low_m, needs_[place(row, column)].low_m);
            }
        return all;
    }

  private:
    [[nodiscard]] std::size_t place(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(layout_.columns) +
               static_cast<std::size_t>(column);
    }
    // How the posts lie around one of them.
    struct CellLie {
        PostPlace place;
        double row_m, column_m;  // from one to the next
        SineCosine turn;         // of rows, from east towards north
        double bend;  // how far a line strays from a straight one among them, of a great circle's stray
    };
    [[nodiscard]] CellLie lie_of_cell(std::int64_t row, std::int64_t column) const;
    void cast_from(int row, int column);
    void mark(double north, double south, double west, double east, const Need& need);

    const PostGrid& grid_;
    glm::dvec3 sun_ecef_;
    double top_m_;
    int level_{0};
    PageLayout layout_;
    std::int64_t posts_{};  // along a cell
    std::vector<Need> needs_, receivers_;
};

void CastMap::mark(double north, double south, double west, double east, const Need& need) {
    const auto clamped = [](double cell, int count) {
        return static_cast<int>(std::clamp(std::floor(cell), 0.0, static_cast<double>(count - 1)));
    };
    if (south < 0.0 || east < 0.0 || north >= layout_.rows || west >= layout_.columns) return;
    for (int row = clamped(north, layout_.rows); row <= clamped(south, layout_.rows); ++row)
        for (int column = clamped(west, layout_.columns); column <= clamped(east, layout_.columns);
             ++column) {
            Need& there = needs_[place(row, column)];
            there.error_m = std::min(there.error_m, need.error_m);
            there.low_m = std::min(there.low_m, need.low_m);
        }
}

CastMap::CellLie CastMap::lie_of_cell(std::int64_t row, std::int64_t column) const {
    if (grid_.net) {
        const auto y = static_cast<double>(row), x = static_cast<double>(column);
        const GridNet::Lie lie = grid_.net->lie_at(y, x);
        return {grid_.net->place_at(y, x), lie.row_m, lie.column_m,
                sine_cosine_deg(deg_from_radians(Radians(lie.turn_rad))), 1.0 + grid_.net->bend()};
    }
    const double lat_deg = row_lat_deg(grid_, row);
    return {{lat_deg, grid_.lon.at_deg(column)},
            meridian_radius_m(lat_deg) * grid_.row_step_rad(),
            prime_vertical_radius_m(lat_deg) * sine_cosine_deg(lat_deg).cosine * grid_.column_step_rad(),
            {0.0, 1.0},
            1.0 + std::abs(std::tan(radians_from_deg(lat_deg).rad))};
}

// Moves a cell towards the sun, half a cell at a time, until it is above all terrain.
void CastMap::cast_from(int row, int column) {
    const Need& receiver = receivers_[place(row, column)];
    const auto posts = static_cast<double>(posts_);
    const std::int64_t at_post_row = std::min<std::int64_t>(row * posts_ + posts_ / 2, grid_.rows() - 1);
    const std::int64_t at_post_column =
        std::min<std::int64_t>(column * posts_ + posts_ / 2, grid_.columns() - 1);
    const CellLie lie = lie_of_cell(at_post_row, at_post_column);
    const glm::dvec3 sun = glm::transpose(ecef_from_enu(lie.place.lat_deg, lie.place.lon_deg)) * sun_ecef_;
    const double row_m = posts * lie.row_m, column_m = std::max(1.0, posts * lie.column_m);
    const double half_rad =
        0.5 * std::hypot(row_m, column_m) / mean_radius_m;  // the sun's rise differs over the cell
    const double level = std::max(std::hypot(sun.x, sun.y), 1e-6);
    const double rise = std::atan2(sun.z, level) - half_rad;
    const Need need{receiver.error_m * std::clamp(std::tan(rise), 0.02, 1.0), receiver.low_m};
    const double lowest = std::tan(std::clamp(rise - 1.1 * sun_radius_rad, -1.5, 1.5));
    const double step_m = 0.5 * std::min(row_m, column_m);
    // Cells a metre.
    const double south = (sun.x * lie.turn.sine - sun.y * lie.turn.cosine) / level / row_m;
    const double east = (sun.x * lie.turn.cosine + sun.y * lie.turn.sine) / level / column_m;
    double low_m = receiver.low_m;
    for (double from_m = 0.0; low_m <= top_m_ || from_m * lowest < 0.0; from_m += step_m) {
        const double to_m = from_m + step_m;
        // Towards the pole's side the line bends, and the sun's direction differs over the cell.
        const double aside_m = to_m * (half_rad + to_m / (2.0 * mean_radius_m)) * lie.bend;
        const double rows = aside_m / row_m + 0.01, columns = aside_m / column_m + 0.01;
        const double sag_m = from_m * from_m / (2.0 * mean_radius_m);
        low_m = receiver.low_m + std::min(from_m * lowest, to_m * lowest) + 0.99 * sag_m;
        if (to_m > 1.2e6) break;
        mark(row + std::min(from_m * south, to_m * south) - rows,
             row + 1.0 + std::max(from_m * south, to_m * south) + rows,
             column + std::min(from_m * east, to_m * east) - columns,
             column + 1.0 + std::max(from_m * east, to_m * east) + columns, {need.error_m, low_m});
        const double at_row = row + 0.5 + from_m * south, at_column = column + 0.5 + from_m * east;
        if (at_row < -1.0 - rows || at_row > layout_.rows + 1.0 + rows || at_column < -1.0 - columns ||
            at_column > layout_.columns + 1.0 + columns)
            break;
    }
}

// Collects the pages.
class CasterChoice {
  public:
    CasterChoice(const RegionPages& pages, const std::function<std::uint64_t(const PageIndex&)>& residency)
        : pages_(pages), residency_(residency) {}

    // A page and what a map of lines needs below it.
    Result<void> want(const CastMap& map, const PageIndex& index);
    // Pages beside those of a plan; theirs above are among them.
    Result<void> want_around(const FramePlan& plan);
    void list(FramePlan& plan) const;

  private:
    const RegionPages& pages_;
    const std::function<std::uint64_t(const PageIndex&)>& residency_;
    std::set<std::array<int, 3>> asked_;
    std::vector<std::pair<PageIndex, std::uint64_t>> wanted_;
};

Result<void> CasterChoice::want_around(const FramePlan& plan) {
    for (const PageIndex& page : plan.page_indices) {
        const PageLayout layout = pages_.layout(page.level);
        for (int row = std::max(0, page.row - 1); row <= std::min(layout.rows - 1, page.row + 1); ++row)
            for (int column = std::max(0, page.column - 1);
                 column <= std::min(layout.columns - 1, page.column + 1); ++column) {
                const PageIndex beside{row, column, page.level};
                if (!asked_.insert({page.level, row, column}).second) continue;
                ORO_TRY(const PageRecord record, pages_.record(beside));
                if (record.reach_m >= 0.0) wanted_.emplace_back(beside, residency_(beside));
            }
    }
    return {};
}

Result<void> CasterChoice::want(const CastMap& map, const PageIndex& index) {
    asked_.insert({index.level, index.row, index.column});
    ORO_TRY(const PageRecord record, pages_.record(index));
    if (record.reach_m < 0.0) return {};
    wanted_.emplace_back(index, residency_(index));
    if (index.level == 0) return {};
    const PageLayout below = pages_.layout(index.level - 1);
    for (int i = 0; i < 4; ++i) {
        const PageIndex child{2 * index.row + i / 2, 2 * index.column + i % 2, index.level - 1};
        if (child.row >= below.rows || child.column >= below.columns) continue;
        const std::int64_t posts = std::int64_t{gpu::page_quads} << child.level;
        const CastMap::Need need = map.need(map.patch(child.row * posts, child.column * posts, posts));
        const auto error_m =
            static_cast<double>(record.quarters[static_cast<std::size_t>(i)].largest_error_m);
        const double top_m = record.summary.highest_h_m + error_m + 1.0;
        if (error_m > need.error_m && top_m >= need.low_m) ORO_CHECK(want(map, child));
    }
    return {};
}

void CasterChoice::list(FramePlan& plan) const {
    CasterPlan& casters = plan.casters;
    std::vector<PageIndex> low(static_cast<std::size_t>(pages_.levels()),
                               {std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 0});
    std::vector<PageIndex> high(low.size(), {-1, -1, 0});
    std::map<std::array<int, 3>, gpu::uint> numbers;
    const auto add = [&](const PageIndex& index, const gpu::uvec2& block) {
        const auto number = static_cast<gpu::uint>(casters.pages.size());
        if (!numbers.try_emplace({index.level, index.row, index.column}, number).second) return;
        casters.pages.push_back({block, static_cast<gpu::uint>(index.level),
                                 static_cast<gpu::uint>(index.row), static_cast<gpu::uint>(index.column)});
        const auto level = static_cast<std::size_t>(index.level);
        low[level].row = std::min(low[level].row, index.row);
        low[level].column = std::min(low[level].column, index.column);
        high[level].row = std::max(high[level].row, index.row);
        high[level].column = std::max(high[level].column, index.column);
    };
    for (std::size_t i = 0; i < plan.pages.size(); ++i) add(plan.page_indices[i], plan.pages[i].block);
    for (const auto& [index, address] : wanted_) {
        if (address != 0)
            add(index, {static_cast<gpu::uint>(address), static_cast<gpu::uint>(address >> 32U)});
        else if (std::ranges::none_of(plan.missing, [&, &index = index](const PageIndex& there) {
                     return there.level == index.level && there.row == index.row &&
                            there.column == index.column;
                 }))
            plan.missing.push_back(index);
    }
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
    for (const auto& [key, number] : numbers) {
        const gpu::CasterLevel& held = casters.frame.levels[static_cast<std::size_t>(key[0])];
        casters.table[held.first + (static_cast<gpu::uint>(key[1]) - held.first_row) * held.columns +
                      static_cast<gpu::uint>(key[2]) - held.first_column] = number;
    }
    casters.frame.page_count = static_cast<gpu::uint>(casters.pages.size());
}

// What of a plan is seen, and so may be shaded.
Result<void> receive_plan(const RegionPages& pages, const Camera& camera, const Tile& tile,
                          double error_per_m, const FramePlan& plan, CastMap& map) {
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const glm::dvec3 eye = camera.eye_ecef().m;
    const auto planes = frustum_planes_view(projection_of_tile(camera, tile));
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        const gpu::FramePage& page = plan.pages[i];
        const PageIndex& index = plan.page_indices[i];
        ORO_TRY(const PageRecord record, pages.record(index));
        const std::int64_t half = std::int64_t{gpu::page_quads / 2} << index.level;
        for (int quarter = 0; quarter < 4; ++quarter) {
            if (page.children[quarter] != gpu::no_page) continue;
            if (index.level > 0 && (page.stand_in >> static_cast<unsigned>(quarter) & 1U) == 0) continue;
            const PageQuarter& part = record.quarters[static_cast<std::size_t>(quarter)];
            if (part.lod_radius_m < 0.0) continue;
            const glm::dvec3 centre = view_from_ecef * (record.summary.origin_ecef.m +
                                                        record.summary.ecef_from_page * part.centre_m - eye);
            const double lift_m =
                0.1 * glm::dot(centre, centre) / mean_radius_m;  // light that bends shows it higher
            if (beyond_frustum(planes, centre, part.lod_radius_m + lift_m)) continue;
            const double distance_m =
                std::max(0.5, 0.999 * (glm::length(centre) - part.lod_radius_m - lift_m));
            const double error_m =
                index.level == 0 ? 0.0 : std::min(1.0e4, static_cast<double>(part.largest_error_m));
            map.receive(map.patch(2 * index.row * half + quarter / 2 * half,
                                  2 * index.column * half + quarter % 2 * half, half),
                        error_per_m * distance_m, record.summary.lowest_h_m - error_m);
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

CastRequest cast_request(const gpu::FrameStyle& style) {
    constexpr double lowest = -0.1;  // sine: even mountains seen from there lie in the Earth's own shadow
    const bool dark = style.air.on == 0 && style.sun_hidden >= 1.0F;
    CastRequest request;
    request.sky_openness = style.sky_openness != 0;
    if (style.shadows != 0 && !dark && style.sun_enu.z >= lowest)
        request.sun_enu = glm::normalize(glm::dvec3(style.sun_enu));
    return request;
}

Result<double> region_top_m(const RegionPages& pages) {
    const int top = pages.levels() - 1;
    if (pages.layout(top).count() == 0) return 0.0;
    ORO_TRY(const double top_m, top_of(pages, {0, 0, top}));
    return std::max(top_m, -1.0e5) + 1.0;
}

Result<void> plan_casters(const RegionPages& pages,
                          const std::function<std::uint64_t(const PageIndex&)>& residency,
                          const Camera& camera, const Tile& tile, const CastRequest& request, double top_m,
                          FramePlan& plan) {
    const int top = pages.levels() - 1;
    if (plan.pages.empty() || pages.layout(top).count() == 0) return {};
    const RegionFacts& facts = pages.facts();
    const double error_per_m = caster_error_px / static_cast<double>(plan.constants.pixels_per_tangent);
    CasterChoice choice(pages, residency);
    if (request.sun_enu) {
        CastMap map(pages, ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg) * *request.sun_enu, top_m);
        ORO_CHECK(receive_plan(pages, camera, tile, error_per_m, plan, map));
        map.cast();
        ORO_CHECK(choice.want(map, {0, 0, top}));
    }
    if (request.sky_openness) ORO_CHECK(choice.want_around(plan));
    choice.list(plan);
    plan.casters.for_shadows = request.sun_enu.has_value();
    plan.casters.for_openness = request.sky_openness;
    gpu::Casters& frame = plan.casters.frame;
    frame.level_count = static_cast<gpu::uint>(pages.levels());
    frame.row_rad = static_cast<float>(facts.grid.row_step_rad());
    frame.column_rad = static_cast<float>(facts.grid.column_step_rad());
    frame.top_m = static_cast<float>(top_m);
    frame.error_per_m = static_cast<float>(error_per_m);
    return {};
}

}  // namespace oro
