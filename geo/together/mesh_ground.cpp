#include "geo/together/mesh_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"
#include "core/mesh_file/stored_mesh.h"
#include "core/terrain/cell_diagonal.h"
#include "core/terrain/page_on_net.h"
#include "geo/meshes/placed_mesh.h"

namespace oro {
namespace {

constexpr std::size_t most_part_triangles = 1152, most_cells = 500000, most_cells_of_part = 65536;
constexpr double most_off_m = 0.02;

// Places of each small part of a mesh.
using PartPlaces = std::vector<std::vector<Geodetic>>;

PartPlaces places_of_parts(std::span<const glm::dvec3> vertices,
                           std::span<const std::array<std::uint32_t, 3>> triangles,
                           const glm::dvec3& origin_m) {
    std::vector<std::uint32_t> part_of(vertices.size());
    std::iota(part_of.begin(), part_of.end(), 0U);
    const auto first = [&](std::uint32_t vertex) {
        while (part_of[vertex] != vertex) vertex = part_of[vertex] = part_of[part_of[vertex]];
        return vertex;
    };
    for (const auto& [a, b, c] : triangles)
        for (const std::uint32_t other : {b, c}) {
            const std::uint32_t one = first(a), two = first(other);
            part_of[std::max(one, two)] = std::min(one, two);
        }
    std::vector<std::uint32_t> count(vertices.size(), 0);
    for (const auto& triangle : triangles) ++count[first(triangle[0])];
    PartPlaces parts;
    std::vector<std::uint32_t> number(vertices.size(), std::numeric_limits<std::uint32_t>::max());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t part = first(i);
        if (count[part] == 0 || count[part] > most_part_triangles) continue;
        if (part == i) number[part] = static_cast<std::uint32_t>(parts.size()), parts.emplace_back();
        parts[number[part]].push_back(geodetic_from_ecef(Ecef{origin_m + vertices[i]}));
    }
    return parts;
}

// The ground of one grid below some parts.
class GroundOfGrid {
  public:
    GroundOfGrid(const Region& region, const RegionGrid& grid, double exaggeration)
        : region_(region), of_(grid), field_(grid.field), exaggeration_(exaggeration) {}

    // False where these are too many cells.
    bool add_cells(const PartPlaces& parts) {
        const PostGrid& grid = field_.grid;
        if (grid.rows() < 2 || grid.columns() < 2) return true;
        for (const std::vector<Geodetic>& part : parts) {
            constexpr double far = std::numeric_limits<double>::infinity();
            PostNumber low{far, far}, high{-far, -far};
            for (const Geodetic& place : part) {
                const PostNumber at = grid.post_at(place.lat_deg, place.lon_deg);
                low = {std::min(low.row, at.row), std::min(low.column, at.column)};
                high = {std::max(high.row, at.row), std::max(high.column, at.column)};
            }
            add_box(low, high);
            if (cells_.size() > 4 * most_cells) return false;
        }
        std::ranges::sort(cells_);
        cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
        return cells_.size() <= most_cells;
    }

    void add_triangles(const glm::dvec3& origin_m, MeshGround& ground) const {
        for (const std::uint64_t cell : cells_) {
            const auto columns = static_cast<std::uint64_t>(field_.grid.columns());
            add_cell(static_cast<int>(cell / columns), static_cast<int>(cell % columns), origin_m, ground);
        }
    }

  private:
    void add_box(const PostNumber& low, const PostNumber& high) {
        const auto clamped = [](double number, int count) {
            return static_cast<int>(std::clamp(number, 0.0, static_cast<double>(count)));
        };
        const int cell_rows = field_.grid.rows() - 1, cell_columns = field_.grid.columns() - 1;
        // A NaN is in no cell.
        if (!(high.row > -1.0 && high.column > -1.0 && low.row < cell_rows + 1.0 &&
              low.column < cell_columns + 1.0))
            return;
        const int first_row = clamped(std::floor(low.row) - 1.0, cell_rows),
                  last_row = clamped(std::floor(high.row) + 2.0, cell_rows),
                  first_column = clamped(std::floor(low.column) - 1.0, cell_columns),
                  last_column = clamped(std::floor(high.column) + 2.0, cell_columns);
        const auto count = static_cast<std::size_t>(last_row - first_row) *
                           static_cast<std::size_t>(last_column - first_column);
        if (count > most_cells_of_part) return;
        for (int row = first_row; row < last_row; ++row)
            for (int column = first_column; column < last_column; ++column)
                cells_.push_back(static_cast<std::uint64_t>(row) *
                                     static_cast<std::uint64_t>(field_.grid.columns()) +
                                 static_cast<std::uint64_t>(column));
    }
    [[nodiscard]] bool may_be_covered(int row, int column) const;
    void add_cell(int row, int column, const glm::dvec3& origin_m, MeshGround& ground) const;

    const Region& region_;
    const RegionGrid& of_;
    const HeightField& field_;
    double exaggeration_;
    std::vector<std::uint64_t> cells_;
};

// Whether a grid of a smaller rank reaches to within three cells.
bool GroundOfGrid::may_be_covered(int row, int column) const {
    const PostPlace here = field_.grid.place_at(row, column),
                    next = field_.grid.place_at(row + 1.0, column + 1.0);
    const double margin_deg = 4.0 * std::max(std::abs(next.lat_deg - here.lat_deg),
                                             std::abs(std::remainder(next.lon_deg - here.lon_deg, 360.0)));
    return std::ranges::any_of(region_.grids, [&](const RegionGrid& other) {
        if (other.rank >= of_.rank) return false;
        const PostGrid& grid = other.field.grid;
        const double middle_deg = 0.5 * (grid.west_deg() + grid.east_deg()),
                     half_deg = 0.5 * (grid.east_deg() - grid.west_deg());
        return here.lat_deg < grid.north_deg() + margin_deg && here.lat_deg > grid.south_deg() - margin_deg &&
               std::abs(std::remainder(here.lon_deg - middle_deg, 360.0)) < half_deg + margin_deg;
    });
}

// How far a flat triangle may be from one that is linear in latitude, longitude and height: half of the
// largest second derivative, times the square of a circle's radius around it, a third of that of its side.
double most_off_flat_m(double longest_m, double rise_m, double lat_deg) {
    constexpr double least_radius_m = 6.3e6;
    const double tangent = std::tan(std::min(std::abs(lat_deg), 89.9) * std::numbers::pi / 180.0);
    return longest_m * longest_m * (1.0 + tangent) * (1.0 + 2.0 * rise_m / longest_m) /
           (3.0 * least_radius_m);
}

void GroundOfGrid::add_cell(int row, int column, const glm::dvec3& origin_m, MeshGround& ground) const {
    std::array<std::array<glm::dvec3, 2>, 2> at{};
    double least_m = std::numeric_limits<double>::infinity(), most_m = -least_m, lat_deg = 0.0;
    for (const int south : {0, 1})
        for (const int east : {0, 1}) {
            const float H_m = field_.H_at_post_m(row + south, column + east);
            if (is_void(H_m)) return;
            const PostPlace place = field_.grid.place_at(row + south, column + east);
            const double h_m =
                static_cast<double>(H_m) * exaggeration_ + field_.N_at_post_m(row + south, column + east);
            least_m = std::min(least_m, h_m), most_m = std::max(most_m, h_m);
            lat_deg = std::max(lat_deg, std::abs(place.lat_deg));
            at[static_cast<std::size_t>(south)][static_cast<std::size_t>(east)] =
                ecef_from_geodetic({place.lat_deg, place.lon_deg, h_m}).m - origin_m;
        }
    const double longest_m = std::max({glm::distance(at[0][0], at[1][1]), glm::distance(at[0][1], at[1][0]),
                                       glm::distance(at[0][0], at[0][1]), glm::distance(at[0][0], at[1][0]),
                                       glm::distance(at[1][1], at[0][1]), glm::distance(at[1][1], at[1][0])});
    const double off_m = most_off_flat_m(longest_m, most_m - least_m, lat_deg);
    if (!(off_m <= most_off_m) || may_be_covered(row, column)) return;
    ground.off_m = std::max(ground.off_m, off_m);
    const Diagonal diagonal = cell_diagonal(field_, row, column);
    for (const bool west : {true, false}) {
        std::array<glm::dvec3, 3>& triangle = ground.triangles.emplace_back();
        const CellCorners corners = cell_corners(diagonal, west);
        for (std::size_t i = 0; i < 3; ++i)
            triangle[i] =
                at[static_cast<std::size_t>(corners[i][0])][static_cast<std::size_t>(corners[i][1])];
    }
}

}  // namespace

MeshGround ground_below_parts(std::span<const glm::dvec3> vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles,
                              const glm::dvec3& origin_ecef_m, const Region& region, double exaggeration) {
    MeshGround ground;
    if (region.meshes &&
        std::ranges::any_of(*region.meshes, [](const PlacedMesh& mesh) { return !mesh.rim_walls.empty(); }))
        return ground;
    const PartPlaces parts = places_of_parts(vertices, triangles, origin_ecef_m);
    if (parts.empty()) return ground;
    for (const RegionGrid& grid : region.grids) {
        GroundOfGrid of_grid(region, grid, exaggeration);
        if (!of_grid.add_cells(parts)) return {};
        of_grid.add_triangles(origin_ecef_m, ground);
    }
    return ground.triangles.size() > 2 * most_cells ? MeshGround() : ground;
}

MeshGround ground_below_parts(const StoredMesh& mesh, const Region& region, double exaggeration) {
    std::vector<glm::dvec3> vertices;
    for (std::uint32_t i = 0; i < mesh.places.size(); ++i) vertices.push_back(mesh.from_origin_m(i));
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const ClusterGraph& graph = mesh.graph.clusters;
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by != no_group) break;
        for (const VertexTriangle& triangle : graph.triangles_of(cluster))
            triangles.push_back({triangle[0], triangle[1], triangle[2]});
    }
    return ground_below_parts(vertices, triangles, mesh.origin_ecef_m(), region, exaggeration);
}

std::uint64_t fingerprint_of(const MeshGround& ground, const glm::dvec3& origin_ecef_m) {
    if (ground.triangles.empty()) return 0;
    NumberWriter writer;
    for (const auto& triangle : ground.triangles)
        for (const glm::dvec3& corner : triangle)
            for (const std::int64_t step : lattice_point(origin_ecef_m + corner).steps) writer(step);
    return std::max<std::uint64_t>(1, xxh64(writer.bytes));
}

}  // namespace oro
