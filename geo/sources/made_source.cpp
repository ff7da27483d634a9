#include "geo/sources/made_source.h"

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"
#include "core/earth/ellipsoid.h"
#include "core/made/made_heights.h"
#include "geo/sources/made_words.h"

namespace oro {

Result<Source> inspect_made(const SourcePath& path) {
    ORO_TRY(const MadeTerrain made, made_terrain_of(path.file));
    const auto per_deg = static_cast<double>(made.posts_per_deg);
    Source source;
    source.kind = SourceKind::made;
    source.file = path.file;
    source.named = path.named;
    source.on_degrees = true;
    source.full_circle = made.is_full_circle();
    source.lat_axis = {per_deg, static_cast<double>(made.north) / per_deg, -1, made.rows()};
    source.lon_axis = {per_deg, static_cast<double>(made.west) / per_deg, +1, made.columns()};
    source.lon = {source.lon_axis.start_deg, source.lon_axis.at_deg(made.columns() - 1)};
    source.south_deg = static_cast<double>(made.south) / per_deg;
    source.north_deg = static_cast<double>(made.north) / per_deg;
    source.lat_spacing_deg = source.lon_spacing_deg = 1.0 / per_deg;
    SourceReport& report = source.report;
    report.path = path.shown;
    report.driver = "made, not measured";
    report.crs = "EPSG:4326 WGS 84";
    report.vertical_datum = {DatumFrom::crs, "EGM96 height (made so)", false};
    report.attribution = "made by Orograph, CC0";
    report.rows = made.rows();
    report.columns = made.columns();
    report.lat_spacing_deg = report.lon_spacing_deg = 1.0 / per_deg;
    report.spacing_m =
        radians_from_deg(1.0 / per_deg).rad * meridian_radius_m(0.5 * (source.south_deg + source.north_deg));
    const double east = source.lon.east_deg > 180.0 ? source.lon.east_deg - 360.0 : source.lon.east_deg;
    report.box = source.full_circle
                     ? BoundingBox{-180.0, source.south_deg, 180.0, source.north_deg}
                     : BoundingBox{source.lon.west_deg, source.south_deg, east, source.north_deg};
    return source;
}

Result<PostBlock> read_made(const Source& source, const PostWindow& window) {
    ORO_TRY(const MadeTerrain made, made_terrain_of(source.file));
    const gpu::MadeRule rule = made_rule(made);
    const std::vector<MadeColumn> columns = made_columns(made, window.column, window.columns);
    PostBlock block;
    block.window = window;
    block.height_m.resize(static_cast<std::size_t>(window.rows) * columns.size());
    in_parallel(window.rows, thread_count(), [&](int r) {
        std::vector<std::int32_t> steps(columns.size());
        made_row_heights(made, rule, window.row + r, window.column, columns, steps);
        float* const row_m = block.height_m.data() + static_cast<std::size_t>(r) * columns.size();
        // Exact: heights have at most 24 bits, for they are between -8192 and 8192 m.
        std::ranges::transform(steps, row_m, [](std::int32_t step) {
            return static_cast<float>(static_cast<double>(step) * made_step_m);
        });
    });
    if (!block.height_m.empty()) {
        const auto [lowest, highest] = std::ranges::minmax(block.height_m);
        block.lowest_stored_m = static_cast<double>(lowest);
        block.highest_stored_m = static_cast<double>(highest);
    }
    return block;
}

}  // namespace oro
