#include "apps/window/source_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "apps/report/figures.h"
#include "core/base/parallel.h"

namespace oro {
namespace {

// Of a tint: at 12 bytes each they take 2.4 GB.
constexpr std::size_t most_posts_of_tint = 200'000'000;

double closest_posts_rad(const PostGrid& grid) {
    return std::min(grid.row_step_rad(), grid.column_step_rad());
}

// H of a region's ground: of several grids that of the smallest rank which has some there.
HeightAtPlace heights_of_ground(const Region& region) {
    std::vector<const RegionGrid*> grids;
    for (const RegionGrid& grid : region.grids) grids.push_back(&grid);
    std::ranges::stable_sort(grids, {}, &RegionGrid::rank);
    return [grids = std::move(grids)](double lat_deg, double lon_deg) -> std::optional<double> {
        for (const RegionGrid* const grid : grids)
            if (const auto H_m = H_at_place_m(grid->field, lat_deg, lon_deg)) return H_m;
        return std::nullopt;
    };
}

// The posts of a grid that any grid of the other region may have ground for.
GridPart part_within_any(const PostGrid& grid, const Region& other) {
    GridPart all;
    for (const RegionGrid& one : other.grids) {
        const GridPart part = part_within(grid, one.field.grid);
        if (part.count() == 0) continue;
        if (all.count() == 0) {
            all = part;
            continue;
        }
        const int last_row = std::max(all.first_row + all.rows, part.first_row + part.rows);
        const int last_column = std::max(all.first_column + all.columns, part.first_column + part.columns);
        all.first_row = std::min(all.first_row, part.first_row);
        all.first_column = std::min(all.first_column, part.first_column);
        all.rows = last_row - all.first_row;
        all.columns = last_column - all.first_column;
    }
    return all;
}

std::shared_ptr<const PostColours> colours_of_difference(const HeightDifference& found, const PostGrid& grid,
                                                         double limit_m) {
    constexpr double alpha = 0.65;
    PostColours colours;
    colours.grid = grid;
    // Of no region alone: places decide.
    colours.grid_number = std::numeric_limits<std::size_t>::max();
    colours.part = found.window;
    colours.rgba.reserve(found.difference_m.size());
    for (const float m : found.difference_m) {
        if (is_void(m)) {
            colours.rgba.push_back(0);
            continue;
        }
        const auto [red, green, blue] = ramp_colour(static_cast<double>(m), limit_m);
        colours.rgba.push_back(texel_of(red, green, blue, alpha));
    }
    return std::make_shared<const PostColours>(std::move(colours));
}

PostRaster raster_of_difference(const SourceDifference& difference, const RegionGrid& grid,
                                const NamedRegion& one, const NamedRegion& other) {
    const HeightDifference& found = difference.found;
    PostRaster raster;
    raster.grid = grid.field.grid;
    raster.crs = grid.posts_crs;
    raster.part = found.window;
    raster.no_value = void_height_m;
    raster.bands.push_back({difference.title + ", metres", found.difference_m});
    raster.tags.emplace_back("FIRST_SOURCE", one.name);
    raster.tags.emplace_back("SECOND_SOURCE", other.name);
    raster.tags.emplace_back("MEAN_M", all_digits(found.mean_m));
    raster.tags.emplace_back("RMS_M", all_digits(found.rms_m));
    raster.tags.emplace_back("LEAST_M", all_digits(found.least_m));
    raster.tags.emplace_back("GREATEST_M", all_digits(found.greatest_m));
    raster.tags.emplace_back("SOFTWARE", "orograph " OROGRAPH_VERSION);
    return raster;
}

}  // namespace

Result<SourceDifference> source_difference(const NamedRegion& one, const NamedRegion& other,
                                           const std::function<void(double share)>& tell_share,
                                           const std::stop_token& stop) {
    const std::string both = one.name + " and " + other.name;
    SourceDifference difference;
    difference.title = "H of " + one.name + " minus H of " + other.name;
    difference.is_of_second = closest_posts_rad(other.region.grids.front().field.grid) <
                              closest_posts_rad(one.region.grids.front().field.grid);
    const NamedRegion& finer = difference.is_of_second ? other : one;
    const NamedRegion& coarser = difference.is_of_second ? one : other;
    difference.posts = "posts of " + finer.name;
    const RegionGrid& grid = finer.region.grids.front();
    const GridPart part = part_within_any(grid.field.grid, coarser.region);
    if (part.count() > most_posts_of_tint)
        return Error{ErrorKind::failed, both,
                     "overlap in " + grouped(part.count()) +
                         " posts; differences of 200,000,000 at most are shown: open a part of them"};
    difference.found = height_difference(grid.field, part, heights_of_ground(coarser.region), thread_count(),
                                         tell_share, stop);
    if (stop.stop_requested()) return Error{ErrorKind::failed, "", "stopped"};
    ORO_CHECK(finer.region.health());
    ORO_CHECK(coarser.region.health());
    if (difference.found.posts == 0)
        return Error{ErrorKind::no_data, both, "have no place in common where both have heights"};
    if (difference.is_of_second) negate(difference.found);
    difference.limit_m = ramp_limit_m(difference.found.rms_m);
    difference.raster = raster_of_difference(difference, grid, one, other);
    difference.colours = colours_of_difference(difference.found, grid.field.grid, difference.limit_m);
    // The raster and the colours hold them from now on.
    difference.found.difference_m = {};
    return difference;
}

double ramp_limit_m(double rms_m) {
    constexpr double least_m = 0.1;
    const double wanted_m = std::max(2.0 * rms_m, least_m);
    const double power = std::pow(10.0, std::floor(std::log10(wanted_m) + 1e-12));
    for (const double step : {1.0, 2.0, 5.0})
        if (wanted_m <= step * power * (1.0 + 1e-12)) return step * power;
    return 10.0 * power;
}

std::array<std::uint8_t, 3> ramp_colour(double difference_m, double limit_m) {
    constexpr std::array<double, 3> low{33.0, 102.0, 172.0}, middle{247.0, 247.0, 247.0},
        high{178.0, 24.0, 43.0};
    const double share = std::clamp(difference_m / limit_m, -1.0, 1.0);
    const std::array<double, 3>& end = share < 0.0 ? low : high;
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] =
            static_cast<std::uint8_t>(std::lround(middle[c] + std::abs(share) * (end[c] - middle[c])));
    return colour;
}

}  // namespace oro
