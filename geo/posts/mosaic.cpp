#include "geo/posts/mosaic.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "geo/measures/stored_values.h"
#include "geo/posts/resampling_error.h"
#include "geo/posts/source_sampling.h"
#include "geo/posts/tiles_ahead.h"
#include "geo/region/region_fingerprints.h"
#include "geo/region/region_grid.h"
#include "geo/sources/notes.h"
#include "geo/sources/row_scans.h"

namespace oro {
namespace {

struct Reading {
    const PostGrid& grid;
    const UndulationField& undulation;
    JoinedSurface& surface;
    TilesAhead& ahead;
};

struct Laid {
    std::uint64_t voids_filled{};  // void posts of finer sources that it filled
    std::uint64_t beyond_grid{};   // posts outside the grids of its vertical datum
    Fit fit{Fit::elsewhere};
};

// What is kept of a source while it is laid, at one whole turn after the other.
struct Findings {
    SourceFingerprint fingerprint;
    StoredValues stored;
    std::optional<ResamplingError> resampling;  // nothing where posts are copied
};

// Room for one row of a source's posts.
struct Row {
    Row(const PostGrid& grid, const GridRect& rect)
        : heights(static_cast<std::size_t>(rect.columns)),
          beyond(heights.size()),
          inside(heights.size()),
          lon_deg(heights.size()) {
        for (std::size_t c = 0; c < heights.size(); ++c)
            lon_deg[c] = grid.lon.at_deg(rect.first_column + static_cast<std::int64_t>(c));
    }
    std::vector<float> heights, beyond;
    std::vector<unsigned char> inside;
    std::vector<double> lon_deg;
};

// Lays one row of a source that is read.
Result<void> lay_row(SourceOnGrid& placed, int row_number, Row& row, GeoidOfRegion::Shift& shift,
                     const Reading& to, SourceReport& report, Findings& found, Laid& laid) {
    const int first_column = placed.rect().first_column;
    placed.row(row_number, row.heights, row.beyond, row.inside);
    const double lat_deg = to.grid.lat.at_deg(row_number);
    ORO_CHECK(shift.apply(to.undulation, lat_deg, row.lon_deg, row.heights));
    ORO_CHECK(shift.apply(to.undulation, lat_deg, row.lon_deg, row.beyond));
    const bool own_posts = placed.fit() == Fit::same_posts;
    const std::uint64_t filled =
        to.surface.lay(row_number, first_column, row.heights, row.inside, own_posts, report.seams);
    laid.voids_filled += own_posts ? 0 : filled;
    if (found.resampling) found.resampling->laid(row_number, row.heights, row.beyond);
    found.fingerprint.add(row.heights);
    if (placed.fit() == Fit::elsewhere) {
        to.surface.lay_later(row_number, first_column, row.beyond);
        found.fingerprint.add(row.beyond);
    }
    constexpr double most_m = std::numeric_limits<float>::max();
    if (!any_beyond(row.heights, static_cast<float>(std::min(report.lowest_m, most_m)),
                    static_cast<float>(std::max(report.highest_m, -most_m))))
        return {};
    for (const float height : row.heights) {
        if (is_void(height)) continue;
        report.lowest_m = std::min(report.lowest_m, static_cast<double>(height));
        report.highest_m = std::max(report.highest_m, static_cast<double>(height));
    }
    return {};
}

// Lays one source into the surface, at one whole turn, in strips that fit memory.
Result<Laid> lay_source(Source& source, int turn, GeoidOfRegion::Shift& shift, const Reading& to,
                        Findings& found) {
    constexpr std::size_t posts_a_strip = std::size_t{1} << 26;
    std::optional<Result<SourceOnGrid>> begun = to.ahead.take(source, turn);
    const bool is_read = begun.has_value();
    ORO_TRY(SourceOnGrid placed, is_read ? std::move(*begun) : SourceOnGrid::create(source, to.grid, turn));
    const GridRect& rect = placed.rect();
    Laid laid{0, 0, placed.fit()};
    if (rect.rows <= 0 || rect.columns <= 0) return laid;
    SourceReport& report = source.report;
    report.placement = placed.placement();
    if (placed.fit() != Fit::same_posts && !found.resampling) {
        ORO_TRY(found.resampling, ResamplingError::create(source, to.grid, to.surface.heights()));
    }
    if (found.resampling) found.resampling->begin(rect);
    const int strip =
        is_read
            ? rect.rows
            : static_cast<int>(std::clamp<std::size_t>(posts_a_strip / static_cast<std::size_t>(rect.columns),
                                                       1, static_cast<std::size_t>(rect.rows)));
    Row row(to.grid, rect);
    const int end = rect.first_row + rect.rows;
    found.fingerprint.begin(to.grid, rect.first_row, rect.first_column, rect.rows, rect.columns);
    ToH to_H;
    if (!shift.does_nothing())
        to_H = [&](double lat_deg, std::span<const double> lon_deg, std::span<float> H_m) {
            return shift.apply(to.undulation, lat_deg, lon_deg, H_m);
        };
    for (int first = rect.first_row; first < end; first += strip) {
        if (!is_read) ORO_CHECK(placed.read(first, std::min(strip, end - first)));
        report.voids += placed.block().voids;
        report.implausible += placed.block().implausible;
        source.values.add(placed.block().values);
        found.stored.add(placed.block());
        const std::size_t beyond_before = shift.beyond_grid();
        for (int number = first; number < std::min(first + strip, end); ++number)
            ORO_CHECK(lay_row(placed, number, row, shift, to, report, found, laid));
        laid.beyond_grid += shift.beyond_grid() - beyond_before;
        if (found.resampling) ORO_CHECK(found.resampling->compare(placed.block(), to_H));
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

}  // namespace

Result<void> note_findings(SourceReport& report, std::uint64_t voids_filled, std::uint64_t beyond_grid,
                           bool strict, std::vector<std::string>& notes) {
    if (voids_filled > 0)
        add_note(notes, std::to_string(voids_filled) +
                            " void posts of finer sources take their height from " + report.path);
    if (report.lowest_m > report.highest_m) report.lowest_m = report.highest_m = 0.0;
    if (beyond_grid > 0) {
        const std::string what = std::to_string(beyond_grid) + " posts of " + report.path +
                                 " lie outside the grid of its vertical datum";
        if (strict) return Error{ErrorKind::failed, report.path, what};
        add_note(notes, what + ": EGM96 stands in there");
    }
    return {};
}

Result<std::vector<MeasuredSource>> mosaic_sources(std::vector<Source>& sources, const MosaicTarget& region,
                                                   JoinedSurface& surface, std::vector<std::string>& notes,
                                                   const Progress& progress) {
    std::vector<MeasuredSource> measured;
    const PostGrid& grid = region.grid;
    TilesAhead ahead(grid);
    const Reading to{grid, region.undulation, surface, ahead};
    const BoundingBox box{grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg()};
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
            auto found = region.geoid.shift_from(source.vertical_crs, box, region.strict_datum);
            if (!found) return Error{found.error().kind, report.path, found.error().line()};
            shift = std::move(*found);
            report.vertical_datum.egm96_stands_in = shift.egm96_stands_in();
            add_note(notes, shift.note());
        }
        report.lowest_m = std::numeric_limits<double>::max();
        report.highest_m = std::numeric_limits<double>::lowest();
        std::uint64_t voids_filled = 0, beyond_grid = 0;
        Findings found;
        for (const int turn : turns_of(source, to.grid)) {
            ORO_TRY(const Laid laid, lay_source(source, turn, shift, to, found));
            voids_filled += laid.voids_filled;
            beyond_grid += laid.beyond_grid;
            // One pass is the whole circle unless posts are copied column by column.
            if (source.full_circle && laid.fit != Fit::same_posts) break;
        }
        report.posts_hash = found.fingerprint.value();
        // A column that repeats the first one, round the Earth, is not read.
        report.stored =
            found.stored.range(report.rows, source.on_degrees ? source.lon_axis.count : report.columns);
        if (found.resampling) measured.push_back({i, std::move(*found.resampling)});
        ORO_CHECK(note_findings(report, voids_filled, beyond_grid, region.strict_datum, notes));
    }
    return measured;
}

}  // namespace oro
