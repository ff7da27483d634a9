#include "geo/canopy/raised_region.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "core/baked/file_pages.h"
#include "core/base/parallel.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/triangle_heights.h"
#include "geo/canopy/canopy_of_posts.h"
#include "geo/files/letter_case.h"
#include "geo/sources/known_products.h"

namespace oro {
namespace {

// Loads the posts of a baked grid into memory, where they can be changed.
Result<void> load_into_memory(RegionGrid& grid) {
    HeightField& field = grid.field;
    if (field.posts) {
        if (!grid.file)
            return Error{ErrorKind::usage, "--canopy",
                         "raises all posts, and these are made where they are looked at; narrow the region "
                         "with --bbox"};
        ORO_TRY(HeightField in_memory, field_in_memory(*grid.file));
        field.H_m = std::move(in_memory.H_m);
        field.posts.reset();
        if (!field.undulation.N_m.empty()) field.N_of_posts_m = std::move(in_memory.N_of_posts_m);
    }
    field.range.reset();
    grid.file.reset();
    grid.clusters.reset();
    return {};
}

struct RowCounts {
    float highest_m{};
    std::uint64_t raised{}, unknown{}, known{};
};

Result<RowCounts> raise_row(RegionGrid& grid, int row, const CanopyMap& canopy) {
    const auto columns = static_cast<std::size_t>(grid.field.grid.columns());
    std::vector<float> canopy_m(columns);
    ORO_CHECK(canopy_of_row(grid.field.grid, row, canopy, canopy_m));
    const float not_held = static_cast<float>(1.0 - grid.canopy->held_share);
    RowCounts counts;
    for (std::size_t i = 0; i < columns; ++i) {
        const std::size_t post = static_cast<std::size_t>(row) * columns + i;
        float& H_m = grid.field.H_m[post];
        if (is_void(H_m)) continue;
        counts.unknown += std::isnan(canopy_m[i]) ? 1 : 0;
        if (std::isnan(canopy_m[i])) continue;
        ++counts.known;
        const float added_m = not_held * canopy_m[i];
        if (!(added_m > 0.0F)) continue;
        ++counts.raised;
        counts.highest_m = std::max(counts.highest_m, canopy_m[i]);
        H_m += added_m;
        grid.canopy->added_m[post] = added_m;
    }
    return counts;
}

// How many posts there are whose canopy is known.
Result<std::uint64_t> raise_grid(RegionGrid& grid, const CanopyMap& canopy) {
    GridCanopy& made = *grid.canopy;
    made.added_m.assign(grid.field.H_m.size(), 0.0F);
    made.ground_H_m = grid.field.H_m;
    std::mutex together;
    Result<void> first_fault;
    std::uint64_t known = 0;
    in_parallel(grid.field.grid.rows(), thread_count(), [&](int row) {
        {
            const std::scoped_lock lock(together);
            if (!first_fault.ok()) return;
        }
        const Result<RowCounts> counts = raise_row(grid, row, canopy);
        const std::scoped_lock lock(together);
        if (!counts.ok()) {
            if (first_fault.ok()) first_fault = counts.error();
            return;
        }
        made.highest_m = std::max(made.highest_m, counts->highest_m);
        made.posts += counts->raised;
        made.unknown += counts->unknown;
        known += counts->known;
    });
    ORO_CHECK(first_fault);
    return known;
}

std::string file_of(const CanopyMap& canopy) {
    return canopy.cover() ? canopy.cover()->sources().front().file : canopy.sources().front().file;
}

}  // namespace

HeldCanopy held_by_sources(const RegionGrid& grid) {
    for (const SourceReport& source : grid.sources) {
        const std::size_t folder = source.path.find_last_of('/');
        const auto known = known_file(source.path.substr(folder == std::string::npos ? 0 : folder + 1));
        const bool of_srtm =
            known ? known->product.find("SRTM") != std::string_view::npos || known->product == "NASADEM"
                  : source.format != SourceFormat::raster;
        if (of_srtm) return {srtm_held_share, "SRTM"};
    }
    return {};
}

Result<void> raise_by_canopy(Region& region, const CanopyMap& canopy, const std::optional<double>& held) {
    std::uint64_t known = 0;
    for (RegionGrid& grid : region.grids) {
        assert(!grid.canopy);
        ORO_CHECK(load_into_memory(grid));
        const HeldCanopy by_sources = held_by_sources(grid);
        grid.canopy.emplace();
        grid.canopy->held_share = held.value_or(by_sources.share);
        if (!held) grid.canopy->held_by = by_sources.by;
        ORO_TRY(const std::uint64_t of_grid, raise_grid(grid, canopy));
        known += of_grid;
    }
    if (known == 0)
        return Error{ErrorKind::no_data, file_of(canopy),
                     "holds no canopy over the elevation data: it lies elsewhere, or has no data there"};
    return {};
}

Region ground_of_raised(const Region& raised) {
    Region ground = raised;
    for (RegionGrid& grid : ground.grids) {
        if (!grid.canopy) continue;
        grid.field.H_m = std::move(grid.canopy->ground_H_m);
        grid.canopy.reset();
    }
    return ground;
}

std::optional<double> canopy_over_ground_m(const RegionGrid& grid, double lat_deg, double lon_deg) {
    if (!grid.canopy) return std::nullopt;
    const HeightField& field = grid.field;
    bool any = false;
    const auto added_m = [&](int row, int column) -> std::optional<double> {
        if (is_void(field.H_at_post_m(row, column))) return std::nullopt;
        const float post_m =
            grid.canopy
                ->added_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.grid.columns()) +
                          static_cast<std::size_t>(column)];
        any = any || post_m > 0.0F;
        return post_m;
    };
    const auto diagonal_at = [&](int row, int column) { return cell_diagonal(field, row, column); };
    const std::optional<double> over_m = h_on_grid_m(field.grid, added_m, diagonal_at, lat_deg, lon_deg);
    return any ? over_m : std::nullopt;
}

}  // namespace oro
