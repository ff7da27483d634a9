#include "geo/refined/refined_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/refined/refined_posts.h"
#include "core/terrain/cell_diagonal.h"
#include "core/terrain/post_spacing.h"
#include "core/terrain/triangle_heights.h"

namespace oro {
namespace {

// H of the snow line by latitude: that of the style natural (data/README.md), linear between.
struct SnowLine {
    double lat_deg;
    double H_m;
};
constexpr std::array snow_line{
    SnowLine{-90.0, -300.0}, SnowLine{-68.0, -200.0}, SnowLine{-60.0, 150.0},  SnowLine{-54.0, 900.0},
    SnowLine{-50.0, 1200.0}, SnowLine{-45.0, 1900.0}, SnowLine{-40.0, 2400.0}, SnowLine{-33.0, 4300.0},
    SnowLine{-25.0, 5700.0}, SnowLine{-18.0, 5500.0}, SnowLine{-8.0, 5000.0},  SnowLine{0.0, 4800.0},
    SnowLine{10.0, 4850.0},  SnowLine{20.0, 5200.0},  SnowLine{28.0, 5700.0},  SnowLine{32.0, 5500.0},
    SnowLine{36.0, 4800.0},  SnowLine{40.0, 4000.0},  SnowLine{44.0, 3300.0},  SnowLine{47.0, 2950.0},
    SnowLine{52.0, 2300.0},  SnowLine{58.0, 1700.0},  SnowLine{62.0, 1500.0},  SnowLine{66.0, 1200.0},
    SnowLine{70.0, 900.0},   SnowLine{75.0, 500.0},   SnowLine{79.0, 300.0},   SnowLine{82.0, 100.0},
    SnowLine{90.0, -100.0}};
// Level ground up to so much below it is most often ice, on slopes up to that.
constexpr double ice_below_line_m = 550.0, ice_slope_deg = 10.0;

double snow_line_m(double lat_deg) {
    const auto* const above =
        std::ranges::find_if(snow_line, [&](const SnowLine& one) { return one.lat_deg >= lat_deg; });
    if (above == snow_line.begin()) return above->H_m;
    if (above == snow_line.end()) return snow_line.back().H_m;
    const SnowLine& below = *(above - 1);
    return std::lerp(below.H_m, above->H_m, (lat_deg - below.lat_deg) / (above->lat_deg - below.lat_deg));
}

// The grid that is the ground at a place.
const RegionGrid* ground_at(const Region& region, double lat_deg, double lon_deg) {
    const RegionGrid* there = nullptr;
    for (const RegionGrid& grid : region.grids)
        if ((there == nullptr || grid.rank < there->rank) && grid.field.surface_H_m(lat_deg, lon_deg))
            there = &grid;
    return there;
}

// Posts from the post nearest to a place on, so many metres each way, as far as the grid has any.
GridPart part_around(const PostGrid& grid, const DetailRequest& request, double radius_m) {
    const PostNumber at = grid.post_at(request.lat_deg, request.lon_deg);
    const PostSpacing spacing = post_spacing_at(grid, at.row, at.column);
    const auto along = [&](double number, double spacing_m, int count) {
        const double reach = std::max(1.0, std::round(radius_m / spacing_m));
        const int first = static_cast<int>(std::clamp(std::round(number) - reach, 0.0, count - 2.0));
        const int last = static_cast<int>(std::clamp(std::round(number) + reach, first + 1.0, count - 1.0));
        return std::pair{first, last - first + 1};
    };
    const auto [first_row, rows] = along(at.row, spacing.row_m, grid.rows());
    const auto [first_column, columns] = along(at.column, spacing.column_m, grid.columns());
    return {first_row, rows, first_column, columns};
}

std::uint64_t fine_posts(const GridPart& part, int halvings) {
    const auto along = [&](int posts) {
        return (static_cast<std::uint64_t>(posts - 1) << static_cast<unsigned>(halvings)) + 1;
    };
    return along(part.rows) * along(part.columns);
}

std::string million(std::uint64_t count) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f million", static_cast<double>(count) * 1.0e-6);
    return text;
}

// The largest radius of whole tenths of a kilometre whose posts are not too many.
double fitting_radius_m(const PostGrid& grid, const DetailRequest& request) {
    double radius_m = usual_detail_m;
    while (radius_m > 1.0 &&
           fine_posts(part_around(grid, request, radius_m), request.halvings) > most_detail_posts)
        radius_m *= 0.97;
    return radius_m;
}

Result<GridPart> part_asked_for(const PostGrid& grid, const DetailRequest& request, double& radius_m) {
    radius_m = request.radius_m.value_or(fitting_radius_m(grid, request));
    const GridPart part = part_around(grid, request, radius_m);
    const std::uint64_t posts = fine_posts(part, request.halvings);
    if (posts <= most_detail_posts) return part;
    char text[200];
    std::snprintf(text, sizeof text,
                  "asks for %s posts within %g km, more than %s; a radius of %.1f km, or fewer halvings, "
                  "would fit",
                  million(posts).c_str(), radius_m / 1000.0, million(most_detail_posts).c_str(),
                  std::floor(fitting_radius_m(grid, request) / 100.0) / 10.0);
    return Error{ErrorKind::usage, "--detail", text};
}

// Water, ice and built land of a land cover.
bool keeps_still(const CoverClass& one) {
    return std::ranges::any_of(one.materials, [](Material material) {
        return material == Material::water || material == Material::snow || material == Material::built;
    });
}

Result<void> add_still_of_cover(const HeightField& field, const GridPart& part, const CoverMap& cover,
                                std::vector<char>& still) {
    const auto columns = static_cast<std::size_t>(part.columns);
    std::vector<double> lat_deg(columns), lon_deg(columns);
    std::vector<int> codes(columns);
    for (int row = part.first_row; row < part.first_row + part.rows; ++row) {
        for (std::size_t i = 0; i < columns; ++i) {
            const PostPlace place = field.grid.place_at(row, part.first_column + static_cast<double>(i));
            lat_deg[i] = place.lat_deg;
            lon_deg[i] = place.lon_deg;
        }
        ORO_CHECK(cover.codes_at(lat_deg, lon_deg, codes));
        for (std::size_t i = 0; i < columns; ++i) {
            const CoverClass* const one =
                codes[i] == no_cover_code ? nullptr : cover.table().class_of(codes[i]);
            if (one != nullptr && keeps_still(*one))
                still[part.number(row, part.first_column + static_cast<int>(i))] = 1;
        }
    }
    return {};
}

// What is level high up, by the slope between the posts beside each.
void add_ice(const HeightField& field, const GridPart& part, std::vector<char>& still) {
    const int last_row = field.grid.rows() - 1, last_column = field.grid.columns() - 1;
    const double steepest = std::tan(radians_from_deg(ice_slope_deg).rad);
    in_parallel(part.rows, thread_count(), [&](int down) {
        const int row = part.first_row + down;
        for (int column = part.first_column; column < part.first_column + part.columns; ++column) {
            const float own_m = field.H_at_post_m(row, column);
            if (is_void(own_m)) continue;
            const double lat_deg = field.grid.place_at(row, column).lat_deg;
            if (double{own_m} < snow_line_m(lat_deg) - ice_below_line_m) continue;
            const PostSpacing spacing = post_spacing_at(field.grid, row, column);
            const auto rise = [&](int rows, int columns, double spacing_m) {
                const float a_m = field.H_at_post_m(std::clamp(row - rows, 0, last_row),
                                                    std::clamp(column - columns, 0, last_column)),
                            b_m = field.H_at_post_m(std::clamp(row + rows, 0, last_row),
                                                    std::clamp(column + columns, 0, last_column));
                return is_void(a_m) || is_void(b_m) ? 0.0 : (double{b_m} - double{a_m}) / (2.0 * spacing_m);
            };
            if (std::hypot(rise(1, 0, spacing.row_m), rise(0, 1, spacing.column_m)) < steepest)
                still[part.number(row, column)] = 1;
        }
    });
}

Result<std::vector<char>> still_posts(const HeightField& field, const GridPart& part, const CoverMap* cover) {
    std::vector<char> still = level_posts(field, part);
    if (cover == nullptr) {
        add_ice(field, part, still);
        return still;
    }
    ORO_CHECK(add_still_of_cover(field, part, *cover, still));
    return still;
}

// All but the posts, of the grid that it lies over.
RegionGrid grid_of_detail(const RegionGrid& data, const GridDetail& detail, HeightField field) {
    RegionGrid made;
    made.field = std::move(field);
    if (data.posts_crs) {
        made.posts_crs = data.posts_crs;
        auto& m = made.posts_crs->crs_from_post;
        const double scale = std::ldexp(1.0, -detail.halvings);
        for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
            m[i] += m[i + 1] * detail.part.first_column + m[i + 2] * detail.part.first_row;
            m[i + 1] *= scale;
            m[i + 2] *= scale;
        }
    }
    made.sources = data.sources;
    made.geoid = data.geoid;
    made.geoid_left_out = data.geoid_left_out;
    if (made.field.grid.net && !data.geoid_left_out.N_m.empty())
        made.N_of_posts_left_out_m = N_of_net_m(*made.field.grid.net, data.geoid_left_out, thread_count());
    for (const float H_m : made.field.H_m) made.voids += is_void(H_m) ? 1 : 0;
    made.void_method = data.void_method;
    made.classifies_voids = false;
    made.rank = data.rank;
    made.detail = detail;
    return made;
}

Result<RegionGrid> made_detail(const RegionGrid& data, GridDetail detail, const CoverMap* cover) {
    ORO_TRY(const std::vector<char> still, still_posts(data.field, detail.part, cover));
    ORO_TRY(RefinedPosts posts, refined_posts(data.field, detail.part, detail.halvings, still));
    detail.rms_m = posts.rms_m;
    detail.largest_m = posts.largest_m;
    detail.posts = posts.posts;
    detail.still = posts.still;
    return grid_of_detail(data, detail, std::move(posts.field));
}

}  // namespace

Result<RegionGrid> whole_with_detail(const RegionGrid& data, int halvings) {
    const PostGrid& grid = data.field.grid;
    GridDetail detail;
    detail.halvings = halvings;
    detail.part = {0, grid.rows(), 0, grid.columns()};
    const PostPlace middle = grid.place_at(0.5 * (grid.rows() - 1), 0.5 * (grid.columns() - 1));
    detail.lat_deg = middle.lat_deg;
    detail.lon_deg = middle.lon_deg;
    const PostSpacing spacing = post_spacing_at(grid, 0.5 * (grid.rows() - 1), 0.5 * (grid.columns() - 1));
    detail.radius_km =
        0.0005 * std::max(spacing.row_m * (grid.rows() - 1), spacing.column_m * (grid.columns() - 1));
    const std::uint64_t posts = fine_posts(detail.part, halvings);
    if (posts > most_detail_posts)
        return Error{ErrorKind::usage, "--detail",
                     "asks for " + million(posts) + " posts, more than " + million(most_detail_posts) +
                         ": give a part with --bbox, or fewer halvings"};
    return made_detail(data, detail, nullptr);
}

Result<void> add_detail(Region& region, const DetailRequest& request,
                        const std::shared_ptr<const CoverMap>& cover) {
    const RegionGrid* const data = ground_at(region, request.lat_deg, request.lon_deg);
    if (data == nullptr)
        return Error{ErrorKind::no_data, "--detail", "there is no ground at the eye to put posts between"};
    if (data->field.posts && !data->file)
        return Error{
            ErrorKind::usage, "--detail",
            "lies between posts of data that are all here, and these are made where they are looked at; "
            "narrow the region with --bbox"};
    GridDetail detail;
    detail.halvings = request.halvings;
    detail.lat_deg = request.lat_deg;
    detail.lon_deg = request.lon_deg;
    detail.by_cover = cover != nullptr;
    double radius_m = 0.0;
    ORO_TRY(detail.part, part_asked_for(data->field.grid, request, radius_m));
    detail.radius_km = radius_m / 1000.0;
    ORO_TRY(RegionGrid made, made_detail(*data, detail, cover.get()));
    // Over its grid, and under those that lie over that one.
    for (RegionGrid& grid : region.grids)
        if (grid.rank >= made.rank) ++grid.rank;
    made.detail->data_rank = made.rank + 1;
    region.grids.push_back(std::move(made));
    return {};
}

const RegionGrid* detail_of(const Region& region) {
    const auto found =
        std::ranges::find_if(region.grids, [](const RegionGrid& grid) { return grid.detail.has_value(); });
    return found == region.grids.end() ? nullptr : &*found;
}

const RegionGrid* data_under_detail(const Region& region) {
    const RegionGrid* const detail = detail_of(region);
    if (detail == nullptr) return nullptr;
    for (const RegionGrid& grid : region.grids) {
        if (grid.detail || grid.rank != detail->detail->data_rank) continue;
        // Grids beside each other may have one rank.
        const PostNumber at = grid.field.grid.post_at(detail->detail->lat_deg, detail->detail->lon_deg);
        if (at.row >= 0.0 && at.column >= 0.0 && at.row <= grid.field.grid.rows() - 1 &&
            at.column <= grid.field.grid.columns() - 1)
            return &grid;
    }
    return nullptr;
}

std::optional<double> invented_m(const RegionGrid& detail, const RegionGrid& data, double row,
                                 double column) {
    const auto surface_m = [](const HeightField& field, double y, double x) {
        const auto post_m = [&](int r, int c) -> std::optional<double> {
            const float H_m = field.H_at_post_m(r, c);
            return is_void(H_m) ? std::nullopt : std::optional(double{H_m});
        };
        const auto diagonal_at = [&](int r, int c) { return cell_diagonal(field, r, c); };
        return h_at_row_column_m(field.grid, post_m, diagonal_at, y, x);
    };
    const double scale = std::ldexp(1.0, -detail.detail->halvings);
    const std::optional<double> made_m = surface_m(detail.field, row, column);
    const std::optional<double> data_m = surface_m(data.field, detail.detail->part.first_row + row * scale,
                                                   detail.detail->part.first_column + column * scale);
    if (!made_m || !data_m) return std::nullopt;
    return *made_m - *data_m;
}

}  // namespace oro
