#include "geo/together/mesh_roofs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "geo/meshes/placed_mesh.h"
#include "geo/together/mesh_surface.h"

namespace oro {
namespace {

struct DegreeBox {
    double south = 90.0, north = -90.0, west = 1.0e9, east = -1.0e9;
    void hold(const Geodetic& place, double lon_deg) {
        south = std::min(south, place.lat_deg), north = std::max(north, place.lat_deg);
        west = std::min(west, lon_deg), east = std::max(east, lon_deg);
    }
};

// Metres along a line from its start to a triangle's plane, where it passes the triangle; nothing where it
// does not, or where both are parallel. Source: T. Moeller, B. Trumbore, Fast, minimum storage ray/triangle
// intersection, Journal of Graphics Tools 2(1), 1997.
std::optional<double> along_to(const std::array<glm::dvec3, 3>& at, const glm::dvec3& start,
                               const glm::dvec3& direction) {
    const glm::dvec3 one = at[1] - at[0], other = at[2] - at[0], p = glm::cross(direction, other);
    const double det = glm::dot(one, p);
    if (std::abs(det) < 1.0e-12 * glm::length(one) * glm::length(other)) return std::nullopt;
    const glm::dvec3 begin = start - at[0], q = glm::cross(begin, one);
    const double u = glm::dot(begin, p) / det, v = glm::dot(direction, q) / det;
    constexpr double slack = 1.0e-9;
    if (u < -slack || v < -slack || u + v > 1.0 + slack) return std::nullopt;
    return glm::dot(other, q) / det;
}

}  // namespace

MeshRoofs::MeshRoofs(const Region& region, double exaggeration) {
    if (!region.meshes) return;
    for (std::uint32_t i = 0; i < region.meshes->size(); ++i)
        add_mesh((*region.meshes)[i], region.grids.front().field.undulation, exaggeration, i + 1, pieces_);
    if (pieces_.empty()) return;
    const double middle_deg = pieces_.front().corners[0].lon_deg;
    const auto lon_of = [&](const Geodetic& place) {
        return middle_deg + std::remainder(place.lon_deg - middle_deg, 360.0);
    };
    DegreeBox all;
    for (const SurfaceTriangle& piece : pieces_)
        for (const Geodetic& corner : piece.corners) all.hold(corner, lon_of(corner));
    south_deg_ = all.south, west_deg_ = all.west;
    const double side_deg = std::max({all.north - all.south, all.east - all.west, 1.0e-9});
    const double most_cells = std::clamp(std::sqrt(static_cast<double>(pieces_.size())), 1.0, 2000.0);
    step_deg_ = 1.0001 * side_deg / most_cells;
    rows_ = static_cast<std::size_t>((all.north - all.south) / step_deg_) + 1;
    columns_ = static_cast<std::size_t>((all.east - all.west) / step_deg_) + 1;
    first_.assign(rows_ * columns_ + 1, 0);
    const auto each_cell = [&](const SurfaceTriangle& piece, const std::function<void(std::size_t)>& take) {
        DegreeBox box;
        for (const Geodetic& corner : piece.corners) box.hold(corner, lon_of(corner));
        const auto cell = [&](double from_deg, std::size_t count) {
            return static_cast<std::size_t>(
                std::clamp(from_deg / step_deg_, 0.0, static_cast<double>(count) - 1.0));
        };
        // A triangle that is straight in space bulges by less than a metre beyond its corners.
        constexpr double slack_deg = 1.0e-5;
        for (std::size_t row = cell(box.south - slack_deg - south_deg_, rows_);
             row <= cell(box.north + slack_deg - south_deg_, rows_); ++row)
            for (std::size_t column = cell(box.west - slack_deg - west_deg_, columns_);
                 column <= cell(box.east + slack_deg - west_deg_, columns_); ++column)
                take(row * columns_ + column);
    };
    for (const SurfaceTriangle& piece : pieces_)
        each_cell(piece, [&](std::size_t cell) { ++first_[cell + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    listed_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < pieces_.size(); ++i)
        each_cell(pieces_[i], [&](std::size_t cell) { listed_[next[cell]++] = i; });
}

std::size_t MeshRoofs::cell_of(double lat_deg, double lon_deg) const {
    constexpr double slack_deg = 1.0e-5;
    const double east_deg =
        lon_deg - west_deg_ - 360.0 * std::floor((lon_deg - west_deg_ + slack_deg) / 360.0);
    const double north_deg = lat_deg - south_deg_;
    if (north_deg < -slack_deg || north_deg > static_cast<double>(rows_) * step_deg_ + slack_deg ||
        east_deg > static_cast<double>(columns_) * step_deg_ + slack_deg)
        return rows_ * columns_;
    const auto cell = [&](double from_deg, std::size_t count) {
        return static_cast<std::size_t>(
            std::clamp(from_deg / step_deg_, 0.0, static_cast<double>(count) - 1.0));
    };
    return cell(north_deg, rows_) * columns_ + cell(east_deg, columns_);
}

std::vector<double> MeshRoofs::sides_crossed(const PostPlace& from, const PostPlace& to) const {
    std::vector<double> shares;
    if (pieces_.empty()) return shares;
    const double from_east_deg = std::remainder(from.lon_deg - west_deg_, 360.0),
                 way_deg = std::remainder(to.lon_deg - from.lon_deg, 360.0);
    const auto cells = [&](double one_deg, double other_deg, std::size_t count) {
        const double low = std::floor(std::min(one_deg, other_deg) / step_deg_) - 1.0,
                     high = std::floor(std::max(one_deg, other_deg) / step_deg_) + 1.0,
                     last = static_cast<double>(count) - 1.0;
        return std::pair(static_cast<long long>(std::max(low, 0.0)),
                         static_cast<long long>(std::clamp(high, -1.0, last)));
    };
    const auto [first_row, last_row] = cells(from.lat_deg - south_deg_, to.lat_deg - south_deg_, rows_);
    const auto [first_column, last_column] = cells(from_east_deg, from_east_deg + way_deg, columns_);
    std::vector<std::uint32_t> near;
    for (long long row = first_row; row <= last_row; ++row)
        for (long long column = first_column; column <= last_column; ++column) {
            const std::size_t cell =
                static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
            near.insert(near.end(), listed_.begin() + first_[cell], listed_.begin() + first_[cell + 1]);
        }
    std::ranges::sort(near);
    near.erase(std::unique(near.begin(), near.end()), near.end());
    const double north_deg = to.lat_deg - from.lat_deg;
    for (const std::uint32_t number : near) {
        const auto& corners = pieces_[number].corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const Geodetic &a = corners[i], &b = corners[(i + 1) % 3];
            const double ax = std::remainder(a.lon_deg - from.lon_deg, 360.0), ay = a.lat_deg - from.lat_deg,
                         bx = std::remainder(b.lon_deg - from.lon_deg, 360.0), by = b.lat_deg - from.lat_deg;
            const double one = way_deg * ay - north_deg * ax, other = way_deg * by - north_deg * bx;
            if ((one > 0.0) == (other > 0.0)) continue;
            const double along = one / (one - other), x = std::lerp(ax, bx, along),
                         y = std::lerp(ay, by, along);
            const double share = std::abs(way_deg) > std::abs(north_deg) ? x / way_deg : y / north_deg;
            if (share >= 0.0 && share <= 1.0) shares.push_back(share);
        }
    }
    std::ranges::sort(shares);
    return shares;
}

std::optional<MeshRoofs::Top> MeshRoofs::at(double lat_deg, double lon_deg) const {
    if (pieces_.empty()) return std::nullopt;
    const std::size_t cell = cell_of(lat_deg, lon_deg);
    if (cell >= rows_ * columns_) return std::nullopt;
    const glm::dvec3 foot = ecef_from_geodetic({lat_deg, lon_deg, 0.0}).m,
                     up = ecef_from_enu(lat_deg, lon_deg)[2];
    std::optional<Top> top;
    for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
        const SurfaceTriangle& piece = pieces_[listed_[i]];
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) corners[k] = ecef_from_geodetic(piece.corners[k]).m;
        const std::optional<double> h_m = along_to(corners, foot, up);
        if (h_m && (!top || *h_m > top->h_m)) top = Top{*h_m, piece.mesh, piece.feature};
    }
    return top;
}

}  // namespace oro
