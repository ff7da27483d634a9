#include "geo/posts/laying.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "geo/posts/source_sampling.h"
#include "geo/posts/tiles_ahead.h"
#include "geo/region/region_grid.h"
#include "geo/region/region_prints.h"

namespace oro {
namespace {

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
Result<Laid> lay_source(Source& source, int turn, GeoidOfRegion::Shift& shift, const Reading& to,
                        SourcePrint& print) {
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
    print.begin(to.grid, rect.first_row, rect.first_column, rect.rows, rect.columns);
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
            print.add(heights);
            if (placed.fit() == Fit::elsewhere) {
                to.surface.lay_later(row, rect.first_column, beyond);
                print.add(beyond);
            }
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

}  // namespace

void add_note(std::vector<std::string>& notes, const std::string& note) {
    if (!note.empty() && std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
}

Result<void> lay_sources(std::vector<Source>& sources, const LayingFor& region, JoinedSurface& surface,
                         std::vector<std::string>& notes, const Progress& progress) {
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
        std::uint64_t lent = 0;
        SourcePrint print;
        for (const int turn : turns_of(source, to.grid)) {
            ORO_TRY(const Laid laid, lay_source(source, turn, shift, to, print));
            lent += laid.lent;
            // One pass is the whole circle unless posts are copied column by column.
            if (source.full_circle && laid.fit != Fit::same_posts) break;
        }
        report.posts_print = print.print();
        if (lent > 0)
            add_note(notes, std::to_string(lent) + " void posts of finer sources take their height from " +
                                report.path);
        if (report.lowest_m > report.highest_m) report.lowest_m = report.highest_m = 0.0;
        if (shift.beyond_grid() > 0) {
            const std::string what = std::to_string(shift.beyond_grid()) + " posts of " + report.path +
                                     " lie outside the grid of its vertical datum";
            if (region.strict_datum) return Error{ErrorKind::failed, report.path, what};
            add_note(notes, what + ": EGM96 stands in there");
        }
        if (report.implausible > 0)
            add_note(notes, report.path + ": " + std::to_string(report.implausible) +
                                " heights below -12,000 m or above 9,000 m are taken as void");
    }
    return {};
}

}  // namespace oro
