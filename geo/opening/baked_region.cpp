#include "geo/opening/baked_region.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "core/baked/file_pages.h"
#include "core/base/container.h"
#include "core/base/parallel.h"
#include "geo/files/letter_case.h"
#include "geo/posts/holes.h"
#include "geo/posts/own_posts.h"
#include "geo/region/region_description.h"
#include "geo/region/region_fingerprints.h"
#include "geo/region/region_grid.h"

namespace oro {
namespace {

constexpr std::size_t posts_in_memory_bytes = 64U << 20U;

Result<void> check_request(const RegionRequest& request, const std::string& path) {
    if (request.paths.size() > 1)
        return Error{ErrorKind::usage, path,
                     "is a baked region, which is opened alone: leave out the other paths, or bake all anew"};
    const char* const option = !request.height_unit.empty()       ? "--height-unit"
                               : !request.source_crs.empty()      ? "--source-crs"
                               : !request.source_vertical.empty() ? "--source-vertical"
                               : request.fill_voids               ? "--fill-voids"
                               : request.strict_datum             ? "--strict-datum"
                               : request.listed_first             ? "--order"
                               : request.feather_m > 0.0          ? "--feather"
                                                                  : nullptr;
    if (option == nullptr) return {};
    return Error{ErrorKind::usage, option,
                 "is decided when a region is baked, and " + path + " is: bake its sources anew with it"};
}

// The file's posts as the grid of one source, so that a box is cut out of it as out of tiles.
Source source_of(const PostGrid& grid) {
    Source source;
    source.on_degrees = true;
    source.full_circle = grid.wraps_longitude();
    source.lat_axis = {grid.lat.posts_per_deg, grid.north_deg(), -1, grid.rows()};
    source.lon_axis = {grid.lon.posts_per_deg, grid.west_deg(), +1, grid.columns()};
    source.lat_spacing_deg = grid.lat.spacing_deg();
    source.lon_spacing_deg = grid.lon.spacing_deg();
    source.lon = {grid.west_deg(), grid.east_deg()};
    source.south_deg = grid.south_deg();
    source.north_deg = grid.north_deg();
    return source;
}

// Consecutive columns of the cut that lie in one page of the file.
struct Run {
    int page_column;
    int first_in_page;
    int first_in_cut;
    int columns;
};

// Number of the page that holds a post of an axis: a page's last row or column is the next one's first.
int page_of(int post, int pages) {
    return std::min(post / static_cast<int>(gpu::page_quads), pages - 1);
}

// A part of the file's grid, and its first post there; of a grid on latitudes and longitudes its columns are
// found by their angles, for it may go on round the Earth.
struct Cut {
    PostGrid grid;
    int first_row{};
    int first_column{};  // on a net
};

Result<Cut> cut_of(const RegionFile& file, const BoundingBox& box) {
    const PostGrid& whole = file.outline().grid;
    const Error nothing{ErrorKind::no_data, file.path(), "no elevation data in the box that was asked for"};
    if (whole.net) {
        const PostWindow part = posts_in_box(*whole.net, unwrapped(box));
        if (part.rows < 2 || part.columns < 2) return nothing;
        ORO_TRY(auto net, whole.net->part(part.row, part.column, part.rows, part.columns));
        return Cut{grid_on_net(std::move(net)), part.row, part.column};
    }
    const Source source = source_of(whole);
    const auto extent = region_extent({&source, 1}, box);
    if (!extent) return nothing;
    ORO_TRY(PostGrid cut, region_grid({&source, 1}, *extent));
    const auto first_row = static_cast<int>(std::lround(whole.lat.index_at(cut.north_deg())));
    if (first_row < 0 || first_row > whole.rows() - cut.rows())
        return Error{ErrorKind::failed, file.path(), "has no rows of posts where its box says"};
    return Cut{std::move(cut), first_row, 0};
}

std::vector<Run> runs_of(const PostGrid& whole, const Cut& of, int page_columns) {
    const PostGrid& cut = of.grid;
    std::vector<Run> runs;
    for (int c = 0; c < cut.columns(); ++c) {
        const auto column =
            cut.net ? of.first_column + c
                    : std::clamp(static_cast<int>(std::lround(whole.column_at(cut.lon.at_deg(c)))), 0,
                                 whole.columns() - 1);
        const int page = page_of(column, page_columns);
        const int in_page = column - page * static_cast<int>(gpu::page_quads);
        if (!runs.empty() && runs.back().page_column == page &&
            in_page == runs.back().first_in_page + runs.back().columns) {
            ++runs.back().columns;
            continue;
        }
        runs.push_back({page, in_page, c, 1});
    }
    return runs;
}

// The file's posts on a grid that is a part of its own.
Result<std::vector<float>> posts_of(const RegionFile& file, const Cut& of, const Progress& progress) {
    constexpr int quads = static_cast<int>(gpu::page_quads), stride = static_cast<int>(gpu::height_stride);
    const PostGrid& cut = of.grid;
    const int first_row = of.first_row;
    const PageLayout layout = file.order().layout(0);
    const std::vector<Run> runs = runs_of(file.outline().grid, of, layout.columns);
    const int first_page = page_of(first_row, layout.rows);
    const int last_page = page_of(first_row + cut.rows() - 1, layout.rows);
    // Memory is taken for pages that are there, not for what the header says.
    for (int page_row = first_page; page_row <= last_page; ++page_row) {
        for (const Run& run : runs) ORO_CHECK(file.record({page_row, run.page_column, 0}));
    }
    std::vector<float> H_m(cut.post_count());
    const auto payload = std::make_unique<PagePayload>();
    for (int row = 0; row < cut.rows();) {
        const int page_row = page_of(first_row + row, layout.rows);
        const int in_page = first_row + row - page_row * quads;
        const int rows = std::min(cut.rows() - row, quads + 1 - in_page);
        if (progress) progress(static_cast<double>(row) / cut.rows(), "reading " + file.path());
        for (const Run& run : runs) {
            ORO_CHECK(file.payload({page_row, run.page_column, 0}, *payload));
            for (int r = 0; r < rows; ++r)
                std::copy_n(payload->H_m.begin() + (in_page + r + 1) * stride + run.first_in_page + 1,
                            run.columns,
                            H_m.begin() + (std::ptrdiff_t{row} + r) * cut.columns() + run.first_in_cut);
        }
        row += rows;
    }
    return H_m;
}

// The nodes of an axis that a part of it needs, those that GeoidOfRegion would take; the axis as it is where
// it holds no such part.
GridAxis axis_between(const GridAxis& nodes, double first_deg, double last_deg) {
    const double first = std::floor(nodes.index_at(first_deg));
    const double last = std::ceil(nodes.index_at(last_deg));
    if (!(first >= 0.0 && last <= nodes.count - 1 && first <= last)) return nodes;
    GridAxis part = nodes;
    part.first += part.step * static_cast<std::int64_t>(first);
    part.count = static_cast<int>(last - first) + 1;
    return part;
}

UndulationField undulation_of(const UndulationField& whole, const PostGrid& cut) {
    UndulationField part;
    if (whole.N_m.empty()) return whole;
    GridAxis lon = whole.lon;
    // A cut beyond the antimeridian is named by its own longitudes, a whole turn away from the file's.
    const double turn_nodes = 360.0 * lon.posts_per_deg;
    if (cut.west_deg() < lon.at_deg(0) && turn_nodes == std::round(turn_nodes))
        lon.first -= static_cast<std::int64_t>(turn_nodes);
    part.lat = axis_between(whole.lat, cut.north_deg(), cut.south_deg());
    part.lon = axis_between(lon, cut.west_deg(), cut.east_deg());
    const auto first_row = static_cast<std::size_t>(whole.lat.first - part.lat.first);
    const auto first_column = static_cast<std::size_t>(part.lon.first - lon.first);
    for (std::size_t r = 0; r < static_cast<std::size_t>(part.lat.count); ++r) {
        const auto from =
            whole.N_m.begin() +
            static_cast<std::ptrdiff_t>((first_row + r) * static_cast<std::size_t>(lon.count) + first_column);
        part.N_m.insert(part.N_m.end(), from, from + part.lon.count);
    }
    return part;
}

// True when a whole-degree cell and the grid share more than a line. False for what is no cell's name.
bool touches(const std::string& cell, const PostGrid& grid) {
    const auto box = parse_tile_range(cell);
    if (!box.ok()) return false;
    Source source;
    source.south_deg = box->south_deg;
    source.north_deg = box->north_deg;
    source.lon = {box->west_deg, box->west_deg + 1.0};
    return meets(source, {grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg()});
}

Result<void> clip_to_box(RegionGrid& grid, const RegionFile& file, const BoundingBox& box,
                         const Progress& progress) {
    ORO_TRY(const Cut part, cut_of(file, box));
    const PostGrid& cut = part.grid;
    ORO_TRY(grid.field.H_m, posts_of(file, part, progress));
    grid.field.grid = cut;
    grid.field.undulation = undulation_of(file.outline().undulation, cut);
    if (grid.posts_crs) {
        auto& m = grid.posts_crs->crs_from_post;
        m[0] += m[1] * part.first_column + m[2] * part.first_row;
        m[3] += m[4] * part.first_column + m[5] * part.first_row;
    }
    if (cut.net) grid.field.N_of_posts_m = N_of_net_m(*cut.net, grid.field.undulation, thread_count());
    grid.posts_hash = posts_hash(grid.field);
    const std::uint64_t region_voids = grid.voids;
    grid.voids = static_cast<std::uint64_t>(std::ranges::count_if(grid.field.H_m, is_void));
    if (grid.voids == grid.field.H_m.size())
        return Error{ErrorKind::no_data, file.path(), "no post in the box that was asked for has a height"};
    std::erase_if(grid.missing_cells, [&](const std::string& cell) { return !touches(cell, cut); });
    // Which of the others are void in their source and which have none is told for the whole alone; where all
    // of it is one of them, so is the part.
    const bool only_outside = grid.outside > 0 && region_voids == grid.outside + grid.in_missing;
    const Uncovered uncovered =
        count_uncovered(grid.field, grid.missing_cells, [](std::size_t) { return false; });
    grid.in_missing = uncovered.in_missing;
    const bool none_outside = grid.classifies_voids && grid.outside == 0;
    grid.classifies_voids = only_outside || none_outside || grid.voids == uncovered.in_missing;
    grid.outside = only_outside ? uncovered.outside : 0;
    grid.notes.push_back(clipped_from + file.path() +
                         ": sources, seams and filled posts are told for all of it");
    return {};
}

// The grid that one region file holds, whole or cut to the request's box.
Result<RegionGrid> grid_in(std::shared_ptr<const RegionFile> file, const RegionRequest& request,
                           const Progress& progress) {
    const std::string path = file->path();
    ORO_TRY(RegionGrid grid, region_from_description(file->outline().description, path));
    if (grid.voids != file->outline().voids)
        return Error{ErrorKind::failed, path,
                     "its description tells of " + std::to_string(grid.voids) +
                         " void posts, its header of " + std::to_string(file->outline().voids)};
    const bool on_net = file->outline().grid.net != nullptr;
    if (on_net != grid.posts_crs.has_value())
        return Error{ErrorKind::failed, path,
                     on_net ? "its description does not tell the CRS of its posts"
                            : "its description tells a CRS of posts that lie on latitudes and longitudes"};
    if (on_net && request.resample)
        return Error{ErrorKind::usage, path,
                     "keeps the posts of its files where their CRS has them: bake the files with --resample"};
    if (file->outline().triangles == 0)
        return Error{ErrorKind::no_data, path, "no triangle in it has a height at each corner"};
    if (request.box) {
        ORO_CHECK(clip_to_box(grid, *file, *request.box, progress));
    } else {
        grid.field = field_of_file(file, posts_in_memory_bytes);
        grid.file = file;
    }
    grid.geoid_fingerprint = undulation_fingerprint(grid.field.undulation);
    return grid;
}

}  // namespace

std::optional<std::string> baked_path(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
        std::error_code ignored;
        if ((lower_case(path).ends_with(".oro") && !std::filesystem::is_directory(path, ignored)) ||
            looks_baked(path))
            return path;
    }
    return std::nullopt;
}

Result<std::vector<BakedGrid>> open_baked_grids(const std::string& path, const RegionRequest& request) {
    ORO_CHECK(check_request(request, path));
    return open_baked_file(path);
}

Result<RegionGrid> read_baked_grid(const BakedGrid& baked, const RegionRequest& request,
                                   const Progress& progress) {
    ORO_TRY(RegionGrid made, grid_in(baked.region, request, progress));
    if (made.file) made.clusters = baked.clusters;
    made.rank = static_cast<int>(baked.rank);
    return made;
}

}  // namespace oro
