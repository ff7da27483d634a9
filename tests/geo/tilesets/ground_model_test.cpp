// One model of the ground against the surface, read by the specification of glTF alone.
#include "geo/tilesets/ground_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "core/truth/triangle_bvh.h"
#include "core/truth/true_surface.h"
#include "tests/geo/tilesets/read_tileset.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

struct ReadModel {
    std::vector<std::array<glm::dvec3, 3>> triangles;  // ECEF
    std::vector<std::array<std::uint32_t, 3>> numbers;
    std::vector<glm::dvec3> places_m, normals, colours;  // of each vertex; ECEF; linear light
    std::string name;
    nlohmann::json material;
    double error_m{};
};

// Where an accessor's values begin in the file, and how far they are apart.
struct ValuesAt {
    std::size_t first{}, stride{}, count{};
};
ValuesAt values_at(const nlohmann::json& gltf, std::size_t bin, std::size_t number, int component,
                   std::size_t packed_bytes) {
    const auto& accessor = gltf["accessors"][number];
    EXPECT_EQ(accessor["componentType"], component);
    const auto& view = gltf["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const auto count = accessor["count"].get<std::size_t>(), stride = view.value("byteStride", packed_bytes);
    EXPECT_EQ(view["byteLength"], count * stride);
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
    return {bin + view["byteOffset"].get<std::size_t>(), stride, count};
}

// The part with a number: that of the ground is 0.
ReadModel read_model(const std::vector<std::uint8_t>& glb, std::size_t part = 0) {
    const std::string bytes(glb.begin(), glb.end());
    const auto json_size = test::value_at<std::uint32_t>(bytes, 12);
    const auto gltf = nlohmann::json::parse(bytes.substr(20, json_size));
    EXPECT_FALSE(gltf.contains("extensionsUsed"));
    const std::size_t bin = 28 + json_size;
    const auto& extras = gltf["asset"]["extras"];
    const Geodetic origin{extras["origin"]["lat_deg"], extras["origin"]["lon_deg"], extras["origin"]["h_m"]};
    const glm::dmat3 enu = ecef_from_enu(origin.lat_deg, origin.lon_deg);
    ReadModel model;
    model.error_m = extras["error_m"];
    const auto& node = gltf["nodes"][gltf["scenes"][0]["nodes"][part].get<std::size_t>()];
    model.name = node.value("name", "");
    const auto& primitive = gltf["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
    model.material = gltf["materials"][primitive["material"].get<std::size_t>()];
    const auto& attributes = primitive["attributes"];
    constexpr int is_byte = 5121, is_integer = 5125, is_float = 5126;
    const auto vectors_of = [&](const char* attribute) {
        std::vector<glm::dvec3> vectors;  // along east, north, up
        const ValuesAt at = values_at(gltf, bin, attributes[attribute], is_float, 12);
        for (std::size_t i = 0; i < at.count; ++i) {
            const std::size_t first = at.first + i * at.stride;
            const double east = test::value_at<float>(bytes, first),
                         up = test::value_at<float>(bytes, first + 4),
                         south = test::value_at<float>(bytes, first + 8);
            vectors.push_back(enu * glm::dvec3(east, -south, up));
        }
        return vectors;
    };
    for (const glm::dvec3& place_m : vectors_of("POSITION"))
        model.places_m.push_back(ecef_from_geodetic(origin).m + place_m);
    model.normals = vectors_of("NORMAL");
    if (attributes.contains("COLOR_0")) {
        const ValuesAt at = values_at(gltf, bin, attributes["COLOR_0"], is_byte, 3);
        EXPECT_EQ(at.stride % 4, 0U);
        for (std::size_t i = 0; i < 3 * at.count; ++i) {
            if (i % 3 == 0) model.colours.emplace_back();
            model.colours.back()[static_cast<int>(i % 3)] =
                test::value_at<std::uint8_t>(bytes, at.first + i / 3 * at.stride + i % 3) / 255.0;
        }
        EXPECT_EQ(gltf["accessors"][attributes["COLOR_0"].get<std::size_t>()]["normalized"], true);
    }
    const ValuesAt indices = values_at(gltf, bin, primitive["indices"], is_integer, 4);
    for (std::size_t i = 0; i + 2 < indices.count; i += 3) {
        auto& numbers = model.numbers.emplace_back();
        auto& corners = model.triangles.emplace_back();
        for (std::size_t j = 0; j < 3; ++j) {
            numbers[j] = test::value_at<std::uint32_t>(bytes, indices.first + indices.stride * (i + j));
            corners[j] = model.places_m.at(numbers[j]);
        }
    }
    return model;
}

struct HeldModel {
    int places{}, above{}, above_half{};
};

// Random places of the surface: the nearest point of the model, found in all triangles around, is no farther
// than the error. (At one row and column it is farther, if anything.)
HeldModel held(const HeightField& field, const ReadModel& model, int places) {
    constexpr unsigned seed = 20261128;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share;
    const TrueSurface surface(field, 1.0, 2);
    const PostGrid& grid = field.grid;
    const PostPlace middle = grid.place_at(0.5 * grid.rows(), 0.5 * grid.columns());
    const TriangleBvh bvh(model.triangles, ecef_from_enu(middle.lat_deg, middle.lon_deg),
                          std::vector<std::uint32_t>(model.triangles.size()));
    HeldModel sum;
    for (int i = 0; i < places; ++i) {
        // Off the rim, where a line upwards may pass the flat model by.
        const double row = 0.01 + share(random) * (grid.rows() - 1.02),
                     column = 0.01 + share(random) * (grid.columns() - 1.02);
        const auto h_m = surface.h_at_m(row, column);
        if (!h_m) continue;
        const PostPlace at = grid.place_at(row, column);
        const glm::dvec3 up = ecef_from_enu(at.lat_deg, at.lon_deg)[2];
        constexpr double high_m = 20000.0;
        const glm::dvec3 from = ecef_from_geodetic({at.lat_deg, at.lon_deg, *h_m}).m + high_m * up;
        const auto down = bvh.first_hit(from, -up, 2.0 * high_m);
        EXPECT_TRUE(down) << row << " " << column;
        if (!down) continue;
        ++sum.places;
        // Straight down, not at one row and column: a hundredth covers how much farther that is.
        sum.above += std::abs(down->along_m - high_m) > 1.01 * model.error_m ? 1 : 0;
        sum.above_half += std::abs(down->along_m - high_m) > 0.4 * model.error_m ? 1 : 0;
    }
    std::printf("%zu triangles, %d places, %d above %.2f m, %d above 0.4 of it\n", model.triangles.size(),
                sum.places, sum.above, model.error_m, sum.above_half);
    return sum;
}

// Sides of one triangle alone, that are not at the grid's rim.
std::size_t open_sides(const ReadModel& model) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& numbers : model.numbers)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(numbers[i], numbers[(i + 1) % 3]);
            ++sides[{low, high}];
        }
    EXPECT_TRUE(std::ranges::all_of(sides, [](const auto& side) { return side.second <= 2; }));
    return static_cast<std::size_t>(
        std::ranges::count_if(sides, [](const auto& side) { return side.second == 1; }));
}

TEST(GroundModel, IsWithinItsErrorAndWithoutGaps) {
    // Rougher from west to east, so that patches of several levels meet.
    constexpr int posts = 530;
    const HeightField field = test::made_field(47.0, 8.0, 1200.0, posts, posts, [](double lat, double lon) {
        return static_cast<float>((lon - 8.0) * 2.0 * test::rough_H_m(lat, lon));
    });
    const auto pages = pages_in_memory(field, 1.0, 2);
    std::size_t triangles_before = 2 * (posts - 1) * (posts - 1) + 1;
    for (const double largest_m : {0.0, 5.0, 20.0, 60.0, 200.0}) {
        const auto model = ground_model(*pages, largest_m);
        ASSERT_TRUE(model.ok()) << model.error().line();
        EXPECT_LE(model->error_m, largest_m + 0.1);
        const ReadModel read = read_model(model_glb_bytes(*model, {}, {}, {{0.5, 0.5, 0.5}, {}, "", "test"}));
        EXPECT_LT(read.triangles.size(), triangles_before);
        triangles_before = read.triangles.size();
        const HeldModel sum = held(field, read, 20000);
        EXPECT_EQ(sum.above, 0);
        EXPECT_EQ(sum.places, 20000);
        EXPECT_TRUE(sum.above_half > 0 || model->error_m < 1.0);
        // Around the rim there is one side for each step, and no other is open.
        const std::size_t open = open_sides(read);
        EXPECT_LE(open, 4U * (posts - 1));
        if (largest_m == 0.0) {
            EXPECT_EQ(read.triangles.size(), 2U * (posts - 1) * (posts - 1));
            EXPECT_EQ(open, 4U * (posts - 1));
        }
        // Euler: a disc of triangles has T = 2 V - B - 2, where B is the length of its rim.
        EXPECT_EQ(read.triangles.size(), 2 * model->positions_m.size() - open - 2);
    }
}

TEST(GroundModel, HoldsOnANet) {
    const test::PlaneOfPosts plane{200, 170, {46.0, 8.0}, 25.0, 33.0};
    const HeightField field = test::net_field(plane, [&](double row, double column) {
        const PostPlace at = plane.place_of(row, column);
        return test::rough_H_m(at.lat_deg, at.lon_deg);
    });
    const auto pages = pages_in_memory(field, 1.0, 2);
    const auto model = ground_model(*pages, 30.0);
    ASSERT_TRUE(model.ok());
    const HeldModel sum = held(field, read_model(model_glb_bytes(*model, {}, {}, {})), 5000);
    EXPECT_EQ(sum.above, 0);
    EXPECT_GT(sum.above_half, 0);
}

// A colour of each vertex by its post, and a house beside the ground: all where they are, in their colours.
TEST(GroundModel, HasColoursAndMeshesWhereTheyAre) {
    const HeightField field = test::rough_field(47.0, 8.0, 60, 50);
    const auto pages = pages_in_memory(field, 1.0, 2);
    const auto model = ground_model(*pages, 20.0);
    ASSERT_TRUE(model.ok()) << model.error().line();
    ASSERT_EQ(model->posts.size(), model->positions_m.size());
    std::vector<std::array<double, 3>> colours;
    for (const PageIndex& post : model->posts)
        colours.push_back({post.row / 100.0, post.column / 100.0, 2.0});
    PlacedMesh tent;  // a wall, a slope and a floor
    tent.path = "/data/tent.obj";
    tent.look = gpu::mesh_look_built;
    tent.vertices = {
        {46.98, 8.01, 500.0}, {46.98, 8.0101, 500.0}, {46.98, 8.0101, 505.0}, {46.9801, 8.01, 500.0}};
    tent.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}};
    const MeshPalette palette;
    const std::vector<ModelMesh> meshes{model_mesh(tent, {}, model->origin, palette)};
    const auto bytes = model_glb_bytes(*model, colours, meshes, {{0.5, 0.5, 0.5}, {}, "", "test"});
    const ReadModel ground = read_model(bytes), read = read_model(bytes, 1);
    EXPECT_EQ(ground.name, "ground");
    EXPECT_EQ(ground.material["pbrMetallicRoughness"]["baseColorFactor"],
              (std::vector<double>{1.0, 1.0, 1.0, 1.0}));
    EXPECT_FALSE(ground.material.contains("doubleSided"));
    ASSERT_EQ(ground.colours.size(), colours.size());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const Geodetic at = geodetic_from_ecef({ground.places_m[i]});
        const PostNumber post = field.grid.post_at(at.lat_deg, at.lon_deg);
        EXPECT_NEAR(ground.colours[i].x, post.row / 100.0, 0.5 / 255.0 + 1e-6);
        EXPECT_NEAR(ground.colours[i].y, post.column / 100.0, 0.5 / 255.0 + 1e-6);
        EXPECT_EQ(ground.colours[i].z, 1.0);
    }
    EXPECT_EQ(read.name, "tent.obj");
    EXPECT_EQ(read.material["doubleSided"], true);
    ASSERT_EQ(read.triangles.size(), tent.triangles.size());
    for (std::size_t i = 0; i < read.triangles.size(); ++i) {
        const auto& [a, b, c] = read.triangles[i];
        const glm::dvec3 out = glm::normalize(glm::cross(b - a, c - a));
        for (std::size_t j = 0; j < 3; ++j) {
            const PlacedVertex& vertex = tent.vertices[tent.triangles[i][j]];
            const glm::dvec3 at_m = ecef_from_geodetic({vertex.lat_deg, vertex.lon_deg, vertex.H_m}).m;
            EXPECT_LT(glm::distance(read.triangles[i][j], at_m), 0.001);
            EXPECT_GT(glm::dot(read.normals[read.numbers[i][j]], out), 0.99);
        }
    }
    // As MeshColours, of a building without a name: plaster, gravel, and slate on 33 degrees.
    const glm::dvec3 plaster(0.673, 0.641, 0.571), gravel(0.224, 0.219, 0.205), slate(0.095, 0.088, 0.084);
    constexpr double of_a_byte = 0.6 / 255.0 + 0.0005;
    EXPECT_LT(glm::distance(read.colours[read.numbers[0][0]], plaster), 2.0 * of_a_byte);
    EXPECT_LT(glm::distance(read.colours[read.numbers[1][0]], gravel), 2.0 * of_a_byte);
    EXPECT_LT(glm::distance(read.colours[read.numbers[2][0]], slate), 2.0 * of_a_byte);
}

}  // namespace
}  // namespace oro
