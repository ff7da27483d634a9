#include "geo/tilesets/ground_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <unordered_map>

#include "geo/tilesets/clipped_triangle.h"
#include "geo/tilesets/post_place.h"
#include "geo/tilesets/triangle_box.h"

namespace oro {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;

// Makes the mesh of a tile from a cut.
class MeshBuilder {
  public:
    MeshBuilder(const ClusteredGround& ground, const TilesetLayout& layout, const LevelCut& cut,
                const CutRims& rims, const TileIndex& tile, std::span<const glm::vec3> normals);
    GroundMesh build(const TileWalls& walls);

  private:
    // A corner of the mesh before it is rounded.
    struct Vertex {
        double row, column;
        glm::dvec3 ecef_m, up;
        double lat_deg, lon_deg;
        glm::vec3 normal;         // ECEF
        glm::dvec3 rim_out{0.0};  // away from the ground, as CutRims::outwards()
        // Of the walls along the four edges and along rims.
        std::array<std::uint32_t, 5> feet{none, none, none, none, none};
    };
    // Two corners with the ground on the left hand, and the edge of the tile that they lie on, or
    // TileWalls::rim.
    struct Rim {
        std::uint32_t from, to;
        std::size_t edge;
    };
    // A place on an edge of the cut; or a vertex of the surface.
    struct Key {
        VertexNumber a, b;
        std::int8_t line;
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const {
            constexpr std::uint64_t factor = 0x9E3779B97F4A7C15U;
            const std::uint64_t both = std::uint64_t{key.a} << 32U | key.b;
            const std::uint64_t mixed = (both ^ both >> 29U) * factor + static_cast<std::uint64_t>(key.line);
            return static_cast<std::size_t>(mixed ^ mixed >> 32U);
        }
    };

    void add_triangle(std::uint32_t number);
    std::uint32_t vertex(const ClippedCorner& corner, const VertexTriangle& triangle);
    [[nodiscard]] Vertex placed(const ClippedCorner& corner, const VertexTriangle& triangle) const;
    std::uint32_t add_vertex(const Vertex& vertex);
    void find_rims(std::span<const std::uint32_t> polygon);
    void find_rims_of_grid(std::span<const ClippedCorner> polygon, const VertexTriangle& triangle);
    void add_wall(const Rim& rim, double down_m, double out_m);
    std::uint32_t foot(std::uint32_t top, std::size_t edge, double down_m, double out_m);
    [[nodiscard]] glm::dvec3 outwards(const Vertex& vertex, std::size_t edge) const;

    const ClusteredGround& ground_;
    const LevelCut& cut_;
    const CutRims& cut_rims_;
    std::span<const std::uint32_t> triangles_;
    std::span<const glm::vec3> normals_;
    TilesetLayout::Lines lines_;
    TriangleClip clip_;
    std::array<SurfaceVertex, 3> corners_;
    std::vector<std::uint32_t> polygon_;
    std::unordered_map<Key, std::uint32_t, Hash> numbers_;
    std::vector<Vertex> vertices_;
    std::vector<Rim> rims_;
    GroundMesh mesh_;
};

MeshBuilder::MeshBuilder(const ClusteredGround& ground, const TilesetLayout& layout, const LevelCut& cut,
                         const CutRims& rims, const TileIndex& tile, std::span<const glm::vec3> normals)
    : ground_(ground),
      cut_(cut),
      cut_rims_(rims),
      triangles_(cut.tiles[layout.number(tile)]),
      normals_(normals),
      lines_(layout.lines(tile)) {
    std::int32_t lowest = highest_height_steps, highest = -highest_height_steps;
    for (const std::uint32_t number : triangles_) {
        for (const VertexNumber corner : cut.triangles[number]) {
            const std::int32_t steps = ground.surface().vertex(corner).steps;
            lowest = std::min(lowest, steps);
            highest = std::max(highest, steps);
        }
    }
    const PostPlace middle =
        ground.grid().place_at(0.5 * (lines_.north + lines_.south), 0.5 * (lines_.west + lines_.east));
    const double h_m = 0.5 * height_step_m * (static_cast<double>(lowest) + highest);
    mesh_.centre_m = ecef_from_geodetic({middle.lat_deg, middle.lon_deg, h_m}).m;
    mesh_.ecef_from_mesh = ecef_from_enu(middle.lat_deg, middle.lon_deg);
    mesh_.step_m = cut.step_m;
}

MeshBuilder::Vertex MeshBuilder::placed(const ClippedCorner& corner, const VertexTriangle& triangle) const {
    const auto place = [&](int number) { return ground_.ecef(corners_[static_cast<std::size_t>(number)]).m; };
    const auto normal = [&](int number) {
        return normals_.empty() ? glm::vec3(0.0F) : normals_[triangle[static_cast<std::size_t>(number)]];
    };
    Vertex vertex{corner.row, corner.column, {}, {}, 0.0, 0.0, {}};
    if (corner.line == ClippedCorner::inner) {
        const auto area = [&](const std::array<double, 2>& a, const std::array<double, 2>& b,
                              const std::array<double, 2>& c) {
            return (b[1] - a[1]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[1] - a[1]);
        };
        const auto at = [&](std::size_t i) {
            return std::array<double, 2>{static_cast<double>(corners_[i].row),
                                         static_cast<double>(corners_[i].column)};
        };
        const std::array<double, 2> here{corner.row, corner.column};
        const double whole = area(at(0), at(1), at(2));
        const std::array shares{area(here, at(1), at(2)) / whole, area(at(0), here, at(2)) / whole,
                                area(at(0), at(1), here) / whole};
        for (int i = 0; i < 3; ++i) {
            vertex.ecef_m += shares[static_cast<std::size_t>(i)] * place(i);
            vertex.normal += static_cast<float>(shares[static_cast<std::size_t>(i)]) * normal(i);
        }
    } else {
        vertex.ecef_m = glm::mix(place(corner.a), place(corner.b), corner.share);
        vertex.normal = glm::mix(normal(corner.a), normal(corner.b), static_cast<float>(corner.share));
    }
    const Geodetic at = geodetic_from_ecef({vertex.ecef_m});
    vertex.lat_deg = at.lat_deg;
    vertex.lon_deg = at.lon_deg;
    const SineCosine lat = sine_cosine_deg(at.lat_deg), lon = sine_cosine_deg(at.lon_deg);
    vertex.up = {lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine};
    if (const float length = glm::length(vertex.normal); length > 0.0F)
        vertex.normal /= length;
    else
        vertex.normal = glm::vec3(vertex.up);
    return vertex;
}

std::uint32_t MeshBuilder::add_vertex(const Vertex& vertex) {
    const glm::dvec3 local_m = glm::transpose(mesh_.ecef_from_mesh) * (vertex.ecef_m - mesh_.centre_m);
    mesh_.positions.emplace_back(glm::round(local_m / mesh_.step_m));
    if (!normals_.empty())
        mesh_.normals.emplace_back(glm::transpose(mesh_.ecef_from_mesh) * glm::dvec3(vertex.normal));
    mesh_.places.push_back({vertex.row, vertex.column, vertex.lat_deg, vertex.lon_deg});
    vertices_.push_back(vertex);
    return static_cast<std::uint32_t>(vertices_.size() - 1);
}

std::uint32_t MeshBuilder::vertex(const ClippedCorner& corner, const VertexTriangle& triangle) {
    if (corner.line != ClippedCorner::inner) {
        const Key key{triangle[static_cast<std::size_t>(corner.a)],
                      triangle[static_cast<std::size_t>(corner.b)], corner.line};
        const auto [known, is_new] = numbers_.try_emplace(key, none);
        if (is_new) known->second = add_vertex(placed(corner, triangle));
        return known->second;
    }
    return add_vertex(placed(corner, triangle));
}

// Edges of a polygon, anticlockwise, that lie on an edge of the tile.
void MeshBuilder::find_rims(std::span<const std::uint32_t> polygon) {
    const std::array<double, 4> at{static_cast<double>(lines_.north), static_cast<double>(lines_.east),
                                   static_cast<double>(lines_.south), static_cast<double>(lines_.west)};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::uint32_t from = polygon[i], to = polygon[(i + 1) % polygon.size()];
        for (std::size_t edge = 0; edge < at.size(); ++edge) {
            const auto along = [&](std::uint32_t number) {
                return edge % 2 == 0 ? vertices_[number].row : vertices_[number].column;
            };
            if (along(from) == at[edge] && along(to) == at[edge]) rims_.push_back({from, to, edge});
        }
    }
}

// The corners in polygon_ on the sides of a triangle where another grid goes on. Corners that divide a side
// lean across it; those of the triangle as its neighbours on the rim do.
void MeshBuilder::find_rims_of_grid(std::span<const ClippedCorner> polygon, const VertexTriangle& triangle) {
    for (std::int8_t side = 0; side < 3; ++side) {
        const auto next = static_cast<std::int8_t>((side + 1) % 3);
        const auto number = [&](int corner) { return triangle[static_cast<std::size_t>(corner)]; };
        if (!cut_rims_.has(number(side), number(next))) continue;
        const auto on_side = [&](const ClippedCorner& corner) {
            if (corner.line == ClippedCorner::inner) return false;
            if (corner.line == ClippedCorner::post) return corner.a == side || corner.a == next;
            return (corner.a == side && corner.b == next) || (corner.a == next && corner.b == side);
        };
        const auto at = [&](int corner) {
            return ground_.ecef(corners_[static_cast<std::size_t>(corner)]).m;
        };
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const std::size_t j = (i + 1) % polygon.size();
            if (!on_side(polygon[i]) || !on_side(polygon[j])) continue;
            for (const std::size_t end : {i, j})
                vertices_[polygon_[end]].rim_out = polygon[end].line == ClippedCorner::post
                                                       ? cut_rims_.outwards(number(polygon[end].a))
                                                       : level_away(at(side), at(next), at((side + 2) % 3));
            // Clockwise from i to j.
            rims_.push_back({polygon_[j], polygon_[i], TileWalls::rim});
        }
    }
}

void MeshBuilder::add_triangle(std::uint32_t number) {
    const VertexTriangle& triangle = cut_.triangles[number];
    for (std::size_t i = 0; i < 3; ++i) corners_[i] = ground_.surface().vertex(triangle[i]);
    polygon_.clear();
    const std::vector<ClippedCorner>& clipped = clip_.clip(corners_, triangle, lines_);
    for (const ClippedCorner& corner : clipped) polygon_.push_back(vertex(corner, triangle));
    find_rims_of_grid(clipped, triangle);
    // What is clockwise on the map is so from above.
    std::ranges::reverse(polygon_);
    for (std::size_t i = 2; i < polygon_.size(); ++i)
        mesh_.indices.insert(mesh_.indices.end(), {polygon_[0], polygon_[i - 1], polygon_[i]});
    find_rims(polygon_);
}

// Level, from a place on an edge of the tile, away from the tile.
glm::dvec3 MeshBuilder::outwards(const Vertex& vertex, std::size_t edge) const {
    constexpr std::array<std::array<double, 2>, 4> steps{{{-1.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}}};
    const auto on_ellipsoid = [&](double row, double column) {
        const PostPlace at = ground_.grid().place_at(row, column);
        return ecef_from_geodetic({at.lat_deg, at.lon_deg, 0.0}).m;
    };
    glm::dvec3 out = on_ellipsoid(vertex.row + steps[edge][0], vertex.column + steps[edge][1]) -
                     on_ellipsoid(vertex.row, vertex.column);
    out -= glm::dot(out, vertex.up) * vertex.up;
    const double length = glm::length(out);
    return length > 0.0 ? out / length : glm::dvec3(0.0);
}

std::uint32_t MeshBuilder::foot(std::uint32_t top, std::size_t edge, double down_m, double out_m) {
    if (vertices_[top].feet[edge] != none) return vertices_[top].feet[edge];
    Vertex vertex = vertices_[top];
    const glm::dvec3 out = edge == TileWalls::rim ? vertex.rim_out : outwards(vertex, edge);
    vertex.ecef_m += out_m * out - down_m * vertex.up;
    const std::uint32_t number = add_vertex(vertex);
    vertices_[top].feet[edge] = number;
    return number;
}

// A wall hangs from an edge of a triangle, and leans outwards.
void MeshBuilder::add_wall(const Rim& rim, double down_m, double out_m) {
    const std::uint32_t from_foot = foot(rim.from, rim.edge, down_m, out_m),
                        to_foot = foot(rim.to, rim.edge, down_m, out_m);
    mesh_.indices.insert(mesh_.indices.end(), {rim.from, from_foot, to_foot, rim.from, to_foot, rim.to});
}

GroundMesh MeshBuilder::build(const TileWalls& walls) {
    for (const std::uint32_t number : triangles_) add_triangle(number);
    mesh_.ground_triangles = mesh_.indices.size() / 3;
    for (const Rim& rim : rims_)
        if (walls.down_m[rim.edge] > 0.0) add_wall(rim, walls.down_m[rim.edge], walls.out_m[rim.edge]);
    mesh_.box = box_of(mesh_);
    return std::move(mesh_);
}

}  // namespace

GroundMesh ground_mesh(const ClusteredGround& ground, const TilesetLayout& layout, const LevelCut& cut,
                       const CutRims& rims, const TileIndex& tile, const TileWalls& walls,
                       std::span<const glm::vec3> normals) {
    return MeshBuilder(ground, layout, cut, rims, tile, normals).build(walls);
}

}  // namespace oro
