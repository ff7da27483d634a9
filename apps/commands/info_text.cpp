#include "apps/commands/info_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/report/figures.h"
#include "apps/report/region_json.h"
#include "apps/report/resampling_words.h"
#include "core/base/container.h"
#include "core/earth/ellipsoid.h"
#include "geo/sources/raster_source.h"
#include "geo/sources/source_words.h"

namespace oro {
namespace {

enum class Posts { read, not_read };

std::string line(const char* name, const std::string& text) {
    char label[20];
    std::snprintf(label, sizeof label, "  %-12s", name);
    return label + one_line(text) + "\n";
}

template <class... Values>
std::string text_of(const char* format, Values... values) {
    char text[240];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::string box_text(double west_deg, double south_deg, double east_deg, double north_deg) {
    return text_of("west %.6f south %.6f east %.6f north %.6f", west_deg, south_deg, east_deg, north_deg);
}

// "137 to 4783 m"
std::string heights_text(double lowest_m, double highest_m) {
    const bool whole = lowest_m == std::round(lowest_m) && highest_m == std::round(highest_m);
    return text_of(whole ? "%.0f to %.0f m" : "%.1f to %.1f m", lowest_m, highest_m);
}

bool is_as_stored(const SourceReport& source) {
    return source.stored && source.stored->lowest_m == source.lowest_m &&
           source.stored->highest_m == source.highest_m;
}

std::string stored_text(const StoredRange& stored) {
    return heights_text(stored.lowest_m, stored.highest_m) +
           (stored.whole ? "" : " in the part that was read");
}

std::string voids_text(const SourceReport& source) {
    if (source.voids == 0) return "none";
    if (source.implausible == 0) return grouped(source.voids);
    return grouped(source.voids) + ", " + grouped(source.implausible) +
           " of them heights that no terrain has (below -12,000 m or above 9,000 m)";
}

std::string placement_text(const Placement& placement) {
    if (placement.fit == Fit::elsewhere)
        return "its posts lie elsewhere than the region's: heights are resampled (bicubic)";
    std::string text = "its posts are the region's posts";
    if (placement.fit == Fit::every_kth_post)
        text = "each of its posts stands for " + std::to_string(placement.lat_part) + " x " +
               std::to_string(placement.lon_part) + " of the region's; those between are interpolated";
    constexpr double too_little_to_tell = 1e-4;
    if (placement.moved_by_posts <= too_little_to_tell) return text;
    return text + text_of(", moved by up to %.4f of their spacing", placement.moved_by_posts);
}

// "92.63 m", "27.67 km"
std::string distance_text(double distance_m) {
    return distance_m < 1000.0 ? text_of("%.4g m", distance_m) : text_of("%.4g km", distance_m / 1000.0);
}

// Whether the posts are a grid of degrees: it then fills its box in steps of degrees.
bool is_on_degrees(const SourceReport& source) {
    double across_deg = source.box.east_deg - source.box.west_deg;
    if (across_deg < 0.0) across_deg += 360.0;
    const auto fills = [](double extent_deg, int count, double spacing_deg) {
        return std::abs(extent_deg - (count - 1) * spacing_deg) <= 1e-3 * spacing_deg;
    };
    return fills(across_deg, source.columns, source.lon_spacing_deg) &&
           fills(source.box.north_deg - source.box.south_deg, source.rows, source.lat_spacing_deg);
}

// "92.63 m north-south and 63.97 m east-west", at the source's middle; "30 m of its CRS (29.98 m on the
// ground)".
std::string spacing_text(const SourceReport& source) {
    if (const auto own_m = projected_spacing_m(source))
        return text_of("%.6g m of its CRS (", *own_m) + distance_text(source.spacing_m) + " on the ground)";
    if (!is_on_degrees(source)) return distance_text(source.spacing_m);
    const double middle_deg = 0.5 * (source.box.south_deg + source.box.north_deg);
    const double parallel_m =
        prime_vertical_radius_m(middle_deg) * std::cos(radians_from_deg(middle_deg).rad);
    return distance_text(radians_from_deg(source.lat_spacing_deg).rad * meridian_radius_m(middle_deg)) +
           " north-south and " + distance_text(radians_from_deg(source.lon_spacing_deg).rad * parallel_m) +
           " east-west";
}

// "m", whatever a file calls the metre.
std::string short_unit(HeightUnit unit) {
    if (metres_in(unit.name) == 1.0) unit.name = "m";
    return unit_words(unit);
}

// What a file says of itself that many files often say alike.
std::vector<std::string> common_facts(const SourceReport& source) {
    std::vector<std::string> facts{
        format_words(source), "posts are " + posts_words(source.posts_are), source.crs,
        horizontal_words(source.horizontal_datum),
        datum_words(source.vertical_datum) + " in " + short_unit(source.height_unit)};
    facts.push_back(source.placement ? placement_text(*source.placement) : "");
    facts.push_back(source.attribution.empty() ? "attribution not stated" : source.attribution);
    return facts;
}

std::string all_of(const std::vector<std::string>& facts) {
    std::string text;
    for (const std::string& fact : facts)
        if (!fact.empty()) text += (text.empty() ? "" : "; ") + fact;
    return text;
}

// H at a source's posts in the region.
std::string heights_of(const SourceReport& source) {
    return source.is_all_void() ? "none: all its posts are void"
                                : heights_text(source.lowest_m, source.highest_m);
}

std::string heights_lines(const SourceReport& source) {
    const std::string of_region = heights_of(source);
    if (!source.stored) return line("H", of_region);
    if (is_as_stored(source)) return line("H", of_region + ", as the file stores them");
    return line("stored", stored_text(*source.stored) + ": the file's own values") +
           line("H", of_region + " at the region's posts");
}

std::string resampling_lines(const SourceReport& source) {
    if (!source.resampling) return "";
    const Resampling& found = *source.resampling;
    std::string text = line("resampling", (found.worst ? "up to " : "") + resampling_words(found));
    if (found.highest) text += line("highest", "its post of " + post_words(*found.highest));
    if (found.lowest) text += line("lowest", "its post of " + post_words(*found.lowest));
    return text;
}

std::string one_file(const SourceReport& source, Posts posts) {
    std::string text = one_line(source.path) + "\n";
    text += line("format", format_words(source) + ", posts are " + posts_words(source.posts_are));
    text += line("coordinates", source.crs);
    if (const std::string datum = horizontal_words(source.horizontal_datum); !datum.empty())
        text += line("datum", datum);
    text += line("heights", datum_words(source.vertical_datum) + ", in " + short_unit(source.height_unit));
    const std::string degrees =
        text_of("%.6g x %.6g degrees (", source.lon_spacing_deg, source.lat_spacing_deg);
    text += line("posts", text_of("%d x %d, every ", source.columns, source.rows) +
                              (!projected_spacing_m(source) ? degrees + spacing_text(source) + ")"
                                                            : spacing_text(source)));
    text += line("box", box_text(source.box.west_deg, source.box.south_deg, source.box.east_deg,
                                 source.box.north_deg));
    text += posts == Posts::read ? heights_lines(source) : line("H", "not read");
    if (posts == Posts::read) text += line("void posts", voids_text(source));
    if (source.placement) text += line("placement", placement_text(*source.placement));
    text += resampling_lines(source);
    return text + line("attribution", source.attribution.empty() ? "not stated" : source.attribution);
}

std::string line_of_file(const SourceReport& source, Posts posts, const std::vector<std::string>& own_facts) {
    std::string text = one_line(source.path);
    text +=
        text_of("  box %.6g,%.6g,%.6g,%.6g; %d x %d posts, every ", source.box.west_deg, source.box.south_deg,
                source.box.east_deg, source.box.north_deg, source.columns, source.rows);
    text += spacing_text(source);
    const bool differs = posts == Posts::read && source.stored && !is_as_stored(source);
    if (differs) text += "; stores " + stored_text(*source.stored);
    text += "; H " + (posts == Posts::read ? heights_of(source) : std::string("not read")) +
            (differs ? " at the region's posts" : "");
    if (source.resampling) text += "; resampled: up to " + resampling_words(*source.resampling);
    if (source.voids > 0) text += "; void posts: " + voids_text(source);
    if (source.seams.disagreeing_posts > 0)
        text += "; " + counted(source.seams.disagreeing_posts, "post differs", "posts differ") +
                " from another file's, by up to " + text_of("%.4g m", source.seams.largest_difference_m);
    if (const std::string own = all_of(own_facts); !own.empty()) text += "; " + own;
    return one_line(text) + "\n";
}

std::string files_text(const std::vector<SourceReport>& sources, Posts posts) {
    if (sources.size() == 1) return one_file(sources.front(), posts);
    std::vector<std::vector<std::string>> own;
    for (const SourceReport& source : sources) own.push_back(common_facts(source));
    std::vector<std::string> shared;
    for (std::size_t fact = 0; !own.empty() && fact < own.front().size(); ++fact) {
        const std::string first = own.front()[fact];
        if (!std::ranges::all_of(own, [&](const auto& facts) { return facts[fact] == first; })) continue;
        shared.push_back(first);
        for (auto& facts : own) facts[fact].clear();
    }
    std::string text = "files: " + grouped(sources.size());
    if (const std::string all = all_of(shared); !all.empty()) text += ", all of them: " + one_line(all);
    text += "\n";
    for (std::size_t i = 0; i < sources.size(); ++i) text += line_of_file(sources[i], posts, own[i]);
    return text;
}

std::string region_voids(const RegionGrid& grid) {
    std::string text = grid.void_posts() == 0 ? "none" : grouped(grid.void_posts());
    if (grid.filled > 0) text += " left, " + grouped(grid.filled) + " filled from their neighbours";
    if (!grid.classifies_voids)
        return text +
               " without a height, void in their file or outside the rasters: which, a baked region's part "
               "does not tell";
    if (grid.void_posts() > 0 && grid.void_method == VoidMethod::holes)
        text += std::string(", left as holes (") + (grid.file ? "baking with " : "") +
                "--fill-voids fills those near others)";
    return text;
}

std::string outside_text(const RegionGrid& grid) {
    if (!grid.classifies_voids) return "not told apart from void posts in this baked region";
    if (grid.outside == 0) return "none";
    return counted(grid.outside, "post", "posts") + " of the region's box, beyond the edges of the " +
           (grid.sources.size() == 1 ? "raster" : "rasters");
}

std::string missing_text(const RegionGrid& grid) {
    if (grid.missing_cells.empty()) return "none";
    std::string text = counted(grid.missing_cells.size(), "tile", "tiles") +
                       " (cells of a degree without a file), " + counted(grid.in_missing, "post", "posts") +
                       ":";
    for (const std::string& cell : grid.missing_cells) text += " " + cell;
    return text;
}

std::string overlaps(const SeamReport& seams) {
    if (seams.shared_posts == 0) return "none";
    const std::string shared =
        counted(seams.shared_posts, "post is", "posts are") + " in more than one file, ";
    if (seams.disagreeing_posts == 0) return shared + "with the same height";
    return shared + grouped(seams.disagreeing_posts) + " of them with other heights, by up to " +
           text_of("%.4g m", seams.largest_difference_m) +
           "; the finer spacing wins, among equals the first by file name";
}

// A cluster graph level by level. All of one level cover the ground once.
std::string levels_text(const RegionFile& file, const ClusterOutline& graph) {
    std::string text = text_of("  %-12s%6s %12s %10s %10s %12s\n", "", "level", "triangles", "clusters",
                               "groups", "error up to");
    const auto add = [&](std::size_t level, std::uint64_t triangles, std::uint64_t clusters,
                         std::uint64_t groups, double error_m) {
        text += text_of("  %-12s%6zu %12s %10s %10s %10.2f m\n", "", level, grouped(triangles).c_str(),
                        grouped(clusters).c_str(), grouped(groups).c_str(), error_m);
    };
    add(0, file.outline().triangles, graph.leaves, 0, 0.0);
    for (std::size_t i = 0; i < graph.levels.size(); ++i) {
        const GraphLevel& level = graph.levels[i];
        add(i + 1, level.triangles_out, level.clusters_out, level.groups, level.largest_error_m);
    }
    return text;
}

// "5,660,000 bytes: 1,780,000 of the grid (1.23 for each post), 3,880,000 of the clusters"
std::string size_text(const RegionFile& file, const ClusterFile* clusters) {
    const auto posts = static_cast<double>(file.outline().grid.post_count());
    const std::string each = text_of("%.2f for each post", static_cast<double>(file.bytes()) / posts);
    const std::uint64_t whole = file.file_bytes();
    if (clusters)
        return counted(whole, "byte", "bytes") + ": " + grouped(file.bytes()) + " of the grid (" + each +
               "), " + grouped(clusters->bytes()) + " of the clusters";
    if (whole != file.bytes())
        return counted(file.bytes(), "byte", "bytes") + " of the file's " + grouped(whole) + ", " + each;
    return counted(whole, "byte", "bytes") + ", " + each;
}

std::string baked_text(const RegionFile& file, const ClusterFile* clusters) {
    const int levels = file.order().levels();
    std::string detail = std::to_string(levels) + ": full detail (" +
                         counted(file.outline().triangles, "triangle", "triangles") + ")";
    if (levels > 1)
        detail += ", and " + counted(static_cast<std::uint64_t>(levels - 1), "coarser one", "coarser ones") +
                  " for ground that is far away";
    std::string text = one_line(file.path()) + "\n";
    text += line("format", "baked region (.oro), version " + std::to_string(ChunkTable::version));
    text += line("levels", detail);
    if (clusters)
        text += line("clusters", counted(clusters->outline().triangles, "triangle", "triangles") + " in " +
                                     counted(clusters->outline().levels.size(), "level", "levels") +
                                     " above the grid, " + counted(clusters->bytes(), "byte", "bytes"));
    if (clusters) text += levels_text(file, clusters->outline());
    return text + line("size", size_text(file, clusters));
}

}  // namespace

std::string info_text(const RegionGrid& grid) {
    const PostGrid& posts = grid.field.grid;
    const HeightRange range = height_range(grid.field);
    std::string text = grid.file ? baked_text(*grid.file, grid.clusters.get()) : "";
    text += "region: " + counted(grid.sources.size(), "file", "files") + "\n";
    text += line("box", box_text(posts.west_deg(), posts.south_deg(), posts.east_deg(), posts.north_deg()));
    text += line("posts",
                 posts.net ? text_of("%d x %d, the file's own, every %.6g x %.6g m at most", posts.columns(),
                                     posts.rows(), posts.net->column_m(), posts.net->row_m())
                           : text_of("%d x %d, every %.6g x %.6g degrees", posts.columns(), posts.rows(),
                                     posts.lon.spacing_deg(), posts.lat.spacing_deg()));
    text +=
        line("H", heights_text(static_cast<double>(range.lowest_m), static_cast<double>(range.highest_m)) +
                      " above the geoid " + grid.geoid);
    if (const std::string resampled = resampling_sentence(grid); !resampled.empty())
        text += line("resampling", resampled);
    text += line("void posts", region_voids(grid));
    text += line("outside", outside_text(grid));
    text += line("missing", missing_text(grid));
    text += line("overlaps", overlaps(grid.seams));
    for (const std::string& note : own_notes(grid)) text += line("note", note);
    return text + files_text(grid.sources, Posts::read);
}

std::string unread_files_text(const FileListing& listing) {
    std::string text;
    for (const bool damaged : {true, false}) {
        std::string lines;
        std::uint64_t count = 0;
        for (const ListedFile& file : listing.files) {
            if (file.report || file.damaged != damaged) continue;
            lines += one_line(file.path) + "  " + one_line(file.reason) + "\n";
            ++count;
        }
        if (count > 0)
            text += (damaged ? "cannot be opened: " : "passed over, without elevation: ") +
                    counted(count, "file", "files") + "\n" + lines;
    }
    return text;
}

std::string listing_text(const FileListing& listing) {
    std::vector<SourceReport> sources;
    std::string leave_out;
    std::uint64_t count = 0;
    for (const ListedFile& file : listing.files) {
        if (file.report) sources.push_back(*file.report);
        if (file.leave_out.empty()) continue;
        ++count;
        leave_out += one_line(file.path) + "  " + one_line(file.leave_out) + "\n";
    }
    std::string text = (sources.empty() ? "" : unread_text(sources)) + unread_files_text(listing);
    if (count > 0) text += "to be left out: " + counted(count, "file", "files") + "\n" + leave_out;
    return text;
}

std::string unread_text(const std::vector<SourceReport>& sources) {
    return files_text(sources, Posts::not_read);
}

}  // namespace oro
