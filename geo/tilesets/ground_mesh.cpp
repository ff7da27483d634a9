#include "geo/tilesets/ground_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "core/terrain/cell_diagonal.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/page_posts.h"
#include "geo/tilesets/post_place.h"

namespace oro {
namespace {

constexpr int quads = static_cast<int>(gpu::page_quads);
constexpr int across = static_cast<int>(gpu::height_stride);  // of posts -1 .. 129

struct PlacedPost {
    glm::dvec3 ecef_m{0.0};
    glm::dvec3 up{0.0};  // the ellipsoid's normal
    bool there{};
};

// Makes the mesh of a page from its block.
class MeshBuilder {
  public:
    MeshBuilder(const PostGrid& grid, const PageIndex& page, const PageSummary& summary,
                const gpu::PageBlock& block)
        : block_(block), numbers_(static_cast<std::size_t>(across * across), none) {
        mesh_.centre_m = summary.origin_ecef.m + summary.ecef_from_page * summary.centre_m;
        place_posts(grid, page);
        mesh_.box = {unset, unset, -unset, -unset, summary.lowest_h_m, summary.highest_h_m};
        middle_lon_deg_ = summary.origin.lon_deg;
    }
    GroundMesh build(const TileWalls& walls, double step_m) {
        mesh_.step_m = step_m;
        for (int row = 0; row < quads; ++row)
            for (int column = 0; column < quads; ++column) add_quad(row, column);
        mesh_.ground_triangles = mesh_.indices.size() / 3;
        for (std::size_t edge = 0; edge < walls.down_m.size(); ++edge)
            if (walls.down_m[edge] > 0.0) add_wall(edge, walls.down_m[edge], walls.out_m[edge]);
        widen_box(*std::ranges::max_element(walls.down_m), *std::ranges::max_element(walls.out_m));
        return std::move(mesh_);
    }

  private:
    static constexpr std::uint32_t none = 0xFFFFFFFFU;
    static constexpr double unset = 1.0e9;
    struct Post {
        int row, column;
    };

    static std::size_t at(const Post& post) {
        return static_cast<std::size_t>((post.row + 1) * across + post.column + 1);
    }
    [[nodiscard]] const PlacedPost& placed(const Post& post) const { return posts_[at(post)]; }
    void place_posts(const PostGrid& grid, const PageIndex& page);
    [[nodiscard]] Diagonal diagonal(int row, int column) const;
    [[nodiscard]] bool has_triangle(int row, int column, bool west) const;
    [[nodiscard]] glm::dvec3 normal_of(const Post& post) const;
    std::uint32_t vertex(const Post& post);
    std::uint32_t add_vertex(const glm::dvec3& ecef_m, const glm::vec3& normal);
    void add_quad(int row, int column);
    void add_wall(std::size_t edge, double down_m, double out_m);
    void widen_box(double down_m, double out_m);

    const gpu::PageBlock& block_;
    std::vector<PlacedPost> posts_;
    std::vector<std::uint32_t> numbers_;
    GroundMesh mesh_;
    double middle_lon_deg_{};
};

void MeshBuilder::place_posts(const PostGrid& grid, const PageIndex& page) {
    const PagePosts region(grid, page);
    posts_.resize(static_cast<std::size_t>(across * across));
    for (int row = -1; row < across - 1; ++row) {
        for (int column = -1; column < across - 1; ++column) {
            const std::size_t number = at({row, column});
            const std::int32_t steps = block_.heights[number];
            const std::optional<PageIndex> post = region.region_post(row, column);
            if (steps == void_height_steps || !post) continue;
            const glm::dvec3 up = post_up(grid, post->row, post->column);
            posts_[number] = {ecef_above(up, steps * height_step_m), up, true};
        }
    }
}

Diagonal MeshBuilder::diagonal(int row, int column) const {
    constexpr int side = static_cast<int>(gpu::meshlet_quads);
    const int meshlet = row / side * static_cast<int>(gpu::meshlets_per_side) + column / side;
    const int cell = row % side * side + column % side;
    return (block_.sw_ne[2 * meshlet + cell / 32] >> static_cast<unsigned>(cell % 32) & 1U) != 0
               ? Diagonal::sw_ne
               : Diagonal::nw_se;
}

bool MeshBuilder::has_triangle(int row, int column, bool west) const {
    return std::ranges::all_of(cell_corners(diagonal(row, column), west),
                               [&](const std::array<int, 2>& corner) {
                                   return placed({row + corner[0], column + corner[1]}).there;
                               });
}

// Of the ground through the posts on either side, or the post itself where there is none.
glm::dvec3 MeshBuilder::normal_of(const Post& post) const {
    const auto between = [&](const Post& from, const Post& to) {
        const PlacedPost &own = placed(post), &a = placed(from), &b = placed(to);
        return (b.there ? b : own).ecef_m - (a.there ? a : own).ecef_m;
    };
    const glm::dvec3 east = between({post.row, post.column - 1}, {post.row, post.column + 1});
    const glm::dvec3 north = between({post.row + 1, post.column}, {post.row - 1, post.column});
    const glm::dvec3 normal = glm::cross(east, north);
    const double length = glm::length(normal);
    // Posts of a pole are one point.
    return length > 1.0e-9 * glm::length(east) * glm::length(north) && length > 0.0 ? normal / length
                                                                                    : placed(post).up;
}

std::uint32_t MeshBuilder::add_vertex(const glm::dvec3& ecef_m, const glm::vec3& normal) {
    mesh_.positions_m.emplace_back(glm::round((ecef_m - mesh_.centre_m) / mesh_.step_m) * mesh_.step_m);
    mesh_.normals.push_back(normal);
    return static_cast<std::uint32_t>(mesh_.positions_m.size() - 1);
}

std::uint32_t MeshBuilder::vertex(const Post& post) {
    std::uint32_t& number = numbers_[at(post)];
    if (number != none) return number;
    number = add_vertex(placed(post).ecef_m, glm::vec3(normal_of(post)));
    const glm::dvec3& up = placed(post).up;
    const double lat_deg = deg_from_radians(Radians{std::atan2(up.z, std::hypot(up.x, up.y))});
    const double lon_deg =
        middle_lon_deg_ +
        std::remainder(deg_from_radians(Radians{std::atan2(up.y, up.x)}) - middle_lon_deg_, 360.0);
    mesh_.box.south_deg = std::min(mesh_.box.south_deg, lat_deg);
    mesh_.box.north_deg = std::max(mesh_.box.north_deg, lat_deg);
    mesh_.box.west_deg = std::min(mesh_.box.west_deg, lon_deg);
    mesh_.box.east_deg = std::max(mesh_.box.east_deg, lon_deg);
    return number;
}

void MeshBuilder::add_quad(int row, int column) {
    for (const bool west : {true, false}) {
        if (!has_triangle(row, column, west)) continue;
        for (const auto& [down, right] : cell_corners(diagonal(row, column), west))
            mesh_.indices.push_back(vertex({row + down, column + right}));
    }
}

// Each wall hangs from the triangles that have an edge there, and leans outwards.
void MeshBuilder::add_wall(std::size_t edge, double down_m, double out_m) {
    const bool along_row = edge % 2 == 0;                  // northern, southern
    const int fixed = edge == 1 || edge == 2 ? quads : 0;  // eastern, southern
    const int inwards = fixed == 0 ? 1 : -1;
    const bool runs_back = edge == 0 || edge == 1;  // so that the ground is on the left hand
    std::vector<std::uint32_t> feet(static_cast<std::size_t>(quads + 1), none);
    const auto post_at = [&](int i) { return along_row ? Post{fixed, i} : Post{i, fixed}; };
    const auto foot = [&](int i) {
        std::uint32_t& number = feet[static_cast<std::size_t>(i)];
        if (number != none) return number;
        const Post post = post_at(i);
        const Post inner = along_row ? Post{fixed + inwards, i} : Post{i, fixed + inwards};
        const PlacedPost& own = placed(post);
        glm::dvec3 out = placed(inner).there ? own.ecef_m - placed(inner).ecef_m : glm::dvec3(0.0);
        out -= glm::dot(out, own.up) * own.up;
        if (glm::length(out) > 0.0) out = glm::normalize(out);
        return number = add_vertex(own.ecef_m - down_m * own.up + out_m * out, glm::vec3(normal_of(post)));
    };
    const int quad_at = fixed == 0 ? 0 : quads - 1;
    for (int i = 0; i < quads; ++i) {
        // The triangle with a quad's northern edge is the western one where it is split from south-west.
        const bool sw_ne = (along_row ? diagonal(quad_at, i) : diagonal(i, quad_at)) == Diagonal::sw_ne;
        const bool west = edge == 0 ? sw_ne : edge == 1 ? false : edge == 2 ? !sw_ne : true;
        if (!(along_row ? has_triangle(quad_at, i, west) : has_triangle(i, quad_at, west))) continue;
        const int from = runs_back ? i + 1 : i, to = runs_back ? i : i + 1;
        const std::uint32_t a = vertex(post_at(from)), b = vertex(post_at(to));
        const std::uint32_t a_foot = foot(from), b_foot = foot(to);
        mesh_.indices.insert(mesh_.indices.end(), {a, a_foot, b_foot, a, b_foot, b});
    }
}

// Flat triangles and walls reach beyond their posts: down by the walls' depth, and sideways. A flat triangle
// is nowhere higher than its highest corner, as what lies below a height above the ellipsoid is convex.
void MeshBuilder::widen_box(double down_m, double out_m) {
    TileBox& box = mesh_.box;
    double longest_m = 0.0;
    for (const glm::vec3& position : mesh_.positions_m)
        longest_m = std::max<double>(longest_m, glm::length(position));
    // A chord is off the arc above it by less than this; so is it off a meridian or a parallel.
    const double step_m = 2.0 * longest_m / quads + 1.0;
    const double sag_m = step_m * step_m / wgs84_b_m + mesh_.step_m + 0.01;
    box.lowest_h_m -= down_m + sag_m;
    box.highest_h_m += mesh_.step_m + 0.01;
    const double aside_deg = deg_from_radians(Radians{(out_m + sag_m) / (0.99 * wgs84_b_m)});
    box.south_deg = std::max(-90.0, box.south_deg - aside_deg);
    box.north_deg = std::min(90.0, box.north_deg + aside_deg);
    const double farthest_deg = std::max(std::abs(box.south_deg), std::abs(box.north_deg));
    if (farthest_deg > 89.0 || box.east_deg - box.west_deg > 180.0) {
        // Around a pole, or so wide that one may lie within it.
        box.west_deg = -180.0, box.east_deg = 180.0;
        if (box.north_deg >= -box.south_deg) box.north_deg = 90.0;
        if (box.south_deg <= -box.north_deg) box.south_deg = -90.0;
        return;
    }
    const double lon_aside_deg = aside_deg * (1.0 + std::tan(radians_from_deg(farthest_deg).rad)) /
                                 std::cos(radians_from_deg(farthest_deg).rad);
    box.west_deg -= lon_aside_deg;
    box.east_deg += lon_aside_deg;
}

}  // namespace

Result<GroundMesh> ground_mesh(const RegionPages& pages, const PageIndex& page, const TileBounds& bounds) {
    const auto block = std::make_unique<gpu::PageBlock>();
    ORO_CHECK(pages.load(page, *block));
    ORO_TRY(const PageRecord record, pages.record(page));
    return MeshBuilder(pages.facts().grid, page, record.summary, *block)
        .build(bounds.walls(page), bounds.step_m(page));
}

}  // namespace oro
