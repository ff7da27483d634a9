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
    double error_m{};
};

ReadModel read_model(const std::vector<std::uint8_t>& glb) {
    const std::string bytes(glb.begin(), glb.end());
    const auto json_size = test::value_at<std::uint32_t>(bytes, 12);
    const auto gltf = nlohmann::json::parse(bytes.substr(20, json_size));
    EXPECT_FALSE(gltf.contains("extensionsUsed"));
    const std::size_t bin = 28 + json_size;
    const auto at = [&](int accessor) {
        return bin + gltf["bufferViews"][gltf["accessors"][static_cast<std::size_t>(accessor)]["bufferView"]
                                             .get<std::size_t>()]["byteOffset"]
                         .get<std::size_t>();
    };
    const auto& extras = gltf["asset"]["extras"];
    const Geodetic origin{extras["origin"]["lat_deg"], extras["origin"]["lon_deg"], extras["origin"]["h_m"]};
    const glm::dmat3 enu = ecef_from_enu(origin.lat_deg, origin.lon_deg);
    ReadModel model;
    model.error_m = extras["error_m"];
    const auto& primitive = gltf["meshes"][0]["primitives"][0];
    const std::size_t indices = at(primitive["indices"]), positions = at(primitive["attributes"]["POSITION"]);
    const auto count = gltf["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::size_t>();
    for (std::size_t i = 0; i < count; i += 3) {
        auto& corners = model.triangles.emplace_back();
        auto& numbers = model.numbers.emplace_back();
        for (std::size_t j = 0; j < 3; ++j) {
            numbers[j] = test::value_at<std::uint32_t>(bytes, indices + 4 * (i + j));
            const std::size_t first = positions + 12 * numbers[j];
            const double east = test::value_at<float>(bytes, first),
                         up = test::value_at<float>(bytes, first + 4),
                         south = test::value_at<float>(bytes, first + 8);
            corners[j] = ecef_from_geodetic(origin).m + enu * glm::dvec3(east, -south, up);
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
        const ReadModel read = read_model(model_glb_bytes(*model, {{0.5, 0.5, 0.5}, {}, "", "test"}));
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
    const HeldModel sum = held(field, read_model(model_glb_bytes(*model, {})), 5000);
    EXPECT_EQ(sum.above, 0);
    EXPECT_GT(sum.above_half, 0);
}

}  // namespace
}  // namespace oro
