#include "geo/together/mesh_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory_resource>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
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
                           const glm::dvec3& origin_m, std::pmr::memory_resource* memory) {
    std::pmr::vector<std::uint32_t> part_of(vertices.size(), memory);
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
    std::pmr::vector<std::uint32_t> count(vertices.size(), 0, memory);
    for (const auto& triangle : triangles) ++count[first(triangle[0])];
    PartPlaces parts;
    std::pmr::vector<std::uint32_t> number(vertices.size(), std::numeric_limits<std::uint32_t>::max(),
                                           memory);
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

    // The cells below some parts; nothing where these are too many.
    std::optional<std::vector<GroundCells::Run>> cells_below(const PartPlaces& parts) {
        const PostGrid& grid = field_.grid;
        if (grid.rows() < 2 || grid.columns() < 2) return std::vector<GroundCells::Run>();
        for (const std::vector<Geodetic>& part : parts) {
            constexpr double far = std::numeric_limits<double>::infinity();
            PostNumber low{far, far}, high{-far, -far};
            for (const Geodetic& place : part) {
                const PostNumber at = grid.post_at(place.lat_deg, place.lon_deg);
                low = {std::min(low.row, at.row), std::min(low.column, at.column)};
                high = {std::max(high.row, at.row), std::max(high.column, at.column)};
            }
            add_box(low, high);
            if (cells_.size() > 4 * most_cells) return std::nullopt;
        }
        std::ranges::sort(cells_);
        cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
        if (cells_.size() > most_cells) return std::nullopt;
        return runs();
    }

    void add_triangles(std::span<const GroundCells::Run> runs, const glm::dvec3& origin_m,
                       MeshGround& ground) const {
        const auto rows = static_cast<std::uint32_t>(field_.grid.rows() - 1),
                   columns = static_cast<std::uint32_t>(field_.grid.columns() - 1);
        for (const GroundCells::Run& run : runs) {
            // Numbers of a file may be any.
            if (run.row >= rows || run.count > columns || run.column > columns - run.count) continue;
            for (std::uint32_t i = 0; i < run.count; ++i)
                add_cell(static_cast<int>(run.row), static_cast<int>(run.column + i), origin_m, ground);
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
    [[nodiscard]] std::vector<GroundCells::Run> runs() const {
        const auto columns = static_cast<std::uint64_t>(field_.grid.columns());
        std::vector<GroundCells::Run> runs;
        for (const std::uint64_t cell : cells_) {
            const auto row = static_cast<std::uint32_t>(cell / columns),
                       column = static_cast<std::uint32_t>(cell % columns);
            if (!runs.empty() && runs.back().row == row && runs.back().column + runs.back().count == column)
                ++runs.back().count;
            else
                runs.push_back({row, column, 1});
        }
        return runs;
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

bool cuts_ground_out(const Region& region) {
    return region.meshes && std::ranges::any_of(*region.meshes, [](const PlacedMesh& mesh) {
               return !mesh.rim_walls.empty();
           });
}

// Whether a grid may have cells for places of such a box. Also true where that is not easily told.
bool may_reach_into(const PostGrid& grid, const GroundCells& box) {
    constexpr double most_wide_deg = 90.0;
    if (grid.net || !(box.east_deg - box.west_deg < most_wide_deg)) return true;
    const PostNumber low = grid.post_at(box.north_deg, box.west_deg),
                     high = grid.post_at(box.south_deg, box.east_deg);
    if (!(low.column <= high.column)) return true;  // a turn begins between them
    return high.row > -1.0 && high.column > -1.0 && low.row < grid.rows() && low.column < grid.columns();
}

// Tells where the posts of a grid lie from where those of others do.
std::uint64_t fingerprint_of_posts(const PostGrid& grid) {
    NumberWriter writer;
    writer(grid.rows()), writer(grid.columns());
    for (const int row : {0, (grid.rows() - 1) / 2, grid.rows() - 1})
        for (const int column : {0, (grid.columns() - 1) / 2, grid.columns() - 1}) {
            const PostPlace place = grid.place_at(row, column);
            for (const std::int64_t step :
                 lattice_point(ecef_from_geodetic({place.lat_deg, place.lon_deg, 0.0}).m).steps)
                writer(step);
        }
    return xxh64(writer.bytes);
}

struct PartMesh {
    std::vector<glm::dvec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

PartMesh mesh_of(const StoredMesh& mesh) {
    PartMesh all;
    for (std::uint32_t i = 0; i < mesh.places.size(); ++i) all.vertices.push_back(mesh.from_origin_m(i));
    const ClusterGraph& graph = mesh.graph.clusters;
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by != no_group) break;
        for (const VertexTriangle& triangle : graph.triangles_of(cluster))
            all.triangles.push_back({triangle[0], triangle[1], triangle[2]});
    }
    return all;
}

}  // namespace

GroundCells ground_cells_below_parts(std::span<const glm::dvec3> vertices,
                                     std::span<const std::array<std::uint32_t, 3>> triangles,
                                     const glm::dvec3& origin_ecef_m, const Region& region,
                                     ScratchMemory* scratch) {
    if (cuts_ground_out(region)) return {};
    const PartPlaces parts = places_of_parts(vertices, triangles, origin_ecef_m, array_memory(scratch));
    if (parts.empty()) return {};
    constexpr double far_deg = std::numeric_limits<double>::infinity();
    GroundCells cells{far_deg, -far_deg, far_deg, -far_deg, {}};
    for (const std::vector<Geodetic>& part : parts)
        for (const Geodetic& place : part) {
            cells.south_deg = std::min(cells.south_deg, place.lat_deg);
            cells.north_deg = std::max(cells.north_deg, place.lat_deg);
            cells.west_deg = std::min(cells.west_deg, place.lon_deg);
            cells.east_deg = std::max(cells.east_deg, place.lon_deg);
        }
    for (const RegionGrid& grid : region.grids) {
        if (!may_reach_into(grid.field.grid, cells)) continue;
        auto runs = GroundOfGrid(region, grid, 1.0).cells_below(parts);
        if (!runs) return {};
        cells.grids.push_back({fingerprint_of_posts(grid.field.grid), std::move(*runs)});
    }
    return cells.grids.size() > most_ground_grids || cells.count() > most_ground_cells ? GroundCells()
                                                                                       : cells;
}

GroundCells ground_cells_below_parts(const StoredMesh& mesh, const Region& region) {
    const PartMesh all = mesh_of(mesh);
    return ground_cells_below_parts(all.vertices, all.triangles, mesh.origin_ecef_m(), region);
}

MeshGround ground_in_cells(const GroundCells& cells, const glm::dvec3& origin_ecef_m, const Region& region,
                           double exaggeration) {
    if (cells.grids.empty() || cuts_ground_out(region)) return {};
    MeshGround ground;
    auto next = cells.grids.begin();
    for (const RegionGrid& grid : region.grids) {
        if (!may_reach_into(grid.field.grid, cells)) continue;
        if (next == cells.grids.end() || next->posts != fingerprint_of_posts(grid.field.grid)) return {};
        GroundOfGrid(region, grid, exaggeration).add_triangles(next->runs, origin_ecef_m, ground);
        ++next;
    }
    if (next != cells.grids.end() || ground.triangles.size() > 2 * most_cells) return {};
    return ground;
}

MeshGround ground_below_parts(std::span<const glm::dvec3> vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles,
                              const glm::dvec3& origin_ecef_m, const Region& region, double exaggeration) {
    return ground_in_cells(ground_cells_below_parts(vertices, triangles, origin_ecef_m, region),
                           origin_ecef_m, region, exaggeration);
}

MeshGround ground_below_parts(const StoredMesh& mesh, const Region& region, double exaggeration) {
    return ground_in_cells(ground_cells_below_parts(mesh, region), mesh.origin_ecef_m(), region,
                           exaggeration);
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
