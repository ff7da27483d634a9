// Meshes beside the ground in 3D Tiles: what is drawn, where, and what is missing at most, by brute force.
#include "geo/tilesets/mesh_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

#include "core/earth/ellipsoid.h"
#include "core/seam/cleared_map.h"  // gpu::mesh_look_...
#include "geo/opening/open_region.h"
#include "geo/tilesets/ground_tileset.h"
#include "tests/geo/tilesets/read_tileset.h"
#include "tests/geo/tilesets/tile_geometry.h"
#include "tests/support/test_data.h"
#include "tests/support/tileset_rules.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using test::ReadTile;

constexpr unsigned town_seed = 20261129;
constexpr double millimetre_m = 0.001;

using Triangle = std::array<glm::dvec3, 3>;

// Source: C. Ericson, Real-Time Collision Detection, 5.1.5.
glm::dvec3 nearest_of(const Triangle& triangle, const glm::dvec3& place) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 ab = b - a, ac = c - a, ap = place - a, bp = place - b, cp = place - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
                 d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    if (d3 >= 0.0 && d4 <= d3) return b;
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
        return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    return a + (vb * ab + vc * ac) / (va + vb + vc);
}

// The triangles of a mesh in space, by the names of their features.
std::map<std::string, std::vector<Triangle>> things_in_space(const PlacedMesh& mesh,
                                                             const UndulationField& undulation) {
    std::map<std::string, std::vector<Triangle>> things;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        Triangle triangle;
        for (std::size_t j = 0; j < 3; ++j) {
            const PlacedVertex& at = mesh.vertices[mesh.triangles[i][j]];
            const double N_m = undulation.N_m.empty() ? 0.0 : undulation.at_m(at.lat_deg, at.lon_deg);
            triangle[j] = ecef_from_geodetic({at.lat_deg, at.lon_deg, at.H_m + N_m}).m;
        }
        things[mesh.feature_of.empty() ? "" : mesh.features[mesh.feature_of[i]].name].push_back(triangle);
    }
    return things;
}

double diameter_m(const std::vector<Triangle>& thing) {
    double largest_m = 0.0;
    for (const Triangle& one : thing)
        for (const glm::dvec3& from : one)
            for (const Triangle& other : thing)
                for (const glm::dvec3& to : other) largest_m = std::max(largest_m, glm::distance(from, to));
    return largest_m;
}

// What a viewer draws that refines every tile whose error is larger than so many metres.
struct Drawn {
    std::map<std::string, std::vector<Triangle>> things;  // by name, in space
    double error_m{};                                     // of the tiles that are not refined
    std::size_t triangles{};
};
void draw(const std::vector<ReadTile>& tiles, int number, double refined_m, Drawn& drawn) {
    const ReadTile& tile = tiles[static_cast<std::size_t>(number)];
    for (const auto& corners : tile.triangles) {
        Triangle triangle;
        for (std::size_t i = 0; i < 3; ++i) triangle[i] = tile.posts_m[corners[i]];
        const int feature = tile.features[corners[0]];
        EXPECT_EQ(feature, tile.features[corners[1]]);
        EXPECT_EQ(feature, tile.features[corners[2]]);
        drawn.things[tile.feature_names[static_cast<std::size_t>(feature)]].push_back(triangle);
        ++drawn.triangles;
    }
    if (tile.error_m <= refined_m || tile.children.empty()) {
        drawn.error_m = std::max(drawn.error_m, tile.error_m);
        return;
    }
    for (const int child : tile.children) draw(tiles, child, refined_m, drawn);
}

// A town and the ground that it stands on, as one tileset.
struct TownTiles {
    explicit TownTiles(const Region& region, bool without_too = false)
        : with(test::scratch_folder()), without(test::scratch_folder()) {
        const RegionGrid& grid = region.grids.front();
        TilesetRequest request;
        request.look = {{0.5, 0.4, 0.3}, {}, "nobody", "test"};
        request.tile_quads = 64;
        request.threads = 2;
        TilesetGround ground{std::vector<TilesetGrid>(1), {}};
        ground.grids.front().posts = &grid.field.grid;
        ground.grids.front().ground = [&] { return ClusteredGround::of(grid.field, nullptr, 2); };
        ground.grids.front().finest_error_m = usual_finest_error_m(grid.field.grid);
        const bool wrote = !without_too || write_tileset(without, ground, request, {}).ok();
        EXPECT_TRUE(wrote);
        request.meshes = TilesetMeshes{region.meshes, {}, 256};
        request.undulation = &grid.field.undulation;
        auto done = write_tileset(with, ground, request, {});
        EXPECT_TRUE(done.ok()) << done.error().line();
        if (done.ok()) written = done.value();
        tiles = test::read_tileset(with, "ADD");
    }
    fs::path with, without;
    TilesetWritten written;
    std::vector<ReadTile> tiles;
};

std::optional<Region> zurich() {
    const auto ground = test::real_data("alps/N47E008.SRTMGL3.hgt.zip"),
               town = test::real_data("meshes/zurich_subset_lod2.city.json");
    if (!ground || !town) return std::nullopt;
    RegionRequest request;
    request.paths = {ground->string()};
    request.box = BoundingBox{8.45, 47.3, 8.65, 47.45};
    request.meshes.files = {town->string()};
    auto opened = open_region(request);
    EXPECT_TRUE(opened.ok()) << opened.error().line();
    if (!opened.ok()) return std::nullopt;
    return std::move(opened).value();
}

// The triangles of things one by one: by whom, how large, and how large their things are.
struct TrianglesOfThings {
    explicit TrianglesOfThings(const std::map<std::string, std::vector<Triangle>>& things) {
        for (const auto& [name, thing] : things) {
            diameters_m[name] = diameter_m(thing);
            for (const Triangle& one : thing) {
                all.push_back(&one);
                names.push_back(&name);
                areas.push_back(glm::length(glm::cross(one[1] - one[0], one[2] - one[0])));
            }
        }
    }
    std::vector<const Triangle*> all;
    std::vector<const std::string*> names;
    std::vector<double> areas;
    std::map<std::string, double> diameters_m;
};

// 100,000 random places of the town's walls and roofs, by area, for each of several errors: the thing there
// is drawn, within a millimetre, or is no larger than the error of the tiles that are not refined.
TEST(MeshTiles, NothingLargerThanTheErrorIsMissing) {
    const auto region = zurich();
    if (!region) GTEST_SKIP() << "needs alps/N47E008.SRTMGL3.hgt.zip and meshes/zurich_subset_lod2.city.json";
    const TownTiles town(*region);
    const PlacedMesh& mesh = region->meshes->front();
    const auto things = things_in_space(mesh, region->grids.front().field.undulation);
    EXPECT_EQ(things.size(), 161U);
    ASSERT_EQ(town.tiles.front().children.size(), 2U);
    const int root = town.tiles.front().children[1];
    EXPECT_EQ(town.written.meshes.triangles, mesh.triangles.size());
    EXPECT_GT(town.written.meshes.tiles, 10U);
    EXPECT_GE(town.tiles.front().error_m, town.tiles[static_cast<std::size_t>(root)].error_m);
    test::expect_sound_tree(town.tiles, root);
    auto [all, names, areas, diameters_m] = TrianglesOfThings(things);
    std::mt19937 random(town_seed);
    std::discrete_distribution<std::size_t> by_area(areas.begin(), areas.end());
    std::uniform_real_distribution<double> share;
    for (const double refined_m : {0.0, 8.0, 15.0, 20.0, 30.0, 1000.0}) {
        Drawn drawn;
        draw(town.tiles, root, refined_m, drawn);
        const bool all_of_it = refined_m == 0.0, root_alone = refined_m == 1000.0;
        int above = 0, missing = 0;
        double farthest_m = 0.0;
        constexpr int places = 100000 / 6 + 1;
        for (int i = 0; i < places; ++i) {
            const std::size_t number = by_area(random);
            const auto& [a, b, c] = *all[number];
            const double s = std::sqrt(share(random)), t = share(random);
            const glm::dvec3 place = (1.0 - s) * a + s * (1.0 - t) * b + s * t * c;
            const auto there = drawn.things.find(*names[number]);
            if (there == drawn.things.end()) {
                ++missing;
                above += diameters_m[*names[number]] > drawn.error_m ? 1 : 0;
                continue;
            }
            double nearest_m = 1.0e9;
            for (const Triangle& one : there->second)
                nearest_m = std::min(nearest_m, glm::distance(place, nearest_of(one, place)));
            if (all_of_it) farthest_m = std::max(farthest_m, nearest_m);
            // Of a thing of several pieces some may be drawn, and others not.
            above +=
                nearest_m > millimetre_m && std::max(nearest_m, diameters_m[*names[number]]) > drawn.error_m
                    ? 1
                    : 0;
        }
        std::printf(
            "refined to %.0f m (seed %u): %zu triangles, error %.2f m, %d of %d places missing, %d above "
            "it, others within %.2f mm\n",
            refined_m, town_seed, drawn.triangles, drawn.error_m, missing, places, above,
            1000.0 * farthest_m);
        EXPECT_EQ(above, 0);
        EXPECT_LT(farthest_m, millimetre_m);
        EXPECT_EQ(drawn.triangles == mesh.triangles.size(), drawn.error_m < millimetre_m);
        EXPECT_TRUE(!all_of_it || missing == 0);
        EXPECT_TRUE(!root_alone || missing > places / 4);
    }
}

// The ground's own tiles are those of an export without the town; vertices are where the mesh has them.
TEST(MeshTiles, GroundStaysAndVerticesAreWithinAMillimetre) {
    const auto region = zurich();
    if (!region) GTEST_SKIP() << "needs alps/N47E008.SRTMGL3.hgt.zip and meshes/zurich_subset_lod2.city.json";
    const TownTiles town(*region, true);
    EXPECT_EQ(test::broken_rules(town.with), std::vector<std::string>{});
    std::size_t same = 0;
    for (const auto& entry : fs::recursive_directory_iterator(town.without)) {
        if (entry.path().extension() != ".glb") continue;
        EXPECT_TRUE(test::all_bytes(entry.path()) ==
                    test::all_bytes(town.with / fs::relative(entry.path(), town.without)));
        ++same;
    }
    EXPECT_GT(same, 5U);
    const auto things = things_in_space(region->meshes->front(), region->grids.front().field.undulation);
    Drawn drawn;
    draw(town.tiles, town.tiles.front().children[1], 0.0, drawn);
    double farthest_m = 0.0;
    for (const auto& [name, thing] : things)
        for (const Triangle& triangle : thing)
            for (const glm::dvec3& vertex : triangle) {
                double nearest_m = 1.0e9;
                for (const Triangle& other : drawn.things[name])
                    for (const glm::dvec3& corner : other)
                        nearest_m = std::min(nearest_m, glm::distance(vertex, corner));
                farthest_m = std::max(farthest_m, nearest_m);
            }
    std::printf("vertices are %.3f mm off at most\n", 1000.0 * farthest_m);
    // Half a step of 2^-11 m along three axes is 0.423 mm.
    EXPECT_LT(farthest_m, 0.00043);
    // Normals are on the side that a triangle is anticlockwise on.
    std::size_t turned = 0;
    for (const ReadTile& tile : town.tiles) {
        if (tile.features.empty()) continue;
        ASSERT_EQ(tile.normals.size(), tile.posts_m.size());
        for (const auto& corners : tile.triangles) {
            const glm::dvec3 &a = tile.posts_m[corners[0]], &b = tile.posts_m[corners[1]],
                             &c = tile.posts_m[corners[2]];
            const glm::dvec3 twice_m2 = glm::cross(b - a, c - a);
            const double longest_m =
                std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
            // Slivers of less than 5 mm turn when their corners are rounded.
            if (glm::length(twice_m2) < 0.005 * longest_m) continue;
            ++turned;
            const glm::dvec3 out = glm::normalize(twice_m2);
            for (const std::uint32_t corner : corners) EXPECT_GT(glm::dot(tile.normals[corner], out), 0.5);
        }
        EXPECT_EQ(tile.feature_types.front(), "BuildingPart");
    }
    EXPECT_GT(turned, 5000U);
}

// A sheet without features, 6 km long, of too few triangles for levels: pieces of one thing, which is never
// missing in part unsaid.
TEST(MeshTiles, OneLargeThingIsCut) {
    PlacedMesh mesh;
    mesh.path = "sheet.obj";
    constexpr std::uint32_t across = 41;
    for (std::uint32_t row = 0; row < across; ++row)
        for (std::uint32_t column = 0; column < across; ++column)
            mesh.vertices.push_back(
                {46.5 + 0.00135 * row, 8.0 + 0.00195 * column, 500.0 + 10.0 * ((row * column) % 7)});
    for (std::uint32_t row = 0; row + 1 < across; ++row)
        for (std::uint32_t column = 0; column + 1 < across; ++column) {
            const std::uint32_t a = row * across + column, b = a + 1, c = a + across, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    const fs::path folder = test::scratch_folder();
    MeshTilesRequest request;
    request.most_triangles = 256;
    request.look.generator = "test";
    const auto tiles = write_mesh_tiles(folder, std::span(&mesh, 1), {}, request);
    ASSERT_TRUE(tiles.ok()) << tiles.error().line();
    std::size_t triangles = 0;
    std::set<std::array<long long, 9>> different;
    for (const MeshTile& tile : *tiles) {
        triangles += tile.triangles;
        EXPECT_LE(tile.triangles, 256U);
        EXPECT_FALSE(tile.level);
        // The whole's diagonal, 40 quads of 150 m each way, is 8.48 km; that of the box around it a little
        // more.
        EXPECT_GT(tile.error_m, tile.children.empty() ? 0.0 : 8470.0);
        EXPECT_LT(tile.error_m, tile.children.empty() ? 0.001 : 9500.0);
        if (tile.name.empty()) continue;
        ReadTile read;
        test::read_glb(test::all_bytes(folder / tile.name), read);
        for (const auto& corners : read.triangles) {
            std::array<long long, 9> key{};
            for (std::size_t i = 0; i < 3; ++i)
                for (int axis = 0; axis < 3; ++axis)
                    key[3 * i + static_cast<std::size_t>(axis)] =
                        std::llround(read.posts_m[corners[i]][axis]);
            different.insert(key);
        }
    }
    EXPECT_EQ(triangles, mesh.triangles.size());
    EXPECT_EQ(different.size(), mesh.triangles.size());
}

// Features of all looks, one triangle each: a level and an upright one of a house, a road, water and a
// meadow.
TEST(MeshTiles, HaveTheColoursOfTheirMaterials) {
    PlacedMesh mesh;
    mesh.path = "town.city.json";
    mesh.look = gpu::mesh_look_built;
    mesh.has_look_by_type = true;
    const std::array<const char*, 5> types{"Building", "BuildingPart", "Road", "WaterBody", "LandUse"};
    for (std::uint32_t i = 0; i < types.size(); ++i) {
        MeshFeature feature;
        feature.name = std::string("thing ") + types[i];
        feature.type = types[i];
        feature.first_triangle = i;
        if (i == 1) feature.part_of = "thing Building";
        mesh.features.push_back(feature);
        mesh.feature_of.push_back(i);
        const double lat_deg = 46.5 + 0.001 * i, upright_m = i == 1 ? 9.0 : 0.0;
        const double deeper_deg = i == 1 ? 0.0 : 0.0001;
        mesh.vertices.push_back({lat_deg, 8.0, 500.0});
        mesh.vertices.push_back({lat_deg, 8.0001, 500.0});
        mesh.vertices.push_back({lat_deg + deeper_deg, 8.0001, 500.0 + upright_m});
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const fs::path folder = test::scratch_folder();
    MeshTilesRequest request;
    request.look.generator = "test";
    request.palette = {{0.3, 0.29, 0.25}, {0.25, 0.22, 0.2}, {0.01, 0.02, 0.05}};
    const auto tiles = write_mesh_tiles(folder, std::span(&mesh, 1), {}, request);
    ASSERT_TRUE(tiles.ok()) << tiles.error().line();
    ASSERT_EQ(tiles->size(), 1U);
    ReadTile read;
    test::read_glb(test::all_bytes(folder / tiles->front().name), read);
    ASSERT_EQ(read.colours.size(), 3 * types.size());
    std::map<std::string, glm::dvec3> colours;
    for (std::size_t i = 0; i < read.colours.size(); ++i)
        colours[read.feature_types[static_cast<std::size_t>(read.features[i])]] = read.colours[i];
    constexpr double of_a_byte = 0.51 / 255.0;
    const auto expect_colour = [&](const char* type, const glm::dvec3& light) {
        for (int part = 0; part < 3; ++part) EXPECT_NEAR(colours[type][part], light[part], of_a_byte) << type;
    };
    expect_colour("Road", {0.8 * 0.25, 0.8 * 0.22, 0.8 * 0.2});
    expect_colour("WaterBody", {0.01, 0.02, 0.05});
    expect_colour("LandUse", {0.3, 0.29, 0.25});
    // Gravel is grey and dark; plaster is lighter, and not bluish.
    EXPECT_NEAR(colours["Building"].x / colours["Building"].z, 0.24 / 0.22, 0.03);
    EXPECT_LT(colours["Building"].x, 0.24 * 1.36);
    EXPECT_GT(colours["BuildingPart"].x, 0.82 * 0.42 - of_a_byte);
    EXPECT_GT(colours["BuildingPart"].x, colours["BuildingPart"].z);
}

}  // namespace
}  // namespace oro
