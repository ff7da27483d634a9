// Baked towns, whose graphs were built over ground, are read group by group where that ground is there: what
// is drawn is what the whole mesh gives, and other ground is found as the whole mesh finds it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <random>

#include "core/streamed_mesh/streamed_mesh.h"
#include "core/truth/true_surface.h"
#include "geo/together/baked_meshes.h"
#include "geo/together/mesh_detail.h"
#include "geo/together/mesh_ground.h"
#include "geo/together/streamed_triangles.h"
#include "tests/geo/together/made_houses.h"
#include "tests/geo/together/same_cuts.h"
#include "tests/support/mended_container.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

// 400 houses on a grid of 90 x 90 posts of 1/1200 degree, in its south-western quarter.
class StreamedTowns : public ::testing::Test {
  protected:
    void SetUp() override {
        Region region;
        region.grids.resize(1);
        region.grids[0].field = test::rough_field(47.0, 8.0, 90, 90);
        const TrueSurface surface(region.grids[0].field, 1.0, 1);
        PlacedMesh houses = test::houses_on(surface, 20);
        for (std::size_t i = 0; i < houses.triangles.size(); ++i)
            houses.feature_of.push_back(static_cast<std::uint32_t>(i / 10));
        houses.features.resize(400);
        region.meshes = std::make_shared<const std::vector<PlacedMesh>>(std::vector{houses});
        ASSERT_TRUE(write_baked_mesh(path_.string(), houses, {}, 2, &region).ok());
        whole_ = streamed_ = region;
        whole_.meshes =
            std::make_shared<const std::vector<PlacedMesh>>(read_baked_meshes(*open(), {}).value());
        streamed_.meshes =
            std::make_shared<const std::vector<PlacedMesh>>(open_baked_meshes(open(), {}).value());
        ASSERT_TRUE(streamed_.meshes->front().streamed());
        ASSERT_NE(records().ground_fingerprint, 0U);
    }
    [[nodiscard]] std::shared_ptr<const Container> open() const {
        return Container::open(path_.string()).value();
    }
    [[nodiscard]] const MeshRecords& records() const {
        return streamed_.meshes->front().streamed()->records();
    }
    static Camera eye_at(double south_m) {
        Camera camera;
        camera.eye = {46.965 - south_m / 111200.0, 8.038, 2500.0};
        camera.attitude = {0.0, -20.0, 0.0};
        camera.vertical_fov_deg = 30.0, camera.width_px = 800, camera.height_px = 600;
        return camera;
    }
    // How many graphs have to be built over the same changes of both regions' ground.
    template <class Change>
    std::pair<std::size_t, std::size_t> built_after(const Change& change) const {
        Region whole = whole_, streamed = streamed_;
        change(whole), change(streamed);
        return {MeshDetail::of(whole, 1.0, 2).built(), MeshDetail::open(streamed, 1.0, 2).value().built()};
    }
    using Both = std::pair<std::size_t, std::size_t>;

    const fs::path folder_ = test::scratch_folder(), path_ = folder_ / "houses.mesh";
    Region whole_, streamed_;
};

TEST_F(StreamedTowns, AreCutsOfTheWholeMesh) {
    const MeshDetail a = MeshDetail::of(whole_, 1.0, 2);
    EXPECT_EQ(a.built(), 0U);
    for (const int threads : {1, 3}) {
        const auto b = MeshDetail::open(streamed_, 1.0, threads);
        ASSERT_TRUE(b.ok()) << b.error().line();
        EXPECT_EQ(b->built(), 0U);
        EXPECT_EQ(streamed_.meshes->front().streamed()->done().payloads == 0, threads == 1);
        for (const double tau_px : {0.5, 1.0, 4.0})
            for (const double south_m : {300.0, 3000.0, 30000.0})
                test::expect_same(a.cut(eye_at(south_m), tau_px, {}, {}).value(),
                                  b->cut(eye_at(south_m), tau_px, {}, {}).value());
        for (const std::uint32_t level : {0U, 1U, 2U, 9U})
            test::expect_same(a.cut(eye_at(500.0), 1.0, {}, level, nullptr, MeshParts::clusters).value(),
                              b->cut(eye_at(500.0), 1.0, {}, level, nullptr, MeshParts::clusters).value());
    }
    std::printf("4,000 triangles of houses: %zu cells of ground in %zu bytes\n",
                records().ground_cells.count(), ground_cells_to_bytes(records().ground_cells).size());
}

// The ground in the cells of the records is that below the parts of the whole mesh, triangle by triangle.
TEST_F(StreamedTowns, HaveTheGroundOfTheWholeMesh) {
    const StoredMesh& stored = *whole_.meshes->front().stored();
    EXPECT_EQ(records().ground_cells, ground_cells_below_parts(stored, whole_));
    const MeshGround one = ground_below_parts(stored, whole_, 1.0),
                     other = ground_in_cells(records().ground_cells, stored.origin_ecef_m(), streamed_, 1.0);
    EXPECT_EQ(one.triangles, other.triangles);
    EXPECT_EQ(one.off_m, other.off_m);
    EXPECT_GT(one.triangles.size(), 300U);
}

// 600 posts, each changed by itself: the whole mesh and its records tell the same.
TEST_F(StreamedTowns, FindEachChangeOfGroundThatTheWholeMeshFinds) {
    const StoredMesh& stored = *whole_.meshes->front().stored();
    std::mt19937 random(52);
    int found = 0;
    for (int i = 0; i < 600; ++i) {
        Region region = whole_;
        HeightField& field = region.grids[0].field;
        const std::size_t row = 35 + random() % 25, column = 30 + random() % 35;
        float& H_m = field.H_m[row * 90 + column];
        H_m = i % 10 == 0 ? void_height_m : H_m + 0.01F;
        const auto fingerprint = [&](const MeshGround& ground) {
            return fingerprint_of(ground, stored.origin_ecef_m());
        };
        const std::uint64_t now = fingerprint(ground_below_parts(stored, region, 1.0));
        ASSERT_EQ(fingerprint(ground_in_cells(records().ground_cells, stored.origin_ecef_m(), region, 1.0)),
                  now);
        Region by_groups = region;
        by_groups.meshes = streamed_.meshes;
        ASSERT_EQ(streams_as_drawn(by_groups.meshes->front(), by_groups, 1.0),
                  now == stored.ground_fingerprint);
        found += now != stored.ground_fingerprint ? 1 : 0;
    }
    std::printf("%d of 600 posts lie below or beside houses\n", found);
    EXPECT_GT(found, 100);
    EXPECT_LT(found, 500);
}

TEST_F(StreamedTowns, OverOtherGroundAreBuiltAgainAsTheWholeMeshIs) {
    EXPECT_EQ(built_after([](Region&) {}), Both(0, 0));
    EXPECT_EQ(built_after([](Region& region) {
                  for (float& H_m : region.grids[0].field.H_m) H_m -= 30.0F;
              }),
              Both(1, 1));
    // Ground far from the houses is not asked for.
    EXPECT_EQ(built_after([](Region& region) { region.grids[0].field.H_m[0] += 30.0F; }), Both(0, 0));
    // A grid over them; the same posts once more are the same ground, in front and behind.
    const auto with_another = [](Region& region, int rank, float higher_m) {
        region.grids[0].rank = 1;
        RegionGrid other = region.grids[0];
        other.rank = rank;
        for (float& H_m : other.field.H_m) H_m += higher_m;
        region.grids.push_back(other);
    };
    EXPECT_EQ(built_after([&](Region& region) { with_another(region, 0, 5.0F); }), Both(1, 1));
    EXPECT_EQ(built_after([&](Region& region) { with_another(region, 0, 0.0F); }), Both(0, 0));
    EXPECT_EQ(built_after([&](Region& region) { with_another(region, 2, 5.0F); }), Both(0, 0));
    // A grid that does not reach there changes nothing, at either place.
    for (const bool is_first : {false, true})
        EXPECT_EQ(built_after([&](Region& region) {
                      RegionGrid far = region.grids[0];
                      far.field = test::rough_field(49.0, 11.0, 20, 20);
                      far.rank = 1;
                      region.grids.insert(is_first ? region.grids.begin() : region.grids.end(), far);
                  }),
                  Both(0, 0));
    // The same posts a cell further: other ground.
    EXPECT_EQ(built_after([](Region& region) { --region.grids[0].field.grid.lon.first; }), Both(1, 1));
    EXPECT_EQ(MeshDetail::open(streamed_, 1.5, 2).value().built(), 1U);
}

TEST_F(StreamedTowns, OverOtherGroundAreCutsOfTheWholeMesh) {
    Region whole = whole_, streamed = streamed_;
    for (Region* const region : {&whole, &streamed})
        for (float& H_m : region->grids[0].field.H_m) H_m -= 3.0F;
    test::expect_same(MeshDetail::of(whole, 1.0, 2).cut(eye_at(3000.0), 1.0, {}, {}).value(),
                      MeshDetail::open(streamed, 1.0, 2).value().cut(eye_at(3000.0), 1.0, {}, {}).value());
}

// Cells that lie, with right checksums: a fingerprint of other ground, so the mesh is read whole; --check
// tells it.
TEST_F(StreamedTowns, ThatLieOfTheirCellsAreReadWhole) {
    const PlacedMesh& mesh = whole_.meshes->front();
    EXPECT_TRUE(check_streamed_mesh(*open(), 0, mesh, whole_).ok());
    Region other = whole_;
    other.grids[0].field.grid.lat.first += 1;
    EXPECT_FALSE(check_streamed_mesh(*open(), 0, mesh, other).ok());
    const StoredMesh& stored = *mesh.stored();
    for (const std::size_t fault : {0U, 1U, 2U, 3U}) {
        GroundCells cells = records().ground_cells;
        GroundCells::Grid& grid = cells.grids[0];
        if (fault == 0) grid.runs.pop_back();
        if (fault == 1) ++grid.runs.front().row;
        if (fault == 2) grid.runs.push_back({4000000, 1, 4});
        if (fault == 3) ++grid.posts;
        const MeshGround ground = ground_in_cells(cells, stored.origin_ecef_m(), streamed_, 1.0);
        EXPECT_EQ(fingerprint_of(ground, stored.origin_ecef_m()) == stored.ground_fingerprint, fault == 2)
            << fault;
    }
}

// What was baked for the same mesh over other ground is not taken for it.
TEST_F(StreamedTowns, OfABrokenBakeAreTakenOverTheSameGroundAlone) {
    Region region = whole_;
    PlacedMesh mesh = whole_.meshes->front();
    mesh.baked = nullptr;
    EXPECT_TRUE(mesh_baked_before(path_.string(), mesh, {}, &region));
    for (float& H_m : region.grids[0].field.H_m) H_m -= 1.0F;
    EXPECT_FALSE(mesh_baked_before(path_.string(), mesh, {}, &region));
    EXPECT_FALSE(mesh_baked_before(path_.string(), mesh, {}));
}

}  // namespace
}  // namespace oro
