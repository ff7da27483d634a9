#include "core/terrain/post_grid.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/terrain/cell_diagonal.h"

namespace oro {

namespace {

// Rounding of an angle may put a place on the edge this many posts beyond it (some 0.1 mm).
constexpr double edge_slack_posts = 1.0e-6;

// The post number of a longitude on an axis: in the whole turn that falls onto the axis, or the nearest to
// it.
double turned_index(const GridAxis& lon, double lon_deg) {
    const double index = lon.index_at(lon_deg);
    const double last = lon.count - 1;
    if (index >= 0.0 && index <= last) return index;
    const double turn = 360.0 * lon.posts_per_deg;
    const double inside = index - std::floor(index / turn) * turn;
    if (inside <= last) return inside;
    return inside - last <= turn - inside ? inside : inside - turn;
}

using Between = UndulationField::Between;
Between between(double index, int count) {
    const double held = std::clamp(index, 0.0, static_cast<double>(count - 1));
    const int first = std::min(static_cast<int>(held), std::max(count - 2, 0));
    return {first, held - first};
}

// H on the triangles of one cell; u and v in [0, 1] from its north-west post to the south and east.
std::optional<double> H_in_cell_m(const HeightField& field, int row, int column, double u, double v,
                                  const std::vector<char>* masked) {
    const float north_west = field.H_at_post_m(row, column);
    const float south_east = field.H_at_post_m(row + 1, column + 1);
    if (is_void(north_west) || is_void(south_east)) return std::nullopt;
    if (cell_diagonal(field, row, column, masked) == Diagonal::sw_ne) {
        const bool west = west_of_diagonal(Diagonal::sw_ne, u, v) >= 0.0;
        const CellPlane plane = cell_plane(Diagonal::sw_ne, west, static_cast<double>(north_west),
                                           static_cast<double>(field.H_at_post_m(row, column + 1)),
                                           static_cast<double>(field.H_at_post_m(row + 1, column)),
                                           static_cast<double>(south_east));
        return plane.at_corner + u * plane.change_down + v * plane.change_right;
    }
    const double a = north_west;
    const double c = south_east;
    // On the diagonal both triangles give the same; one of them is enough.
    if (u >= v && !is_void(field.H_at_post_m(row + 1, column))) {
        const double b = field.H_at_post_m(row + 1, column);
        return a + u * (b - a) + v * (c - b);
    }
    if (v >= u && !is_void(field.H_at_post_m(row, column + 1))) {
        const double b = field.H_at_post_m(row, column + 1);
        return a + v * (b - a) + u * (c - b);
    }
    return std::nullopt;
}

}  // namespace

double PostGrid::column_at(double lon_deg) const {
    return turned_index(lon, lon_deg);
}

PostNumber PostGrid::post_at(double lat_deg, double lon_deg) const {
    if (net) return net->post_at(lat_deg, lon_deg);
    return {lat.index_at(lat_deg), column_at(lon_deg)};
}

PostPlace PostGrid::place_at(double row, double column) const {
    if (net) return net->place_at(row, column);
    return {north_deg() - row * lat.spacing_deg(), west_deg() + column * lon.spacing_deg()};
}

double PostGrid::row_step_rad() const {
    return net ? net->row_m() / wgs84_a_m : radians_from_deg(lat.spacing_deg()).rad;
}

double PostGrid::column_step_rad() const {
    return net ? net->column_m() / wgs84_a_m : radians_from_deg(lon.spacing_deg()).rad;
}

PostGrid grid_on_net(std::shared_ptr<const LatticeGeoreference> net) {
    // Its axes count, and say nothing else: what asks them for an angle gets no number.
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    PostGrid grid;
    grid.lat = {nothing, nothing, 0, -1, net->rows()};
    grid.lon = {nothing, nothing, 0, +1, net->columns()};
    grid.net = std::move(net);
    return grid;
}

float N_on_net_m(const UndulationField& undulation, const glm::dvec3& normal) {
    const PostPlace place = place_of_normal(normal);
    return static_cast<float>(undulation.at_m(place.lat_deg, place.lon_deg));
}

std::vector<float> N_of_net_m(const LatticeGeoreference& net, const UndulationField& undulation,
                              int threads) {
    std::vector<float> N_m;
    if (undulation.N_m.empty()) return N_m;
    const auto columns = static_cast<std::size_t>(net.columns());
    N_m.resize(static_cast<std::size_t>(net.rows()) * columns);
    in_parallel(net.rows(), threads, [&](int row) {
        std::vector<glm::dvec3> normals(columns);
        net.normals_of_row(row, 0, normals);
        for (std::size_t c = 0; c < columns; ++c)
            N_m[static_cast<std::size_t>(row) * columns + c] = N_on_net_m(undulation, normals[c]);
    });
    return N_m;
}

bool PostGrid::wraps_longitude() const {
    if (net) return false;
    return std::abs(lon.count - 1 - 360.0 * lon.posts_per_deg) < 0.01;
}

Between UndulationField::row_between(double lat_deg) const {
    return between(lat.index_at(lat_deg), lat.count);
}

Between UndulationField::column_between(double lon_deg) const {
    return between(turned_index(lon, lon_deg), lon.count);
}

double UndulationField::at_m(double lat_deg, double lon_deg) const {
    return N_m.empty() ? 0.0 : at_m(row_between(lat_deg), column_between(lon_deg));
}

double UndulationField::at_m(const Between& row, const Between& column) const {
    const std::size_t stride = static_cast<std::size_t>(lon.count);
    const std::size_t north =
        static_cast<std::size_t>(row.first) * stride + static_cast<std::size_t>(column.first);
    const std::size_t south = lat.count > 1 ? north + stride : north;
    const std::size_t east = lon.count > 1 ? 1 : 0;
    const double west_share = 1.0 - column.share;
    const double N_north = west_share * N_m[north] + column.share * N_m[north + east];
    const double N_south = west_share * N_m[south] + column.share * N_m[south + east];
    return (1.0 - row.share) * N_north + row.share * N_south;
}

// It is bilinear between nodes.
std::pair<float, float> UndulationField::range_m(double north_deg, double south_deg, double west_deg,
                                                 double east_deg) const {
    if (N_m.empty()) return {0.0F, 0.0F};
    float lowest_m = std::numeric_limits<float>::infinity(), highest_m = -lowest_m;
    const int first_row = row_between(north_deg).first, last_row = row_between(south_deg).first;
    const int first_column = column_between(west_deg).first, last_column = column_between(east_deg).first;
    // Of a field all around, ground over its first meridian: all columns.
    const bool turns = last_column < first_column;
    const int to_column = turns ? lon.count - 1 : std::min(last_column + 1, lon.count - 1);
    for (int row = first_row; row <= std::min(last_row + 1, lat.count - 1); ++row)
        for (int column = turns ? 0 : first_column; column <= to_column; ++column) {
            const float node_m = N_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(lon.count) +
                                     static_cast<std::size_t>(column)];
            lowest_m = std::min(lowest_m, node_m);
            highest_m = std::max(highest_m, node_m);
        }
    return {lowest_m, highest_m};
}

double HeightField::N_at_post_m(int row, int column) const {
    if (!grid.net) return undulation.at_m(grid.lat.at_deg(row), grid.lon.at_deg(column));
    if (N_of_posts_m.empty()) {
        if (undulation.N_m.empty()) return 0.0;
        glm::dvec3 normal;
        grid.net->normals_of_row(row, column, {&normal, 1});
        return static_cast<double>(N_on_net_m(undulation, normal));
    }
    return static_cast<double>(
        N_of_posts_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
                     static_cast<std::size_t>(column)]);
}

double HeightField::h_at_post_m(int row, int column) const {
    return static_cast<double>(H_at_post_m(row, column)) + N_at_post_m(row, column);
}

std::optional<double> HeightField::surface_H_m(double lat_deg, double lon_deg,
                                               const std::vector<char>* masked) const {
    const PostNumber at = grid.post_at(lat_deg, lon_deg);
    double y = at.row, x = at.column;
    const double last_row = grid.rows() - 1;
    const double last_column = grid.columns() - 1;
    if (!(y >= -edge_slack_posts && y <= last_row + edge_slack_posts)) return std::nullopt;
    if (!(x >= -edge_slack_posts && x <= last_column + edge_slack_posts)) return std::nullopt;
    y = std::clamp(y, 0.0, last_row);
    x = std::clamp(x, 0.0, last_column);
    const int row = static_cast<int>(y);
    const int column = static_cast<int>(x);
    const double u = y - row;
    const double v = x - column;
    // A place on the edge of a cell belongs to the cells on both sides: either may have the triangle that
    // holds it.
    for (int up = 0; up <= (u == 0.0 ? 1 : 0); ++up) {
        for (int left = 0; left <= (v == 0.0 ? 1 : 0); ++left) {
            if (row - up < 0 || row - up > grid.rows() - 2) continue;
            if (column - left < 0 || column - left > grid.columns() - 2) continue;
            const auto surface = H_in_cell_m(*this, row - up, column - left, u + up, v + left, masked);
            if (surface) return surface;
        }
    }
    return std::nullopt;
}

float HeightField::H_at_m(double lat_deg, double lon_deg) const {
    const std::optional<double> H = surface_H_m(lat_deg, lon_deg);
    return H ? static_cast<float>(*H) : void_height_m;
}

namespace {

HeightRange range_of(std::span<const float> heights_m) {
    HeightRange range{0.0F, 0.0F, 0};
    bool any = false;
    for (const float H_m : heights_m) {
        if (is_void(H_m)) {
            ++range.voids;
            continue;
        }
        range.lowest_m = any ? std::min(range.lowest_m, H_m) : H_m;
        range.highest_m = any ? std::max(range.highest_m, H_m) : H_m;
        any = true;
    }
    return range;
}

}  // namespace

HeightRange height_range(const HeightField& field) {
    if (field.range) return *field.range;
    constexpr std::size_t band = std::size_t{1} << 18U;
    std::vector<HeightRange> ranges((field.H_m.size() + band - 1) / band);
    const auto posts_of = [&](std::size_t i) {
        return std::span(field.H_m).subspan(i * band, std::min(band, field.H_m.size() - i * band));
    };
    in_parallel(static_cast<int>(ranges.size()), thread_count(), [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        ranges[at] = range_of(posts_of(at));
    });
    HeightRange whole{0.0F, 0.0F, 0};
    bool any = false;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        whole.voids += ranges[i].voids;
        if (ranges[i].voids == posts_of(i).size()) continue;
        whole.lowest_m = any ? std::min(whole.lowest_m, ranges[i].lowest_m) : ranges[i].lowest_m;
        whole.highest_m = any ? std::max(whole.highest_m, ranges[i].highest_m) : ranges[i].highest_m;
        any = true;
    }
    return whole;
}

}  // namespace oro
