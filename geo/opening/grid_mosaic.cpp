#include "geo/opening/grid_mosaic.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "geo/datum/vertical_datum.h"
#include "geo/opening/baked_region.h"
#include "geo/posts/mosaic.h"
#include "geo/posts/own_posts.h"
#include "geo/posts/voids.h"
#include "geo/region/region_grid.h"
#include "geo/sources/horizontal_datum.h"
#include "geo/sources/notes.h"

namespace oro {
namespace {

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

}  // namespace

Result<LaidGrid> lay_grid(ChosenGrid chosen, const RegionRequest& request, std::vector<std::string> notes,
                          const Progress& progress) {
    if (chosen.baked) {
        ORO_TRY(RegionGrid baked, read_baked_grid(*chosen.baked, request, progress));
        return LaidGrid{std::move(baked), {}, {}};
    }
    std::vector<Source>& sources = chosen.sources;
    RegionGrid made;
    made.notes = std::move(notes);
    made.rank = chosen.rank;
    ORO_TRY(const GeoidOfRegion geoid, GeoidOfRegion::open(request.strict_datum));
    ORO_TRY(const std::optional<OwnPosts> own, own_posts_of(sources, request, made.notes));
    Result<PostGrid> of_posts = own ? Result<PostGrid>(own->grid) : region_grid(sources, chosen.extent);
    ORO_TRY(const PostGrid grid, std::move(of_posts));
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
    return LaidGrid{std::move(made), std::move(sources), std::move(surface)};
}

}  // namespace oro
