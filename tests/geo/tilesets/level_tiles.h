// A mesh and its levels in 3D Tiles, held against each other place by place.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/tilesets/ground_tileset.h"
#include "tests/geo/tilesets/read_tileset.h"
#include "tests/geo/tilesets/tile_geometry.h"
#include "tests/support/mesh_cuts.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro::test {

using TriangleInSpace = std::array<glm::dvec3, 3>;

// A mesh of metres east, north and up of a place on the Earth, as one feature or none.
inline PlacedMesh placed_mesh(const SpaceMesh& mesh, const Geodetic& at, const std::string& feature) {
    PlacedMesh placed;
    placed.path = "made/survey.obj";
    const glm::dmat3 axes = ecef_from_enu(at.lat_deg, at.lon_deg);
    const glm::dvec3 origin_m = ecef_from_geodetic(at).m;
    for (const glm::dvec3& vertex : mesh.vertices) {
        const Geodetic place = geodetic_from_ecef({origin_m + axes * vertex});
        placed.vertices.push_back({place.lat_deg, place.lon_deg, place.h_m});
    }
    placed.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    if (feature.empty()) return placed;
    placed.features.emplace_back().name = feature;
    placed.feature_of.assign(placed.triangles.size(), 0);
    return placed;
}

inline std::vector<TriangleInSpace> triangles_in_space(const PlacedMesh& mesh) {
    std::vector<TriangleInSpace> triangles;
    for (const SourceTriangle& corners : mesh.triangles) {
        TriangleInSpace& triangle = triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const PlacedVertex& at = mesh.vertices[corners[i]];
            triangle[i] = ecef_from_geodetic({at.lat_deg, at.lon_deg, at.H_m}).m;
        }
    }
    return triangles;
}
inline std::vector<TriangleInSpace> triangles_in_space(const ReadTile& tile) {
    std::vector<TriangleInSpace> triangles;
    for (const auto& [a, b, c] : tile.triangles)
        triangles.push_back({tile.posts_m[a], tile.posts_m[b], tile.posts_m[c]});
    return triangles;
}

// Triangles by cubes of space.
class TrianglesByCubes {
  public:
    explicit TrianglesByCubes(std::vector<TriangleInSpace> triangles) : triangles_(std::move(triangles)) {
        if (triangles_.empty()) return;
        origin_m_ = triangles_.front()[0];
        double sum_m = 0.0;
        for (const TriangleInSpace& one : triangles_) sum_m += glm::distance(one[0], one[1]);
        side_m_ = std::max(0.01, 1.5 * sum_m / static_cast<double>(triangles_.size()));
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            const auto& [a, b, c] = triangles_[i];
            each_cube(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), [&](std::uint64_t cube) {
                cubes_[cube].push_back(i);
                return false;
            });
        }
    }
    // Asks near by first, where mostly one is.
    [[nodiscard]] bool any_within(const glm::dvec3& place, double reach_m) const {
        double asked_m = std::min(reach_m, 0.1 * side_m_);
        while (!any_in_cubes(place, asked_m)) {
            if (asked_m >= reach_m) return false;
            asked_m = std::min(reach_m, 3.0 * asked_m);
        }
        return true;
    }
    [[nodiscard]] const std::vector<TriangleInSpace>& triangles() const { return triangles_; }

  private:
    [[nodiscard]] bool any_in_cubes(const glm::dvec3& place, double reach_m) const {
        return each_cube(place - reach_m, place + reach_m, [&](std::uint64_t cube) {
            const auto there = cubes_.find(cube);
            if (there == cubes_.end()) return false;
            for (const std::uint32_t i : there->second)
                if (distance_to(place, triangles_[i]) <= reach_m) return true;
            return false;
        });
    }
    template <class Work>
    bool each_cube(const glm::dvec3& low, const glm::dvec3& high, const Work& work) const {
        const auto number = [&](double at, int axis) {
            return static_cast<std::int64_t>(std::floor((at - origin_m_[axis]) / side_m_)) + (1 << 20);
        };
        for (std::int64_t x = number(low.x, 0); x <= number(high.x, 0); ++x)
            for (std::int64_t y = number(low.y, 1); y <= number(high.y, 1); ++y)
                for (std::int64_t z = number(low.z, 2); z <= number(high.z, 2); ++z)
                    if (work(static_cast<std::uint64_t>(x << 42 | y << 21 | z))) return true;
        return false;
    }

    std::vector<TriangleInSpace> triangles_;
    glm::dvec3 origin_m_{0.0};
    double side_m_{1.0};
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cubes_;
};

// A triangle of some, by area, and a place of it.
class RandomPlaces {
  public:
    explicit RandomPlaces(const std::vector<TriangleInSpace>& triangles) : triangles_(triangles) {
        std::vector<double> areas;
        for (const auto& [a, b, c] : triangles) areas.push_back(glm::length(glm::cross(b - a, c - a)));
        by_area_ = std::discrete_distribution<std::size_t>(areas.begin(), areas.end());
    }
    std::pair<std::size_t, glm::dvec3> next(std::mt19937& random) {
        const std::size_t number = by_area_(random);
        const auto& [a, b, c] = triangles_[number];
        std::uniform_real_distribution<double> share;
        const double s = std::sqrt(share(random)), t = share(random);
        return {number, (1.0 - s) * a + s * (1.0 - t) * b + s * t * c};
    }

  private:
    const std::vector<TriangleInSpace>& triangles_;
    std::discrete_distribution<std::size_t> by_area_;
};

// A mesh of one thing on made ground, as a tileset: what a stranger reads of it.
class LevelTiles {
  public:
    LevelTiles(const PlacedMesh& mesh, std::size_t whole_triangles, int threads = 2,
               std::size_t most_triangles = 0)
        : folder(scratch_folder()), original(triangles_in_space(mesh)) {
        const HeightField field = rough_field(46.6, 8.0, 65, 65);
        TilesetRequest request;
        request.look = {{0.5, 0.4, 0.3}, {}, "nobody", "test"};
        request.tile_quads = 64;
        request.threads = threads;
        TilesetGround ground{std::vector<TilesetGrid>(1), {}};
        ground.grids.front().posts = &field.grid;
        ground.grids.front().ground = [&] { return ClusteredGround::of(field, nullptr, threads); };
        ground.grids.front().finest_error_m = 100.0;
        TilesetMeshes& meshes = request.meshes.emplace();
        meshes.meshes = std::make_shared<const std::vector<PlacedMesh>>(1, mesh);
        meshes.whole_triangles = whole_triangles;
        meshes.most_triangles = most_triangles == 0 ? 4 * whole_triangles : most_triangles;
        auto done = write_tileset(folder, ground, request, {});
        EXPECT_TRUE(done.ok()) << done.error().line();
        if (!done.ok()) return;
        written = done.value();
        tiles = read_tileset(folder, "ADD");
        // The last tile below the root holds the meshes.
        const ReadTile& held = tiles[static_cast<std::size_t>(tiles.front().children.back())];
        EXPECT_EQ(held.refine, "ADD");
        EXPECT_EQ(held.children.size(), 1U);
        root = held.children.front();
        EXPECT_EQ(tiles[static_cast<std::size_t>(root)].refine, "REPLACE");
        find_leaves();
    }

    [[nodiscard]] int depth_of(int number) const {
        int depth = 0;
        for (; number != root; number = tiles[static_cast<std::size_t>(number)].parent) ++depth;
        return depth;
    }
    [[nodiscard]] std::vector<int> random_cut_of_levels(std::mt19937& random) const {
        std::vector<int> cut;
        random_cut(tiles, root, random, cut);
        return cut;
    }

    std::filesystem::path folder;
    TrianglesByCubes original;
    TilesetWritten written;
    std::vector<ReadTile> tiles;
    int root{-1};
    // Of each triangle of the mesh the tile that has it as it is; -1: none.
    std::vector<int> leaf_of;

  private:
    // Matches triangles by their middles, within a millimetre.
    void find_leaves() {
        constexpr double cell_m = 0.5, near_m = 0.001;
        std::map<std::array<std::int64_t, 3>, std::vector<std::pair<glm::dvec3, int>>> middles;
        const auto middle = [](const TriangleInSpace& one) { return (one[0] + one[1] + one[2]) / 3.0; };
        const auto cell = [&](const glm::dvec3& at) {
            return std::array{std::llround(at.x / cell_m), std::llround(at.y / cell_m),
                              std::llround(at.z / cell_m)};
        };
        for (int i = root; i < static_cast<int>(tiles.size()); ++i) {
            const ReadTile& tile = tiles[static_cast<std::size_t>(i)];
            if (!tile.children.empty() || tile.features.empty()) continue;
            for (const TriangleInSpace& one : triangles_in_space(tile))
                middles[{cell(middle(one))[0], cell(middle(one))[1], cell(middle(one))[2]}].emplace_back(
                    middle(one), i);
        }
        for (const TriangleInSpace& one : original.triangles()) {
            leaf_of.push_back(-1);
            const auto around = cell(middle(one));
            for (int k = 0; k < 27; ++k) {
                const auto there =
                    middles.find({around[0] + k % 3 - 1, around[1] + k / 3 % 3 - 1, around[2] + k / 9 - 1});
                if (there == middles.end()) continue;
                for (const auto& [at, tile] : there->second)
                    if (glm::distance(at, middle(one)) < near_m) leaf_of.back() = tile;
            }
        }
    }
};

struct LevelCheck {
    std::uint64_t places{}, places_over{};  // of the mesh, farther than the error from their tile's triangles
    std::uint64_t drawn{}, drawn_over{};    // drawn ones, farther than the error from the mesh
    std::uint64_t drawn_triangles{};
};

inline void print_check(const LevelCheck& check, unsigned seed, int cuts) {
    std::printf(
        "seed %u: %llu places, %llu over; %llu drawn, %llu over; %llu triangles a cut\n", seed,
        static_cast<unsigned long long>(check.places), static_cast<unsigned long long>(check.places_over),
        static_cast<unsigned long long>(check.drawn), static_cast<unsigned long long>(check.drawn_over),
        static_cast<unsigned long long>(check.drawn_triangles / static_cast<unsigned>(cuts)));
}

// Random places of the mesh and drawn ones of random cuts, as many of each for each cut. Errors are taken
// `share` times.
inline LevelCheck check_levels(const LevelTiles& levels, int cuts, int places, double share,
                               std::mt19937& random) {
    LevelCheck check;
    std::map<int, TrianglesByCubes> of_tile;
    RandomPlaces of_mesh(levels.original.triangles());
    const auto indexed = [&](int number) -> const TrianglesByCubes& {
        const auto found = of_tile.find(number);
        if (found != of_tile.end()) return found->second;
        const ReadTile& tile = levels.tiles[static_cast<std::size_t>(number)];
        return of_tile.emplace(number, triangles_in_space(tile)).first->second;
    };
    const auto error_m = [&](int number) {
        return share * levels.tiles[static_cast<std::size_t>(number)].error_m;
    };
    for (int i = 0; i < cuts; ++i) {
        const std::vector<int> cut = levels.random_cut_of_levels(random);
        std::vector<char> is_drawn(levels.tiles.size(), 0);
        for (const int number : cut) is_drawn[static_cast<std::size_t>(number)] = 1;
        for (int k = 0; k < places; ++k) {
            const auto [triangle, place] = of_mesh.next(random);
            int number = levels.leaf_of[triangle];
            while (number >= 0 && is_drawn[static_cast<std::size_t>(number)] == 0)
                number = levels.tiles[static_cast<std::size_t>(number)].parent;
            ++check.places;
            if (number < 0 || !indexed(number).any_within(place, error_m(number))) ++check.places_over;
        }
        std::vector<TriangleInSpace> drawn;
        std::vector<int> by;
        for (const int number : cut)
            for (const TriangleInSpace& one : indexed(number).triangles())
                drawn.push_back(one), by.push_back(number);
        check.drawn_triangles += drawn.size();
        RandomPlaces of_drawn(drawn);
        for (int k = 0; k < places; ++k) {
            const auto [triangle, place] = of_drawn.next(random);
            ++check.drawn;
            if (!levels.original.any_within(place, error_m(by[triangle]))) ++check.drawn_over;
        }
    }
    return check;
}

// Edges of the drawn triangles that are not one of two triangles, once each way round. Vertices are compared
// to the bit.
inline std::size_t open_edges(const LevelTiles& levels, const std::vector<int>& cut) {
    using Place = std::array<double, 3>;
    std::map<std::pair<Place, Place>, std::array<int, 2>> edges;
    const auto place = [](const glm::dvec3& at) { return Place{at.x, at.y, at.z}; };
    for (const int number : cut)
        for (const TriangleInSpace& one : triangles_in_space(levels.tiles[static_cast<std::size_t>(number)]))
            for (std::size_t i = 0; i < 3; ++i) {
                const Place from = place(one[i]), to = place(one[(i + 1) % 3]);
                ++edges[std::minmax(from, to)][from < to ? 0 : 1];
            }
    return static_cast<std::size_t>(std::ranges::count_if(
        edges, [](const auto& edge) { return edge.second[0] != 1 || edge.second[1] != 1; }));
}

// Flat triangles reach below their corners' heights above the ellipsoid, and beside their meridians.
inline void expect_triangles_in_region(const ReadTile& tile) {
    for (const auto& [a, b, c] : triangles_in_space(tile)) expect_in_region(tile, (a + b + c) / 3.0);
}

// Fewer triangles on each depth than on the one below, the last ones all, and errors that fall.
inline void expect_levels(const LevelTiles& levels, int least_depth) {
    expect_sound_tree(levels.tiles, levels.root);
    std::map<int, std::size_t> triangles;
    std::map<int, double> largest_m;
    for (int i = levels.root; i < static_cast<int>(levels.tiles.size()); ++i) {
        const ReadTile& tile = levels.tiles[static_cast<std::size_t>(i)];
        if (tile.refine != "REPLACE" || tile.features.empty()) continue;
        const int depth = levels.depth_of(i);
        triangles[depth] += tile.triangles.size();
        largest_m[depth] = std::max(largest_m[depth], tile.error_m);
        EXPECT_GT(tile.triangles.size(), 0U);
        expect_triangles_in_region(tile);
        EXPECT_TRUE(tile.children.empty() || tile.children.size() == 4);
        for (const int child : tile.children)
            EXPECT_LT(levels.tiles[static_cast<std::size_t>(child)].error_m, tile.error_m);
        EXPECT_TRUE(!tile.children.empty() || tile.error_m < 0.001);
    }
    for (const auto& [depth, count] : triangles)
        std::printf("depth %d: %zu triangles, within %.4f m\n", depth, count, largest_m[depth]);
    EXPECT_GE(static_cast<int>(triangles.size()), least_depth);
    for (auto at = triangles.begin(), next = std::next(at); next != triangles.end(); ++at, ++next)
        EXPECT_LT(at->second, next->second);
    EXPECT_EQ(triangles.rbegin()->second, levels.original.triangles().size());
    EXPECT_EQ(std::ranges::count(levels.leaf_of, -1), 0);
    EXPECT_EQ(levels.written.mesh_levels.size(), triangles.size());
}

}  // namespace oro::test
