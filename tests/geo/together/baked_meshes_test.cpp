// Meshes in baked files: read as they were written, drawn where they were, and refused where a file lies.
#include "geo/together/baked_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "core/base/compressed_bytes.h"
#include "core/mesh_file/mesh_bytes.h"
#include "core/mesh_file/stored_mesh.h"
#include "geo/meshes/mesh_facts.h"
#include "geo/together/mesh_detail.h"
#include "geo/together/mesh_surface.h"
#include "tests/geo/together/made_placed_mesh.h"
#include "tests/support/mended_container.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

using test::ball_of_two_features, test::region_with;

std::string text_in(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void put_text(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

// N that slopes: 47 m in the west of the ball, 49 m in its east.
UndulationField sloping_geoid() {
    UndulationField field;
    field.lat = {1.0, 0.0, 48, -1, 3};
    field.lon = {1.0, 0.0, 8, 1, 2};
    field.N_m = {46.0F, 50.0F, 46.0F, 50.0F, 46.0F, 50.0F};
    return field;
}

PlacedMesh described_ball() {
    PlacedMesh mesh = ball_of_two_features();
    mesh.path = "/somewhere/ball.obj", mesh.format = "OBJ", mesh.crs = "EPSG:2056 CH1903+ / LV95";
    mesh.heights = "sea level (EGM96)", mesh.note = "its unit is the foot", mesh.kind = MeshKind::city_model;
    mesh.look = 1, mesh.has_look_by_type = true, mesh.in_file = 1600, mesh.degenerate = 80;
    mesh.lengthened = 3, mesh.most_lengthened_m = 2.5, mesh.fingerprint = 0x1234567890abcdefULL;
    mesh.features[0].type = "Building", mesh.features[0].part_of = "block 7";
    mesh.features[0].attributes = {{"height", "12.5"}, {"use", "school"}};
    return mesh;
}

class BakedMeshes : public ::testing::Test {
  protected:
    fs::path folder_ = test::scratch_folder(), path_ = folder_ / "ball.mesh";
    UndulationField geoid_ = sloping_geoid();

    [[nodiscard]] Result<std::vector<PlacedMesh>> read(const fs::path& path) const {
        ORO_TRY(const auto container, Container::open(path.string()));
        return read_baked_meshes(*container, geoid_);
    }
    [[nodiscard]] std::string refusal_of(const std::string& bytes) const {
        put_text(folder_ / "changed.mesh", bytes);
        const auto meshes = read(folder_ / "changed.mesh");
        return meshes.ok() ? "" : meshes.error().line();
    }
};

TEST_F(BakedMeshes, AreReadAsTheyWereWritten) {
    const PlacedMesh mesh = described_ball();
    const auto report = write_baked_mesh(path_.string(), mesh, geoid_, 2);
    ASSERT_TRUE(report.ok()) << report.error().line();
    EXPECT_EQ(report->triangles, 1520U);
    // As a whole 3.8 a triangle, and group by group 4.2 for each triangle of all levels.
    EXPECT_LT(static_cast<double>(report->bytes), 9.0 * 1520);
    EXPECT_LT(static_cast<double>(report->group_bytes), 12.0 * 1520);
    const auto meshes = read(path_);
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    ASSERT_EQ(meshes->size(), 1U);
    const PlacedMesh& found = meshes->front();
    EXPECT_EQ(found.path, "ball.obj");
    EXPECT_EQ(found.format, mesh.format);
    EXPECT_EQ(found.crs, mesh.crs);
    EXPECT_EQ(found.heights, mesh.heights);
    EXPECT_EQ(found.note, mesh.note);
    EXPECT_EQ(found.kind, mesh.kind);
    EXPECT_EQ(found.look, mesh.look);
    EXPECT_EQ(found.has_look_by_type, mesh.has_look_by_type);
    EXPECT_EQ(found.in_file, mesh.in_file);
    EXPECT_EQ(found.degenerate, mesh.degenerate);
    EXPECT_EQ(found.lengthened, mesh.lengthened);
    EXPECT_EQ(found.most_lengthened_m, mesh.most_lengthened_m);
    EXPECT_EQ(found.fingerprint, mesh.fingerprint);
    ASSERT_EQ(found.features.size(), 2U);
    EXPECT_EQ(found.features[0].name, "north");
    EXPECT_EQ(found.features[0].type, "Building");
    EXPECT_EQ(found.features[0].part_of, "block 7");
    EXPECT_EQ(found.features[0].attributes, mesh.features[0].attributes);
    EXPECT_EQ(std::ranges::count(found.feature_of, 0U), std::ranges::count(mesh.feature_of, 0U));
    // The same triangles, where they were drawn.
    const auto drawn = [&](const PlacedMesh& one) {
        const std::vector<glm::dvec3> at = drawn_places_m(one, geoid_, 1.0);
        std::vector<std::array<std::array<double, 3>, 3>> all;
        for (const SourceTriangle& triangle : one.triangles) {
            std::array<std::array<double, 3>, 3>& corners = all.emplace_back();
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = {at[triangle[i]].x, at[triangle[i]].y, at[triangle[i]].z};
            std::ranges::rotate(corners, std::ranges::min_element(corners));
        }
        std::ranges::sort(all);
        return all;
    };
    EXPECT_EQ(drawn(found), drawn(mesh));
}

TEST_F(BakedMeshes, AreTheSameBytesByAnyNumberOfThreads) {
    ASSERT_TRUE(write_baked_mesh(path_.string(), described_ball(), geoid_, 1).ok());
    const std::string one = text_in(path_);
    ASSERT_TRUE(write_baked_mesh(path_.string(), described_ball(), geoid_, 3).ok());
    EXPECT_EQ(one, text_in(path_));
}

// The graph grows in scratch files beside it, which leave nothing there.
TEST_F(BakedMeshes, AreTheSameBytesByScratchFiles) {
    const PlacedMesh mesh = described_ball();
    ASSERT_TRUE(write_baked_mesh(path_.string(), mesh, geoid_, 2).ok());
    const std::string in_memory = text_in(path_);
    fs::remove(path_);
    ASSERT_TRUE(write_baked_mesh(path_.string(), mesh, geoid_, 2, nullptr, 0).ok());
    EXPECT_EQ(text_in(path_), in_memory);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
    const auto nowhere = write_baked_mesh("/nowhere/at/all/ball.mesh", mesh, geoid_, 2, nullptr, 0);
    ASSERT_FALSE(nowhere.ok());
    EXPECT_TRUE(nowhere.error().line().starts_with("/nowhere/at/all/: no room for a scratch file of "))
        << nowhere.error().line();
}

TEST_F(BakedMeshes, GiveTheSameCutsWithoutBuilding) {
    const PlacedMesh mesh = described_ball();
    ASSERT_TRUE(write_baked_mesh(path_.string(), mesh, geoid_, 2).ok());
    const auto meshes = read(path_);
    ASSERT_TRUE(meshes.ok());
    Region built = region_with(mesh), baked = region_with(meshes->front());
    built.grids.front().field.undulation = baked.grids.front().field.undulation = geoid_;
    const MeshDetail one = MeshDetail::of(built, 1.0, 2), other = MeshDetail::of(baked, 1.0, 2);
    EXPECT_EQ(one.built(), 1U);
    EXPECT_EQ(other.built(), 0U);
    Camera camera;
    camera.eye = {46.995, 8.5, 860.0};
    camera.vertical_fov_deg = 20.0, camera.width_px = 800, camera.height_px = 600;
    for (const double tau_px : {0.25, 1.0, 4.0}) {
        const MeshCut a = one.cut(camera, tau_px, {}, {}).value(), b = other.cut(camera, tau_px, {}, {}).value();
        EXPECT_EQ(a.triangles, b.triangles);
        EXPECT_EQ(a.error_m, b.error_m);
        EXPECT_EQ(a.error_px, b.error_px);
        // What is drawn of a mesh looks like it.
        for (const MeshCut* const cut : {&a, &b}) {
            EXPECT_EQ(cut->meshes->front().look, 1U);
            EXPECT_TRUE(cut->meshes->front().has_look_by_type);
        }
        EXPECT_EQ(std::ranges::count(a.meshes->front().feature_of, 0U),
                  std::ranges::count(b.meshes->front().feature_of, 0U));
    }
    // Elsewhere it is not drawn where the graph was built.
    EXPECT_EQ(MeshDetail::of(baked, 2.0, 2).built(), 1U);
    baked.grids.front().field.undulation = {};
    EXPECT_EQ(MeshDetail::of(baked, 1.0, 2).built(), 1U);
}

// What a bake that was broken off has built is taken for the same mesh, and for no other.
TEST_F(BakedMeshes, AreTakenFromABakeThatWasBrokenOff) {
    PlacedMesh mesh = described_ball();
    mesh.colours.assign(mesh.vertices.size(), VertexColour{200, 100, 50, 1});
    const auto written = write_baked_mesh(path_.string(), mesh, geoid_, 1);
    ASSERT_TRUE(written.ok()) << written.error().line();
    EXPECT_FALSE(written->was_there);
    const auto found = [&](const PlacedMesh& other) {
        return mesh_baked_before(path_.string(), other, geoid_);
    };
    const auto there = found(mesh);
    ASSERT_TRUE(there);
    EXPECT_TRUE(there->was_there);
    EXPECT_EQ(there->triangles, written->triangles);
    EXPECT_EQ(there->graph_triangles, written->graph_triangles);
    EXPECT_EQ(there->levels, written->levels);
    EXPECT_EQ(there->bytes, written->bytes);
    EXPECT_EQ(there->group_bytes, written->group_bytes);
    EXPECT_EQ(there->fact_bytes, written->fact_bytes);
    // In another order it is the same mesh.
    PlacedMesh other = mesh;
    std::ranges::reverse(other.triangles);
    std::ranges::reverse(other.feature_of);
    EXPECT_FALSE(found(other)) << "its graph would be built around another origin";
    other = mesh;
    std::swap(other.triangles[100], other.triangles[200]);
    std::swap(other.feature_of[100], other.feature_of[200]);
    EXPECT_TRUE(found(other));
    other = mesh;
    other.vertices[70].H_m += 0.01;
    EXPECT_FALSE(found(other)) << "a vertex";
    other = mesh;
    std::swap(other.triangles[50][0], other.triangles[50][1]);
    EXPECT_FALSE(found(other)) << "turned";
    other = mesh;
    other.triangles.pop_back(), other.feature_of.pop_back();
    EXPECT_FALSE(found(other)) << "a triangle less";
    other = mesh;
    other.feature_of[0] = 1 - other.feature_of[0];
    EXPECT_FALSE(found(other)) << "a feature's triangle";
    other = mesh;
    other.features[1].name = "east";
    EXPECT_FALSE(found(other)) << "a feature's name";
    other = mesh;
    other.colours[5].red = 201;
    EXPECT_FALSE(found(other)) << "a colour";
    other = mesh;
    other.crease_deg = 40.0;
    EXPECT_FALSE(found(other)) << "the crease";
    EXPECT_FALSE(mesh_baked_before(path_.string(), mesh, {})) << "another geoid";
    std::string bytes = text_in(path_);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    put_text(path_, bytes);
    EXPECT_FALSE(found(mesh)) << "damaged";
    EXPECT_FALSE(mesh_baked_before((folder_ / "none.mesh").string(), mesh, geoid_));
}

TEST_F(BakedMeshes, EveryChangedByteIsRefused) {
    constexpr unsigned seed = 521;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    ASSERT_TRUE(write_baked_mesh(path_.string(), described_ball(), geoid_, 2).ok());
    const std::string whole = text_in(path_);
    for (int i = 0; i < 300; ++i) {
        std::string bytes = whole;
        const std::size_t at = i < 100 ? static_cast<std::size_t>(i) : random() % bytes.size();
        if (i % 5 == 4)
            bytes.resize(at);
        else
            bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
        const std::string line = refusal_of(bytes);
        EXPECT_NE(line, "") << "byte " << at;
        EXPECT_EQ(line.find('\n'), std::string::npos);
        EXPECT_NE(line.find("changed.mesh"), std::string::npos) << line;
    }
}

}  // namespace
}  // namespace oro
