#include "apps/report/region_json.h"

#include <set>

#include "core/baked/region_format.h"
#include "geo/files/foreign_text.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

ordered_json box_json(const BoundingBox& box) {
    return {box.west_deg, box.south_deg, box.east_deg, box.north_deg};
}

ordered_json seams_json(const SeamReport& seams) {
    return {{"shared_posts", seams.shared_posts},
            {"disagreeing_posts", seams.disagreeing_posts},
            {"largest_difference_m", seams.largest_difference_m}};
}

}  // namespace

ordered_json sources_json(const std::vector<SourceReport>& sources) {
    ordered_json all = ordered_json::array();
    for (const SourceReport& s : sources) {
        all.push_back(
            {{"path", s.path},
             {"format", s.format},
             {"crs", s.crs},
             {"vertical_datum", s.vertical_datum},
             {"height_unit", s.height_unit},
             {"posts_are", s.posts_are},
             {"posts", {{"rows", s.rows}, {"columns", s.columns}}},
             {"spacing",
              {{"lat_deg", s.lat_spacing_deg}, {"lon_deg", s.lon_spacing_deg}, {"metres", s.spacing_m}}},
             {"bbox", box_json(s.box)},
             {"H_m", {{"lowest", s.lowest_m}, {"highest", s.highest_m}}},
             {"voids", s.voids},
             {"implausible", s.implausible},
             {"placement", s.placement},
             {"seams", seams_json(s.seams)},
             {"attribution", s.attribution}});
    }
    return all;
}

ordered_json region_json(const Region& region) {
    const PostGrid& grid = region.field.grid;
    const HeightRange range = height_range(region.field);
    return {{"bbox", {grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg()}},
            {"posts", {{"rows", grid.rows()}, {"columns", grid.columns()}}},
            {"spacing_deg", {{"lat", grid.lat.spacing_deg()}, {"lon", grid.lon.spacing_deg()}}},
            {"H_m", {{"lowest", range.lowest_m}, {"highest", range.highest_m}}},
            {"geoid", region.geoid},
            {"voids", region.void_posts()},
            {"outside_sources", region.outside},
            {"in_missing_cells", region.in_missing},
            {"filled", region.filled},
            {"void_method", region.void_method},
            {"seams", seams_json(region.seams)},
            {"seam_rule", "the finer spacing wins; among equals the first in the byte order of file names"},
            {"missing_cells", region.missing_cells},
            {"notes", region.notes}};
}

ordered_json file_json(const Region& region) {
    if (!region.file) return nullptr;
    const RegionFile& file = *region.file;
    return {{"path", file.path()},
            {"format", "baked region"},
            {"version", region_format::version},
            {"levels", file.order().levels()},
            {"pages", file.order().count()},
            {"triangles", file.outline().triangles},
            {"bytes", file.bytes()},
            {"bytes_per_post",
             static_cast<double>(file.bytes()) / static_cast<double>(region.field.grid.post_count())}};
}

std::string note_of_voids(const Region& region) {
    std::string note;
    const auto add = [&](std::uint64_t posts, const std::string& what) {
        if (posts > 0) note += (note.empty() ? "" : "; ") + std::to_string(posts) + what;
    };
    add(region.void_posts(), std::string(" void posts are holes (") + (region.file ? "baking with " : "") +
                                 "--fill-voids fills what is near others)");
    add(region.outside, " posts outside all sources are holes");
    add(region.in_missing,
        " posts in " + std::to_string(region.missing_cells.size()) + " missing cells are holes");
    return note;
}

std::string attribution_of(const Region& region) {
    std::set<std::string> seen;
    std::string all;
    for (const SourceReport& source : region.sources) {
        // Once more: a region may have been baked when such text was kept as it was.
        const std::string attribution = foreign_text(source.attribution);
        if (attribution.empty() || !seen.insert(attribution).second) continue;
        all += (all.empty() ? "" : "; ") + attribution;
    }
    return all;
}

}  // namespace oro
