#include "geo/region/region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <set>

#include "geo/datum/vertical_datum.h"
#include "geo/files/source_paths.h"
#include "geo/posts/holes.h"
#include "geo/posts/seams.h"
#include "geo/posts/source_sampling.h"
#include "geo/posts/tiles_ahead.h"
#include "geo/posts/voids.h"
#include "geo/region/baked_region.h"
#include "geo/region/region_grid.h"
#include "geo/sources/hgt_source.h"
#include "geo/sources/library_faults.h"
#include "geo/sources/raster_library.h"
#include "geo/sources/raster_source.h"

namespace oro {
namespace {

constexpr std::size_t no_limit_notes = 8;

struct Found {
    std::vector<Source> sources;
    std::vector<std::string> notes;
    std::string first_skipped;
};

Result<Finding> look_at_file(const SourcePath& path, const std::string& height_unit) {
    if (!path.hgt) return inspect_raster(path, height_unit);
    ORO_TRY(Source tile, inspect_hgt(path));
    return Finding{std::move(tile), {}, {}};
}

// Looks at names, sizes and headers. What the user named must open; in folders and archives, rasters that are
// no elevation are passed over and noted, but a damaged file is an error wherever it lies (a hole in the
// terrain is no way to hear of it).
Result<Found> look_at(const RegionRequest& request, const Progress& progress) {
    ORO_TRY(const std::vector<SourcePath> paths, find_sources(request.paths));
    std::optional<BoundingBox> box;
    if (request.box) box = unwrapped(*request.box);
    Found found;
    std::size_t skipped = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const SourcePath& path = paths[i];
        if (progress && i % 64 == 0)
            progress(0.1 * static_cast<double>(i) / static_cast<double>(paths.size()),
                     "looking at " + path.shown);
        if (path.hgt && box) {
            ORO_TRY(const HgtName name, name_of_hgt(path));
            Source tile;
            tile.lon = {static_cast<double>(name.tile.lon_deg), name.tile.lon_deg + 1.0};
            tile.south_deg = name.tile.lat_deg;
            tile.north_deg = name.tile.lat_deg + 1.0;
            if (!meets(tile, *box)) continue;
        }
        ORO_TRY(Finding finding, look_at_file(path, request.height_unit));
        for (const std::string& doubt : finding.doubts) found.notes.push_back(doubt);
        if (finding.source) {
            found.sources.push_back(std::move(*finding.source));
            continue;
        }
        if (path.named) return finding.unfit;
        if (++skipped <= no_limit_notes) found.notes.push_back("passed over " + finding.unfit.line());
        if (found.first_skipped.empty()) found.first_skipped = finding.unfit.line();
    }
    if (skipped > no_limit_notes)
        found.notes.push_back("passed over " + std::to_string(skipped - no_limit_notes) +
                              " more files that hold no elevation");
    return found;
}

std::string text_of(const BoundingBox& box) {
    std::string text;
    for (const double angle : {box.west_deg, box.south_deg, box.east_deg, box.north_deg}) {
        std::string number = std::to_string(angle);
        number.erase(number.find_last_not_of('0') + 1);
        if (number.ends_with('.')) number.pop_back();
        text += (text.empty() ? "" : ",") + number;
    }
    return text;
}

std::string list_of(const std::vector<std::string>& paths) {
    std::string text;
    for (const std::string& path : paths) text += (text.empty() ? "" : ", ") + path;
    return text;
}

// Whole-degree cells that the region touches and no source does.
std::vector<std::string> cells_without(std::span<const Source> sources, const PostGrid& grid) {
    constexpr double line_deg = 1e-7;
    std::vector<std::string> missing;
    const auto first_lat = static_cast<int>(std::floor(grid.south_deg() + line_deg));
    const auto last_lat = static_cast<int>(std::ceil(grid.north_deg() - line_deg)) - 1;
    const auto first_lon = static_cast<int>(std::floor(grid.west_deg() + line_deg));
    const auto last_lon = static_cast<int>(std::ceil(grid.east_deg() - line_deg)) - 1;
    // What the sources cover, cell by cell; a source's box is all that is asked, whatever shape it has
    // inside.
    std::set<std::pair<int, int>> covered;
    for (const Source& source : sources) {
        const auto south = std::max(first_lat, static_cast<int>(std::floor(source.south_deg + line_deg)));
        const auto north = std::min(last_lat, static_cast<int>(std::ceil(source.north_deg - line_deg)) - 1);
        for (int lat = south; lat <= north; ++lat) {
            for (int lon = first_lon; lon <= last_lon; ++lon) {
                if (source.full_circle || !turns_that_meet(source.lon, lon, lon + 1.0).empty())
                    covered.insert({lat, lon});
            }
        }
    }
    for (int lat = first_lat; lat <= last_lat; ++lat) {
        for (int lon = first_lon; lon <= last_lon; ++lon) {
            if (!covered.contains({lat, lon}))
                missing.push_back(tile_name(lat, lon >= 180 ? lon - 360 : lon));
        }
    }
    return missing;
}

void add_note(std::vector<std::string>& notes, const std::string& note) {
    if (!note.empty() && std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
}

struct Reading {
    const PostGrid& grid;
    const UndulationField& undulation;
    JoinedSurface& surface;
    TilesAhead& ahead;
};

struct Laid {
    std::uint64_t lent{};  // void posts of finer sources that it filled
    Fit fit{Fit::elsewhere};
};

// Lays one source into the surface, at one whole turn, in strips that fit memory.
Result<Laid> lay_source(Source& source, int turn, GeoidOfRegion::Shift& shift, const Reading& to) {
    constexpr std::size_t posts_a_strip = std::size_t{1} << 26;
    std::optional<Result<SourceOnGrid>> begun = to.ahead.take(source, turn);
    const bool is_read = begun.has_value();
    ORO_TRY(SourceOnGrid placed, is_read ? std::move(*begun) : SourceOnGrid::create(source, to.grid, turn));
    const GridRect& rect = placed.rect();
    Laid laid{0, placed.fit()};
    if (rect.rows <= 0 || rect.columns <= 0) return laid;
    SourceReport& report = source.report;
    report.placement = placed.placement();
    const auto columns = static_cast<std::size_t>(rect.columns);
    const int strip = is_read ? rect.rows
                              : static_cast<int>(std::clamp<std::size_t>(
                                    posts_a_strip / columns, 1, static_cast<std::size_t>(rect.rows)));
    std::vector<float> heights(columns), beyond(columns);
    std::vector<unsigned char> inside(columns);
    std::vector<double> lon_deg(columns);
    for (std::size_t c = 0; c < columns; ++c)
        lon_deg[c] = to.grid.lon.at_deg(rect.first_column + static_cast<std::int64_t>(c));
    const int end = rect.first_row + rect.rows;
    for (int first = rect.first_row; first < end; first += strip) {
        if (!is_read) ORO_CHECK(placed.read(first, std::min(strip, end - first)));
        report.voids += placed.block().voids;
        report.implausible += placed.block().implausible;
        for (int row = first; row < std::min(first + strip, end); ++row) {
            placed.row(row, heights, beyond, inside);
            const double lat_deg = to.grid.lat.at_deg(row);
            ORO_CHECK(shift.apply(to.undulation, lat_deg, lon_deg, heights));
            ORO_CHECK(shift.apply(to.undulation, lat_deg, lon_deg, beyond));
            const bool own_posts = placed.fit() == Fit::same_posts;
            const std::uint64_t filled =
                to.surface.lay(row, rect.first_column, heights, inside, own_posts, report.seams);
            laid.lent += own_posts ? 0 : filled;
            if (placed.fit() == Fit::elsewhere) to.surface.lay_later(row, rect.first_column, beyond);
            for (const float height : heights) {
                if (is_void(height)) continue;
                report.lowest_m = std::min(report.lowest_m, static_cast<double>(height));
                report.highest_m = std::max(report.highest_m, static_cast<double>(height));
            }
        }
    }
    return laid;
}

// All turns at which a source meets the grid. A source round the Earth whose posts are not copied finds every
// longitude by itself.
std::vector<int> turns_of(const Source& source, const PostGrid& grid) {
    if (source.full_circle && !source.on_degrees) return {0};
    if (!source.full_circle) {
        // A line is enough here: the last column of a region round the Earth is the first one of its
        // westernmost sources.
        const double spacing = grid.lon.spacing_deg();
        return turns_that_meet(source.lon, grid.west_deg() - 0.5 * spacing, grid.east_deg() + 0.5 * spacing);
    }
    return {0, -1, 1};
}

Result<void> lay_sources(std::vector<Source>& sources, const GeoidOfRegion& geoid, const BoundingBox& box,
                         bool strict, const Reading& to, std::vector<std::string>& notes,
                         const Progress& progress) {
    std::size_t done = 0;
    const std::vector<std::size_t> order = by_precedence(sources);
    std::size_t begun = 1;
    for (const std::size_t i : order) {
        Source& source = sources[i];
        for (begun = std::max(begun, done + 1); begun < order.size() && to.ahead.has_room(); ++begun) {
            const Source& next = sources[order[begun]];
            for (const int turn : turns_of(next, to.grid)) to.ahead.begin(next, turn);
        }
        SourceReport& report = source.report;
        if (progress)
            progress(0.1 + 0.85 * static_cast<double>(done++) / static_cast<double>(sources.size()),
                     "reading " + report.path);
        GeoidOfRegion::Shift shift;
        if (!source.vertical_crs.empty()) {
            auto found = geoid.shift_from(source.vertical_crs, box, strict);
            if (!found) return Error{found.error().kind, report.path, found.error().line()};
            shift = std::move(*found);
            report.vertical_datum.egm96_stands_in = shift.egm96_stands_in();
            add_note(notes, shift.note());
        }
        report.lowest_m = std::numeric_limits<double>::max();
        report.highest_m = std::numeric_limits<double>::lowest();
        std::uint64_t lent = 0;
        for (const int turn : turns_of(source, to.grid)) {
            ORO_TRY(const Laid laid, lay_source(source, turn, shift, to));
            lent += laid.lent;
            // One pass is the whole circle unless posts are copied column by column.
            if (source.full_circle && laid.fit != Fit::same_posts) break;
        }
        if (lent > 0)
            add_note(notes, std::to_string(lent) + " void posts of finer sources take their height from " +
                                report.path);
        if (report.lowest_m > report.highest_m) report.lowest_m = report.highest_m = 0.0;
        if (shift.beyond_grid() > 0) {
            const std::string what = std::to_string(shift.beyond_grid()) + " posts of " + report.path +
                                     " lie outside the grid of its vertical datum";
            if (strict) return Error{ErrorKind::failed, report.path, what};
            add_note(notes, what + ": EGM96 stands in there");
        }
        if (report.implausible > 0)
            add_note(notes, report.path + ": " + std::to_string(report.implausible) +
                                " heights below -12,000 m or above 9,000 m are taken as void");
    }
    return {};
}

Result<Region> open_checked(const RegionRequest& request, const Progress& progress) {
    if (request.paths.empty()) return Error{ErrorKind::no_data, "", "no path to elevation data was given"};
    ORO_TRY(Found found, look_at(request, progress));
    const std::string where = list_of(request.paths);
    if (found.sources.empty() && !request.box)
        return Error{
            ErrorKind::no_data, where,
            "no elevation data" + (found.first_skipped.empty() ? "" : " (" + found.first_skipped + ")")};
    if (request.box) reach_over_seams(found.sources);
    const auto extent = region_extent(found.sources, request.box);
    if (!extent)
        return Error{ErrorKind::no_data, where,
                     request.box ? "no elevation data in " + text_of(*request.box)
                                 : "its posts lie on a line or a point, and cover no area"};
    std::erase_if(found.sources, [&](const Source& source) { return !meets(source, extent->box); });
    Region region;
    region.notes = std::move(found.notes);
    ORO_TRY(const GeoidOfRegion geoid, GeoidOfRegion::open(request.strict_datum));
    ORO_TRY(const PostGrid grid, region_grid(found.sources, *extent));
    const BoundingBox posts{grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg()};
    region.field.grid = grid;
    ORO_TRY(region.field.undulation, geoid.undulation(posts));
    region.geoid = geoid.name();
    add_note(region.notes, geoid.note());
    if (!request.height_unit.empty() && request.height_unit != "m" &&
        std::ranges::any_of(found.sources,
                            [](const Source& source) { return source.kind == SourceKind::hgt; }))
        add_note(region.notes,
                 "the height unit " + request.height_unit + " is not for .hgt files: they hold metres");
    if (request.box && request.box->west_deg > request.box->east_deg &&
        posts.east_deg - posts.west_deg > 180.0)
        add_note(region.notes, "west is greater than east in " + text_of(*request.box) +
                                   ": that crosses the antimeridian, and most of the way round the Earth");
    JoinedSurface surface(grid);
    TilesAhead ahead(grid);
    ORO_CHECK(lay_sources(found.sources, geoid, posts, request.strict_datum,
                          {grid, region.field.undulation, surface, ahead}, region.notes, progress));
    surface.finish();
    region.void_method = VoidMethod::holes;
    if (request.fill_voids) {
        if (progress) progress(0.95, "filling voids");
        ORO_TRY(region.filled, fill_voids(surface, grid));
        region.void_method = VoidMethod::filled;
    }
    region.seams = surface.seams();
    region.field.H_m = std::move(surface.heights());
    region.voids = static_cast<std::uint64_t>(std::ranges::count_if(region.field.H_m, is_void));
    if (region.voids == region.field.H_m.size())
        return Error{ErrorKind::no_data, where,
                     "no height in " + text_of(posts) + ": all its posts are void"};
    region.missing_cells = cells_without(found.sources, grid);
    const Uncovered uncovered = count_uncovered(region.field, region.missing_cells,
                                                [&](std::size_t post) { return surface.covered(post); });
    region.outside = uncovered.outside;
    region.in_missing = uncovered.in_missing;
    for (Source& source : found.sources) region.sources.push_back(std::move(source.report));
    if (progress) progress(1.0, "region read");
    return region;
}

}  // namespace

Result<std::vector<SourceReport>> sources_too_large(const RegionRequest& request) {
    try {
        start_gdal();
        ORO_TRY(Found found, look_at(request, {}));
        std::vector<SourceReport> reports;
        const auto extent = region_extent(found.sources, request.box);
        if (!extent || region_grid(found.sources, *extent).ok()) return reports;
        for (Source& source : found.sources) reports.push_back(std::move(source.report));
        return reports;
    } catch (const std::bad_alloc&) {
        return Error{ErrorKind::failed, "looking at sources", "not enough memory"};
    } catch (const std::exception& fault) {
        return Error{ErrorKind::failed, "looking at sources", fault.what()};
    }
}

Result<Region> open_region(const RegionRequest& request, const Progress& progress) {
    try {
        const bool is_baked = baked_path(request.paths).has_value();
        if (!is_baked) start_gdal();
        Result<Region> region =
            is_baked ? open_baked_region(request, progress) : open_checked(request, progress);
        if (region.ok()) ORO_CHECK(libraries_are_sound());
        return region;
    } catch (const std::bad_alloc&) {
        return Error{ErrorKind::failed, "region too large",
                     "not enough memory for its posts; narrow it with --bbox"};
    } catch (const std::exception& fault) {
        return Error{ErrorKind::failed, "reading a region", fault.what()};
    }
}

}  // namespace oro
