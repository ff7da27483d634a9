#include "apps/overlay/seen_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/sight/edge_crossings.h"

namespace oro {
namespace {

// A place among a grid's posts.
struct GridPlace {
    double row;
    double column;
};

// The part of a way that is over a grid, as shares of it; first > last where there is none.
std::pair<double, double> part_over(const PostGrid& grid, const GridPlace& from, const GridPlace& to) {
    double first = 0.0, last = 1.0;
    const auto clip = [&](double begin, double end, double most) {
        const double step = end - begin;
        if (step == 0.0) {
            if (begin < 0.0 || begin > most) first = 2.0;
            return;
        }
        const double one = -begin / step, other = (most - begin) / step;
        first = std::max(first, std::min(one, other));
        last = std::min(last, std::max(one, other));
    };
    clip(from.row, to.row, grid.rows() - 1);
    clip(from.column, to.column, grid.columns() - 1);
    return {first, last};
}

// Adds the shares at which something that goes from `begin` to `end` is a whole number, if is_edge(share)
// says yes.
template <class IsEdge>
void add_crossings(double begin, double end, double first, double last, std::vector<double>& shares,
                   const IsEdge& is_edge) {
    const double step = end - begin;
    if (step == 0.0) return;
    const double low = begin + first * step, high = begin + last * step;
    for (double whole = std::ceil(std::min(low, high)); whole <= std::max(low, high); whole += 1.0)
        if (const double share = (whole - begin) / step; is_edge(share)) shares.push_back(share);
}

// The same over grids on nets, where a way that is straight in latitude and longitude is bent among the
// posts, and over several grids.
void follow_bent(const TrueGround& ground, const VectorPlace& from, const VectorPlace& to,
                 const PlaceSink& sink) {
    const double turn_deg = std::remainder(to.lon_deg - from.lon_deg, 360.0);
    const double long_m = wgs84_a_m * radians_from_deg(std::hypot(to.lat_deg - from.lat_deg, turn_deg)).rad;
    const auto at = [&](double along_m) {
        const double share = long_m > 0.0 ? along_m / long_m : 0.0;
        return Geodetic{std::lerp(from.lat_deg, to.lat_deg, share),
                        normalised_lon_deg(from.lon_deg + share * turn_deg), 0.0};
    };
    std::vector<double> along_m = edge_crossings(ground, at, 0.0, long_m);
    along_m.insert(along_m.begin(), 0.0);
    along_m.push_back(long_m);
    for (const double here_m : along_m) {
        Geodetic place = at(here_m);
        const auto h_m = ground.h_m(place.lat_deg, place.lon_deg);
        place.h_m = h_m.value_or(0.0);
        if (h_m)
            sink(place);
        else
            sink(std::nullopt);
    }
}

}  // namespace

void follow_ground(const TrueGround& ground, const VectorPlace& from, const VectorPlace& to,
                   const PlaceSink& sink) {
    const TrueSurface& surface = ground.surface(0);
    const PostGrid& grid = surface.field().grid;
    if (grid.net || ground.grids() > 1) return follow_bent(ground, from, to, sink);
    const double turn_deg = std::remainder(to.lon_deg - from.lon_deg, 360.0);
    const GridPlace a{grid.lat.index_at(from.lat_deg), grid.column_at(from.lon_deg)},
        b{grid.lat.index_at(to.lat_deg), a.column + turn_deg * grid.lon.posts_per_deg};
    const auto [first, last] = part_over(grid, a, b);
    if (first > last) {
        sink(std::nullopt);
        return;
    }
    if (first > 0.0) sink(std::nullopt);
    std::vector<double> shares{first, last};
    const auto always = [](double) { return true; };
    add_crossings(a.row, b.row, first, last, shares, always);
    add_crossings(a.column, b.column, first, last, shares, always);
    const auto splits = [&](double share, Diagonal diagonal) {
        const double row = std::clamp(std::floor(std::lerp(a.row, b.row, share)), 0.0, grid.rows() - 2.0),
                     column = std::clamp(std::floor(std::lerp(a.column, b.column, share)), 0.0,
                                         grid.columns() - 2.0);
        return surface.diagonal_at(static_cast<int>(row), static_cast<int>(column)) == diagonal;
    };
    for (const Diagonal diagonal : {Diagonal::nw_se, Diagonal::sw_ne}) {
        const double sign = diagonal == Diagonal::nw_se ? -1.0 : 1.0;
        add_crossings(a.row + sign * a.column, b.row + sign * b.column, first, last, shares,
                      [&](double share) { return splits(share, diagonal); });
    }
    std::ranges::sort(shares);
    double before = -1.0;
    for (const double share : shares) {
        if (share < first || share > last || share == before) continue;
        before = share;
        const double row = std::clamp(std::lerp(a.row, b.row, share), 0.0, grid.rows() - 1.0),
                     column = std::clamp(std::lerp(a.column, b.column, share), 0.0, grid.columns() - 1.0);
        if (const auto h_m = surface.h_at_m(row, column))
            sink(Geodetic{std::lerp(from.lat_deg, to.lat_deg, share),
                          normalised_lon_deg(from.lon_deg + share * turn_deg), *h_m});
        else
            sink(std::nullopt);
    }
    if (last < 1.0) sink(std::nullopt);
}

}  // namespace oro
