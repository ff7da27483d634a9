#include "apps/report/region_json.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/report/different_words.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/progress_bar.h"
#include "core/base/container.h"
#include "core/earth/ellipsoid.h"
#include "geo/files/foreign_text.h"
#include "geo/region/source_fields.h"
#include "geo/sources/source_words.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

ordered_json box_json(const BoundingBox& box) {
    return json_list(box.west_deg, box.south_deg, box.east_deg, box.north_deg);
}

ordered_json source_json(const SourceReport& s) {
    ordered_json json = ordered_json::object();
    put_source_words(json, s);
    json["horizontal_datum"] = nullptr;
    if (!s.horizontal_datum.is_wgs84)
        json["horizontal_datum"] = horizontal_fields<ordered_json>(s.horizontal_datum);
    json["posts"] = json_object("rows", s.rows, "columns", s.columns);
    json["spacing"] =
        json_object("lat_deg", s.lat_spacing_deg, "lon_deg", s.lon_spacing_deg, "metres", s.spacing_m);
    // Of a projected CRS, as that counts it; not known of baked ones.
    json["spacing"]["crs_metres"] = nullptr;
    if (const auto spacing_m = projected_spacing_m(s)) json["spacing"]["crs_metres"] = *spacing_m;
    json["bbox"] = box_json(s.box);
    json["H_m"] = nullptr;  // where all its posts are void
    if (!s.is_all_void()) json["H_m"] = json_object("lowest", s.lowest_m, "highest", s.highest_m);
    json["stored"] = nullptr;
    if (s.stored) json["stored"] = stored_fields<ordered_json>(*s.stored);
    put_source_findings(json, s);
    json["resampling"] = nullptr;
    if (s.resampling) json["resampling"] = resampling_fields<ordered_json>(*s.resampling);
    json["attribution"] = s.attribution;
    return json;
}

}  // namespace

ordered_json resampling_json(const std::optional<RegionResampling>& found) {
    if (!found) return nullptr;
    return json_object("files", found->files, "unknown", found->unknown, "posts", found->posts, "compared",
                       found->compared, "worst_m", found->worst_m, "rms_m", found->rms_m);
}

ordered_json sources_json(const std::vector<SourceReport>& sources) {
    ordered_json all = ordered_json::array();
    for (const SourceReport& source : sources) all.push_back(source_json(source));
    return all;
}

ordered_json region_json(const RegionGrid& grid) {
    const PostGrid& posts = grid.field.grid;
    const HeightRange range = height_range(grid.field);
    ordered_json json = ordered_json::object();
    json["bbox"] = json_list(posts.west_deg(), posts.south_deg(), posts.east_deg(), posts.north_deg());
    json["posts"] = json_object("rows", posts.rows(), "columns", posts.columns());
    json["own_posts"] = posts.net != nullptr;
    if (posts.net)
        json["largest_spacing_m"] = json_object("rows", posts.net->row_m(), "columns", posts.net->column_m());
    else
        json["spacing_deg"] = json_object("lat", posts.lat.spacing_deg(), "lon", posts.lon.spacing_deg());
    json["H_m"] = json_object("lowest", range.lowest_m, "highest", range.highest_m);
    json["resampling"] = resampling_json(region_resampling(grid));
    json["geoid"] = grid.geoid;
    // Null where it is not known which of the posts are void, and which outside all rasters.
    json["without_height"] = grid.voids;
    json["voids"] = nullptr;
    json["outside_sources"] = nullptr;
    if (grid.classifies_voids) {
        json["voids"] = grid.void_posts();
        json["outside_sources"] = grid.outside;
    }
    json["in_missing_cells"] = grid.in_missing;
    json["filled"] = grid.filled;
    if (const auto& feathered = grid.feathered)
        json["feathered"] = json_object("width_m", feathered->width_m, "posts", feathered->posts, "most_m",
                                        feathered->most_m, "rms_m", feathered->rms_m);
    json["void_method"] = void_method_words(grid.void_method);
    json["seams"] = seam_fields<ordered_json>(grid.seams);
    json["seam_rule"] = "the finer spacing wins; among equals the first in the byte order of file names";
    json["missing_cells"] = grid.missing_cells;
    json["notes"] = own_notes(grid);
    return json;
}

// finest: triangles of the grid.
ordered_json graph_json(const ClusterFile& file, std::uint64_t finest) {
    const ClusterOutline& graph = file.outline();
    ordered_json json = json_object("levels", graph.levels.size(), "groups", graph.groups, "triangles",
                                    graph.triangles, "bytes", file.bytes());
    json["by_level"] = ordered_json::array({json_object("level", 0, "triangles", finest, "clusters",
                                                        graph.leaves, "groups", 0, "largest_error_m", 0.0)});
    for (const GraphLevel& level : graph.levels)
        json["by_level"].push_back(json_object("level", json["by_level"].size(), "triangles",
                                               level.triangles_out, "clusters", level.clusters_out, "groups",
                                               level.groups, "largest_error_m", level.largest_error_m));
    return json;
}

std::optional<double> projected_spacing_m(const SourceReport& source) {
    const double nominal_deg = source.nominal_spacing_deg;
    if (nominal_deg <= 0.0) return std::nullopt;
    // Degrees of a CRS are those of the report; metres are fewer degrees of its parallel than of the equator.
    constexpr double same = 1.0e-4;
    const double share = source.lat_spacing_deg * source.lon_spacing_deg / (nominal_deg * nominal_deg);
    if (std::abs(share - 1.0) < same) return std::nullopt;
    return radians_from_deg(nominal_deg).rad * wgs84_a_m;
}

ordered_json file_json(const RegionGrid& grid) {
    if (!grid.file) return nullptr;
    const RegionFile& file = *grid.file;
    ordered_json json = ordered_json::object();
    json["path"] = file.path();
    json["format"] = "baked region";
    json["version"] = ChunkTable::version;
    json["levels"] = file.order().levels();
    json["pages"] = file.order().count();
    json["triangles"] = file.outline().triangles;
    // Of all that the file holds, and of this grid in it.
    json["bytes"] = file.file_bytes();
    json["grid_bytes"] = file.bytes();
    if (grid.clusters) json["clusters"] = graph_json(*grid.clusters, file.outline().triangles);
    json["bytes_per_post"] =
        static_cast<double>(file.bytes()) / static_cast<double>(grid.field.grid.post_count());
    return json;
}

std::string note_of_voids(const RegionGrid& grid) {
    std::string note;
    const auto add = [&](std::uint64_t posts, const char* one, const char* many, const std::string& what) {
        if (posts > 0) note += (note.empty() ? "" : "; ") + counted(posts, one, many) + what;
    };
    if (!grid.classifies_voids)
        add(grid.void_posts(), "post without a height is a hole", "posts without a height are holes",
            ": void in their file, or outside all rasters, which this baked region does not tell apart");
    else
        add(grid.void_posts(), "void post is a hole", "void posts are holes",
            std::string(" (") + (grid.file ? "baking with " : "") +
                "--fill-voids fills what is near others)");
    add(grid.outside, "post outside all rasters is a hole", "posts outside all rasters are holes", "");
    if (grid.in_missing > 0)
        note += (note.empty() ? "" : "; ") +
                counted(grid.missing_cells.size(), "tile is missing: ", "tiles are missing: ") +
                counted(grid.in_missing, "post has no height there", "posts have no height there") +
                (grid.file ? "" : " (orograph fetch gets tiles)");
    return note;
}

std::string note_of_assumed_heights(const RegionGrid& grid) {
    std::string first;
    std::size_t count = 0;
    for (const SourceReport& source : grid.sources) {
        const DatumFrom from = source.vertical_datum.from;
        if (from != DatumFrom::assumed_unstated && from != DatumFrom::assumed_unreadable) continue;
        if (count++ == 0) first = source.path;
    }
    if (count == 0) return "";
    if (count > 1) first += " and " + counted(count - 1, "more file", "more files");
    return first + (count == 1 ? " does" : " do") +
           " not say what the heights refer to: EGM96 heights are assumed (--source-vertical tells what they "
           "are, when files are read)";
}

std::vector<std::string> own_notes(const RegionGrid& grid) {
    std::vector<std::string> notes = grid.notes;
    if (std::string assumed = note_of_assumed_heights(grid); !assumed.empty())
        notes.push_back(std::move(assumed));
    return notes;
}

std::vector<std::string> all_notes(const Region& region) {
    std::vector<std::string> notes;
    const auto add_once = [&](std::string note) {
        if (!note.empty() && std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
    };
    for (const RegionGrid& grid : region.grids) {
        for (std::string& note : own_notes(grid)) add_once(std::move(note));
        add_once(note_of_voids(grid));
    }
    return notes;
}

void say_notes(const Region& region, bool quiet) {
    for (const std::string& note : all_notes(region)) say(quiet, "note: " + note);
}

std::string attribution_of(const Region& region) {
    DifferentWords all;
    for (const RegionGrid& grid : region.grids)
        for (const SourceReport& source : grid.sources)
            all.add(foreign_text(source.attribution));  // a region file may hold any text
    return all.all();
}

}  // namespace oro
