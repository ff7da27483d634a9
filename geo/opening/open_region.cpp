#include "geo/opening/open_region.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/base/files_read.h"
#include "geo/datum/vertical_datum.h"
#include "geo/files/library_faults.h"
#include "geo/files/raster_library.h"
#include "geo/opening/baked_region.h"
#include "geo/opening/region_sources.h"
#include "geo/posts/holes.h"
#include "geo/posts/mosaic.h"
#include "geo/posts/own_posts.h"
#include "geo/posts/seams.h"
#include "geo/posts/value_notes.h"
#include "geo/posts/voids.h"
#include "geo/region/disjoint_sources.h"
#include "geo/region/region_fingerprints.h"
#include "geo/region/region_grid.h"
#include "geo/sources/horizontal_datum.h"
#include "geo/sources/notes.h"
#include "geo/together/contradictions.h"
#include "geo/together/feather.h"
#include "geo/together/lattices.h"

namespace oro {
namespace {

std::string list_of(const std::vector<std::string>& paths) {
    std::string text;
    for (const std::string& path : paths) text += (text.empty() ? "" : ", ") + path;
    return text;
}

Error no_sources(const RegionRequest& request, const std::string& first_skipped) {
    const std::string where = list_of(request.paths);
    if (request.box)
        return {ErrorKind::no_data, where, "no elevation data in " + bounding_box_text(*request.box)};
    return {ErrorKind::no_data, where,
            "no elevation data" + (first_skipped.empty() ? "" : " (" + first_skipped + ")")};
}

// What in a request does not mean what it looks like.
void add_doubts(const RegionRequest& request, std::span<const Source> sources, const PostGrid& grid,
                std::vector<std::string>& notes) {
    if (!request.height_unit.empty() && request.height_unit != "m" &&
        std::ranges::any_of(sources, [](const Source& source) { return source.kind == SourceKind::hgt; }))
        add_note(notes,
                 "the height unit " + request.height_unit + " is not for .hgt files: they hold metres");
    if (!request.source_crs.empty() &&
        std::ranges::none_of(sources, [](const Source& source) { return source.crs_specified; }))
        add_note(notes,
                 "--source-crs " + request.source_crs + " says nothing here: each file states its own");
    if (!request.source_vertical.empty() && std::ranges::none_of(sources, [](const Source& source) {
            return source.report.vertical_datum.from == DatumFrom::specified;
        }))
        add_note(notes, "--source-vertical " + request.source_vertical +
                            " says nothing here: each file states its own");
    if (request.box && request.box->west_deg > request.box->east_deg &&
        grid.east_deg() - grid.west_deg() > 180.0)
        add_note(notes, "west is greater than east in " + bounding_box_text(*request.box) +
                            ": that crosses the antimeridian, and most of the way round the Earth");
}

// The posts that a region is to keep where they are; nothing where they lie on latitudes and longitudes
// anyway, are to be resampled, or cannot be kept: then a note says why.
Result<std::optional<OwnPosts>> own_posts_of(std::span<const Source> sources, const RegionRequest& request,
                                             std::vector<std::string>& notes) {
    if (request.resample || std::ranges::all_of(sources, &Source::on_degrees))
        return std::optional<OwnPosts>();
    ORO_TRY(OwnPosts own, own_posts(sources, request.box));
    if (own.why_not.empty()) return std::optional<OwnPosts>(std::move(own));
    add_note(notes, "resampled onto one grid of latitudes and longitudes: " + own.why_not);
    return std::optional<OwnPosts>();
}

// Of large rasters, whether their last row is there: a file that says more than it holds is told before
// memory is taken for its posts.
Result<void> check_last_rows(std::span<const Source> sources) {
    constexpr std::int64_t large = std::int64_t{1} << 26;
    for (const Source& source : sources) {
        const SourceReport& report = source.report;
        if (std::int64_t{report.rows} * report.columns < large) continue;
        ORO_TRY(const PostBlock row, read_posts(source, {report.rows - 1, 0, 1, report.columns}));
    }
    return {};
}

// The last step: counts the posts without a height, and why.
void describe_voids(std::span<const Source> sources, const JoinedSurface& surface, RegionGrid& region) {
    if (region.field.grid.net) {
        for (std::size_t post = 0; post < region.field.H_m.size(); ++post)
            region.outside += is_void(region.field.H_m[post]) && !surface.covered(post) ? 1U : 0U;
        return;
    }
    region.missing_cells = cells_without(sources, region.field.grid);
    const Uncovered uncovered = count_uncovered(region.field, region.missing_cells,
                                                [&](std::size_t post) { return surface.covered(post); });
    region.outside = uncovered.outside;
    region.in_missing = uncovered.in_missing;
}

// Of a region whose posts all lack a height: why.
std::string all_without_height(const RegionGrid& region) {
    std::string why;
    for (const auto& [posts, words] : {std::pair{region.void_posts(), "void in their file"},
                                       {region.outside, "outside the raster"},
                                       {region.in_missing, "in missing tiles"}})
        if (posts > 0) why += (why.empty() ? "" : ", ") + std::to_string(posts) + " " + words;
    return "all its posts are " + (why.find(',') == std::string::npos ? why.substr(why.find(' ') + 1) : why);
}

// Chooses the grid of some sources, lays them into it, and describes what has become of them.
Result<RegionGrid> grid_of(std::vector<Source> sources, const RegionExtent& extent,
                           const RegionRequest& request, std::vector<std::string> notes,
                           const Progress& progress) {
    RegionGrid made;
    made.notes = std::move(notes);
    ORO_TRY(const GeoidOfRegion geoid, GeoidOfRegion::open(request.strict_datum));
    ORO_TRY(const std::optional<OwnPosts> own, own_posts_of(sources, request, made.notes));
    Result<PostGrid> chosen = own ? Result<PostGrid>(own->grid) : region_grid(sources, extent);
    ORO_TRY(const PostGrid grid, std::move(chosen));
    const BoundingBox posts{grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg()};
    made.field.grid = grid;
    if (own) made.posts_crs = own->crs;
    ORO_TRY(made.field.undulation, geoid.undulation(posts));
    made.geoid = geoid.name();
    add_note(made.notes, geoid.note());
    ORO_CHECK(find_horizontal_datums(sources, request.strict_datum, made.notes));
    add_doubts(request, sources, grid, made.notes);
    ORO_CHECK(check_last_rows(sources));

    JoinedSurface surface(grid);
    std::vector<MeasuredSource> measured;
    const MosaicTarget to{grid, made.field.undulation, geoid, request.strict_datum};
    if (own) {
        ORO_CHECK(mosaic_own_posts(sources, {*own, to.undulation, geoid, to.strict_datum}, surface,
                                   made.field.N_of_posts_m, made.notes, progress));
        for (std::size_t i = 0; i < sources.size(); ++i) {
            SourceReport& report = sources[i].report;
            const OwnPart& part = own->parts[i];
            report.part = PartOfGrid{own->upside_down ? grid.rows() - part.row - report.rows : part.row,
                                     part.column, report.rows, report.columns};
        }
    } else {
        ORO_TRY(measured, mosaic_sources(sources, to, surface, made.notes, progress));
    }
    surface.finish();
    if (request.fill_voids) {
        if (progress) progress(0.95, "filling voids");
        ORO_TRY(made.filled, fill_voids(surface, grid));
        made.void_method = VoidMethod::filled;
    }
    for (MeasuredSource& one : measured) sources[one.source].report.resampling = one.error.finish();
    made.seams = surface.seams();
    add_note(made.notes, note_of_contradictions(sources));
    made.field.H_m = std::move(surface.heights());

    made.voids = static_cast<std::uint64_t>(std::ranges::count_if(made.field.H_m, is_void));
    describe_voids(sources, surface, made);
    note_values(sources, made.notes);
    if (made.voids == made.field.H_m.size())
        return Error{ErrorKind::no_data, list_of(request.paths),
                     "no height in " + bounding_box_text(posts) + ": " + all_without_height(made) +
                         why_no_height(sources)};
    made.posts_hash = posts_hash(made.field);
    made.geoid_fingerprint = undulation_fingerprint(made.field.undulation);
    for (Source& source : sources) made.sources.push_back(std::move(source.report));
    return made;
}

// That of most posts comes first, and has the notes on all.
void put_largest_first(std::vector<RegionGrid>& grids) {
    const auto largest = std::ranges::max_element(
        grids, {}, [](const RegionGrid& grid) { return grid.field.grid.post_count(); });
    std::rotate(grids.begin(), largest, largest + 1);
    for (RegionGrid& other : std::span(grids).subspan(1))
        for (const std::string& note : std::exchange(other.notes, {})) add_note(grids.front().notes, note);
}

// Which of the groups wins where several have ground: as their first files are listed, where that counts;
// else the finest first, among equals the one named first.
std::vector<std::size_t> ranks_of(const std::vector<std::vector<Source>>& groups) {
    std::vector<std::size_t> order(groups.size()), ranks(groups.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto spacing_deg = [&](std::size_t group) {
        std::pair<int, double> first{std::numeric_limits<int>::max(), 1.0e9};
        for (const Source& source : groups[group]) {
            const Precedence rank = precedence_of(source.report);
            first.first = std::min(first.first, rank.listed);
            first.second = std::min(first.second, std::sqrt(rank.lat_spacing_deg * rank.lon_spacing_deg));
        }
        return first;
    };
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return spacing_deg(a) < spacing_deg(b); });
    for (std::size_t i = 0; i < order.size(); ++i) ranks[order[i]] = i;
    return ranks;
}

// Looks at the sources, and reads them as one grid, or as several.
Result<Region> read_region(const RegionRequest& request, const Progress& progress) {
    if (request.paths.empty()) return Error{ErrorKind::no_data, "", "no path to elevation data was given"};
    ORO_TRY(RegionSources found, probe_sources(request, progress));
    if (found.sources.empty() && !request.box) return no_sources(request, found.first_skipped);
    const auto extent = choose_extent(found.sources, request.box);
    if (!extent && request.box) return no_sources(request, "");
    if (!extent)
        return Error{ErrorKind::no_data, list_of(request.paths),
                     "its posts lie on a line or a point, and cover no area"};
    std::vector<std::vector<Source>> groups = grids_of_sources(std::move(found.sources), request);
    Region region;
    const std::vector<std::size_t> rank_of = ranks_of(groups);
    std::vector<Error> empty;
    for (std::size_t number = 0; number < groups.size(); ++number) {
        std::vector<Source>& group = groups[number];
        const auto own = groups.size() == 1 ? extent : region_extent(group, request.box);
        if (!own) continue;  // on a line or a point
        const double before = static_cast<double>(region.grids.size()) / static_cast<double>(groups.size());
        const Progress part = [&](double share, const std::string& what) {
            if (progress) progress(before + share / static_cast<double>(groups.size()), what);
        };
        Result<RegionGrid> opened =
            grid_of(std::move(group), *own, request,
                    region.grids.empty() ? found.notes : std::vector<std::string>(), part);
        if (!opened && groups.size() > 1 && opened.error().kind == ErrorKind::no_data) {
            // The others have ground.
            empty.push_back(opened.error());
            continue;
        }
        ORO_TRY(RegionGrid grid, std::move(opened));
        grid.rank = static_cast<int>(rank_of[number]);
        region.grids.push_back(std::move(grid));
    }
    if (region.grids.empty() && !empty.empty()) return empty.front();
    if (region.grids.empty())
        return Error{ErrorKind::no_data, list_of(request.paths), "no file's posts cover an area"};
    if (progress) progress(1.0, "region read");
    put_largest_first(region.grids);
    std::vector<std::string>& notes = region.grids.front().notes;
    for (const Error& error : empty) add_note(notes, "left out: " + error.what);
    add_note(notes, note_of_contradicting_grids(region));
    if (request.feather_m > 0.0 && region.grids.size() > 1) ORO_CHECK(feather(region, request.feather_m));
    return region;
}

// Of a box without data: whether its numbers, taken as latitude first, are one with data. Then that is said.
Error with_order_of_box(Error fault, const RegionRequest& request, const std::optional<std::string>& baked) {
    if (fault.kind != ErrorKind::no_data || !request.box) return fault;
    RegionRequest other = request;
    other.box = with_latitude_first(*request.box);
    if (!other.box) return fault;
    if (baked) {
        if (!open_baked_region(*baked, other, {}).ok()) return fault;
    } else {
        auto found = probe_sources(other, {});
        if (!found.ok() || found->sources.empty() || !choose_extent(found->sources, other.box)) return fault;
    }
    fault.what +=
        ", but in " + bounding_box_text(*other.box) + ": longitude comes first (west,south,east,north)";
    return fault;
}

}  // namespace

Result<Region> open_region(const RegionRequest& request, const Progress& progress) {
    try {
        const std::optional<std::string> baked = baked_path(request.paths);
        if (!baked) start_gdal();
        Result<Region> region =
            baked ? open_baked_region(*baked, request, progress) : read_region(request, progress);
        if (region.ok()) ORO_CHECK(libraries_are_sound());
        // Also where it could not be read: a file that is being rewritten is not damaged.
        ORO_CHECK(check_files_unchanged());
        if (!region.ok()) return with_order_of_box(region.error(), request, baked);
        return region;
    } catch (const std::bad_alloc&) {
        return Error{ErrorKind::failed, "region too large",
                     "not enough memory for its posts; narrow it with --bbox"};
    } catch (const std::exception& fault) {
        return Error{ErrorKind::failed, "reading a region", fault.what()};
    }
}

}  // namespace oro
