// What is exported opens again as a mesh: the same places, and the same colours, out of compressed bytes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "core/earth/ellipsoid.h"
#include "geo/meshes/mesh_file.h"
#include "geo/tilesets/glb.h"
#include "geo/tilesets/ground_model.h"

namespace oro {
namespace {

std::string exported_file(const std::string& name, const std::vector<std::uint8_t>& bytes) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "exported_mesh";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / name).string();
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path;
}

// A lattice of hills around 47 N, 8.5 E in steps of 1/8 m, reach: steps from its middle; the last two
// triangles are a wall. colours: of the vertices.
GroundMesh exported_hills(int reach, VertexFacts& facts) {
    GroundMesh mesh;
    mesh.centre_m = ecef_from_geodetic({47.0, 8.5, 500.0}).m;
    mesh.ecef_from_mesh = ecef_from_enu(47.0, 8.5);
    mesh.step_m = 0.125;
    constexpr int side = 20;
    for (int row = 0; row <= side; ++row)
        for (int column = 0; column <= side; ++column) {
            mesh.positions.push_back({reach * (2 * column - side) / side, reach * (2 * row - side) / side,
                                      static_cast<int>(40.0 * std::sin(row * 0.7) * std::cos(column * 0.4))});
            mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
            facts.colours.push_back({row / 20.0, column / 20.0, 0.25});
        }
    const auto at = [](int row, int column) { return static_cast<std::uint32_t>(row * (side + 1) + column); };
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            for (const std::uint32_t corner : {at(row, column), at(row, column + 1), at(row + 1, column + 1),
                                               at(row, column), at(row + 1, column + 1), at(row + 1, column)})
                mesh.indices.push_back(corner);
    mesh.ground_triangles = mesh.indices.size() / 3;
    for (const std::uint32_t corner : {at(0, 0), at(0, 5), at(0, 9), at(0, 9), at(0, 5), at(0, 12)})
        mesh.indices.push_back(corner);
    return mesh;
}

// Short coordinates and long ones are written by other codes.
TEST(ExportedMesh, OfATileIsWhereItWas) {
    for (const int reach : {20000, 400000}) {
        VertexFacts facts;
        const GroundMesh mesh = exported_hills(reach, facts);
        const std::string tile = exported_file("tile.glb", glb_bytes(mesh, facts, {})),
                          path = tile.substr(0, tile.rfind('/')) + "/tileset.json";
        std::ofstream(path) << R"({"asset":{"version":"1.1"},"geometricError":1,"root":)"
                               R"({"refine":"REPLACE","content":{"uri":"tile.glb"}}})";
        const auto read = read_mesh(path);
        ASSERT_TRUE(read.ok()) << read.error().line();
        ASSERT_EQ(read->triangles.size(), mesh.ground_triangles) << "walls are left out";
        ASSERT_EQ(read->vertices.size(), mesh.positions.size());
        ASSERT_EQ(read->colours.size(), mesh.positions.size());
        double worst_m = 0.0;
        int matched = 0;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::dvec3 expected =
                mesh.centre_m + mesh.ecef_from_mesh * (mesh.step_m * glm::dvec3(mesh.positions[i]));
            double nearest_m = 1.0e9;
            std::size_t nearest = 0;
            for (std::size_t k = 0; k < read->vertices.size(); ++k)
                if (const double off_m = glm::distance(expected, read->vertices[k]); off_m < nearest_m)
                    nearest_m = off_m, nearest = k;
            worst_m = std::max(worst_m, nearest_m);
            // Light in steps of 1/255, then a code of 8 bits, whose steps are 2.28/255 of light at the bright
            // end.
            const std::array<double, 3> light = light_of_colour(read->colours[nearest]);
            for (std::size_t part = 0; part < 3; ++part)
                matched +=
                    std::abs(light[part] - facts.colours[i][part]) < 0.5 * (1.0 + 2.28) / 255.0 ? 1 : 0;
        }
        EXPECT_LT(worst_m, 1.0e-8) << "metres; doubles of 6,378 km are 1e-9 m apart";
        EXPECT_EQ(matched, 3 * 441);
    }
}

// Each cut, and each of many damaged bytes, of what is compressed ends in an answer.
TEST(ExportedMesh, DamagedTilesEndInAnAnswer) {
    const unsigned seed = 5233;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    VertexFacts facts;
    const std::vector<std::uint8_t> sound = glb_bytes(exported_hills(20000, facts), facts, {});
    int refused = 0;
    for (int i = 0; i < 600; ++i) {
        std::vector<std::uint8_t> bytes = sound;
        if (i % 4 == 0)
            bytes.resize(random() % bytes.size());
        else
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random() % 256);
        const auto read = read_mesh(exported_file("damaged.glb", bytes));
        if (!read.ok()) {
            ++refused;
            EXPECT_FALSE(read.error().what.empty());
            continue;
        }
        for (const SourceTriangle& triangle : read->triangles)
            for (const std::uint32_t corner : triangle) ASSERT_LT(corner, read->vertices.size());
    }
    EXPECT_GT(refused, 150);
}

// A model says where its middle is: east, up and south of it in float, whose steps at 2 km are 0.12 mm.
TEST(ExportedMesh, OfAModelLiesAroundItsOrigin) {
    GroundModel model;
    model.origin = {47.0, 8.5, 400.0};
    model.positions_m = {{0.0F, 0.0F, 0.0F}, {2000.0F, 30.0F, 0.0F}, {0.0F, 10.0F, -1500.0F}};
    model.normals.assign(3, {0.0F, 1.0F, 0.0F});
    model.indices = {0, 1, 2};
    const std::vector<std::array<double, 3>> colours{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const auto read = read_mesh(exported_file("model.glb", model_glb_bytes(model, colours, {}, {})));
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->crs, "EPSG:4978");
    const glm::dvec3 middle = ecef_from_geodetic(model.origin).m;
    const glm::dmat3 axes = ecef_from_enu(47.0, 8.5);
    EXPECT_LT(glm::distance(read->vertices[0], middle), 1.0e-8);
    EXPECT_LT(glm::distance(read->vertices[1], middle + axes * glm::dvec3(2000.0, 0.0, 30.0)), 1.0e-8);
    EXPECT_LT(glm::distance(read->vertices[2], middle + axes * glm::dvec3(0.0, 1500.0, 10.0)), 1.0e-8);
    const ScratchVector<VertexColour> expected{{255, 0, 0, 1}, {0, 255, 0, 1}, {0, 0, 255, 1}};
    EXPECT_EQ(read->colours, expected);
}

}  // namespace
}  // namespace oro
