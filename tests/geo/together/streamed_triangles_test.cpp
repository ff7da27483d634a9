// Baked meshes that are read group by group: cuts, and what lines meet, are those of the mesh that is read
// whole, and no more groups are read than these ask for.
#include "geo/together/streamed_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "core/streamed_mesh/streamed_mesh.h"
#include "geo/together/baked_meshes.h"
#include "geo/together/mesh_detail.h"
#include "geo/together/region_ground.h"
#include "tests/geo/together/made_placed_mesh.h"
#include "tests/geo/together/same_cuts.h"
#include "tests/support/mended_container.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

using test::expect_same;
using test::region_with;

// A rough sheet of n x n cells, 1.2 km wide, whose vertices have colours: many groups.
PlacedMesh coloured_sheet(std::uint32_t n) {
    PlacedMesh mesh;
    mesh.path = "sheet.ply", mesh.format = "PLY";
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t k = 0; k <= n; ++k) {
            const double x = static_cast<double>(i) / n, y = static_cast<double>(k) / n;
            mesh.vertices.push_back(
                {47.0 + 0.011 * x, 8.5 + 0.015 * y,
                 600.0 + 40.0 * std::sin(9.0 * x) * std::cos(7.0 * y) + 0.8 * std::sin(91.0 * i * k)});
            mesh.colours.push_back(
                {static_cast<std::uint8_t>(255.0 * x), static_cast<std::uint8_t>(255.0 * y),
                 static_cast<std::uint8_t>(i * k % 256), static_cast<std::uint8_t>(k % 13 == 0 ? 0 : 1)});
        }
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t at = i * (n + 1) + k;
            mesh.triangles.push_back({at, at + 1, at + n + 1});
            mesh.triangles.push_back({at + 1, at + n + 2, at + n + 1});
        }
    return mesh;
}

UndulationField geoid_of_47_m() {
    UndulationField field;
    field.lat = {1.0, 0.0, 48, -1, 3};
    field.lon = {1.0, 0.0, 8, 1, 2};
    field.N_m = {46.0F, 50.0F, 46.0F, 50.0F, 46.0F, 50.0F};
    return field;
}

class StreamedTriangles : public ::testing::Test {
  protected:
    void bake(const PlacedMesh& mesh) {
        const auto report = write_baked_mesh(path_.string(), mesh, geoid_, 2);
        ASSERT_TRUE(report.ok()) << report.error().line();
        whole_ = region_of(read_baked_meshes(*open(), geoid_).value());
        streamed_ = region_of(open_baked_meshes(open(), geoid_).value());
        ASSERT_TRUE(mesh_of(streamed_).streamed());
        ASSERT_TRUE(mesh_of(streamed_).triangles.empty());
    }
    [[nodiscard]] std::shared_ptr<const Container> open() const {
        return Container::open(path_.string()).value();
    }
    [[nodiscard]] Region region_of(std::vector<PlacedMesh> meshes) const {
        Region region = region_with(std::move(meshes.front()));
        region.grids.front().field.undulation = geoid_;
        return region;
    }
    static const PlacedMesh& mesh_of(const Region& region) { return region.meshes->front(); }
    static StreamedMesh::Done done(const Region& region) { return mesh_of(region).streamed()->done(); }
    static Camera eye_at(double south_m, double up_m) {
        Camera camera;
        camera.eye = {47.0 - south_m / 111200.0, 8.5075, 700.0 + up_m};
        camera.attitude = {0.0, -5.0, 0.0};
        camera.vertical_fov_deg = 30.0, camera.width_px = 800, camera.height_px = 600;
        return camera;
    }
    void expect_same_cuts() {
        const MeshDetail a = MeshDetail::of(whole_, 1.0, 2);
        for (const int threads : {1, 3}) {
            const auto b = MeshDetail::open(streamed_, 1.0, threads);
            ASSERT_TRUE(b.ok()) << b.error().line();
            EXPECT_EQ(b->built(), 0U);
            for (const double tau_px : {0.2, 1.0, 6.0})
                for (const double south_m : {100.0, 900.0, 9000.0})
                    expect_same(a.cut(eye_at(south_m, 80.0), tau_px, {}, {}).value(),
                                b->cut(eye_at(south_m, 80.0), tau_px, {}, {}).value());
            for (const std::uint32_t level : {0U, 1U, 3U, 9U})
                expect_same(a.cut(eye_at(500.0, 80.0), 1.0, {}, level, nullptr, MeshParts::groups).value(),
                            b->cut(eye_at(500.0, 80.0), 1.0, {}, level, nullptr, MeshParts::groups).value());
        }
    }
    void change(std::size_t at) {
        std::ifstream file(path_, std::ios::binary);
        std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        bytes[at] = static_cast<char>(bytes[at] ^ 16);
        std::ofstream(path_, std::ios::binary) << bytes;
    }

    const fs::path folder_ = test::scratch_folder(), path_ = folder_ / "one.mesh";
    const UndulationField geoid_ = geoid_of_47_m();
    Region whole_, streamed_;
};

TEST_F(StreamedTriangles, OfAColouredSheetAreThoseOfTheWholeMesh) {
    bake(coloured_sheet(90));
    expect_same_cuts();
}

TEST_F(StreamedTriangles, OfABallOfTwoFeaturesAreThoseOfTheWholeMesh) {
    bake(test::ball_of_two_features());
    expect_same_cuts();
}

// How much is read is known: of a far eye a few groups with those that they are told by, and of the same eye
// once more none.
TEST_F(StreamedTriangles, ReadsTheGroupsOfTheCutAlone) {
    bake(coloured_sheet(90));
    EXPECT_EQ(done(streamed_).payloads, 0U);
    const auto detail = MeshDetail::open(streamed_, 1.0, 2);
    ASSERT_TRUE(detail.ok());
    EXPECT_EQ(done(streamed_).payloads, 0U);
    const auto chosen = [&](double south_m) {
        const Camera camera = eye_at(south_m, 80.0);
        return detail->chosen(std::span(&camera, 1), 1.0, {}, {});
    };
    const auto groups_of = [&](const MeshCut& cut) {
        const MeshRecords& records = mesh_of(streamed_).streamed()->records();
        std::vector<std::uint32_t> groups;
        for (const std::uint32_t one : cut.clusters.front())
            groups.push_back(records.payload_of(records.graph.clusters.clusters[one]));
        std::ranges::sort(groups);
        groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
        return groups.size();
    };
    const MeshCut far = chosen(40000.0), near = chosen(300.0);
    EXPECT_EQ(done(streamed_).payloads, 0U);
    ASSERT_TRUE(detail->with_meshes(far).ok());
    const StreamedMesh::Done of_far = done(streamed_);
    EXPECT_GE(of_far.payloads, groups_of(far));
    EXPECT_LE(of_far.payloads, groups_of(far) + 7);
    EXPECT_LT(of_far.triangles, 3000U);
    ASSERT_TRUE(detail->with_meshes(far).ok());
    EXPECT_EQ(done(streamed_).payloads, of_far.payloads);
    ASSERT_TRUE(detail->with_meshes(near).ok());
    const MeshRecords& records = mesh_of(streamed_).streamed()->records();
    EXPECT_LE(done(streamed_).payloads, records.payloads.size());  // none twice
    EXPECT_GT(done(streamed_).payloads, of_far.payloads);
    std::printf("16,200 triangles: far %zu groups, near %zu\n", groups_of(far), groups_of(near));
    // No more is held than may be, and what is let go of is read once more.
    const std::uint64_t read = done(streamed_).payloads;
    detail->hold_at_most(50000);
    EXPECT_LE(done(streamed_).held_bytes, 50000U);
    ASSERT_TRUE(detail->with_meshes(near).ok());
    EXPECT_GT(done(streamed_).payloads, read);
    EXPECT_LE(done(streamed_).held_bytes, 50000U);
}

// Not exaggerated, and over the same geoid, it is drawn as the file has it. Elsewhere it is read whole.
TEST_F(StreamedTriangles, ElsewhereAreReadWhole) {
    bake(test::ball_of_two_features());
    const auto high = MeshDetail::open(streamed_, 2.0, 2);
    ASSERT_TRUE(high.ok()) << high.error().line();
    EXPECT_EQ(high->built(), 1U);
    Region other = streamed_;
    other.grids.front().field.undulation.N_m[0] += 1.0F;
    const auto lifted = MeshDetail::open(other, 1.0, 2);
    ASSERT_TRUE(lifted.ok()) << lifted.error().line();
    EXPECT_EQ(done(streamed_).payloads, 0U);
    EXPECT_EQ(whole_meshes(streamed_).value()->front().triangles, mesh_of(whole_).triangles);
    EXPECT_EQ(whole_meshes(whole_).value(), whole_.meshes);
}

// Damage of a group that is drawn is one error with file and byte; of another it does not matter.
TEST_F(StreamedTriangles, DamageMattersWhereItIsDrawn) {
    bake(coloured_sheet(90));
    const Chunk chunk = test::chunk_of(path_, ChunkType::mesh_payloads);
    const MeshRecords& records = mesh_of(streamed_).streamed()->records();
    const std::size_t of_leaf = chunk.offset + records.payloads[2].offset + records.payloads[2].bytes / 2;
    change(of_leaf);
    streamed_ = region_of(open_baked_meshes(open(), geoid_).value());
    const auto detail = MeshDetail::open(streamed_, 1.0, 2);
    ASSERT_TRUE(detail.ok());
    EXPECT_TRUE(detail->cut(eye_at(9000.0, 80.0), 1.0, {}, {}).ok());
    const auto all = detail->cut(eye_at(9000.0, 80.0), 1.0, {}, 0U);
    ASSERT_FALSE(all.ok());
    EXPECT_NE(all.error().line().find("one.mesh"), std::string::npos);
    EXPECT_NE(all.error().line().find("level 0 below group 2 of the mesh has checksum"), std::string::npos)
        << all.error().line();
    // Who reads all of the mesh is told, too.
    EXPECT_FALSE(read_baked_meshes(*open(), geoid_).ok());
    EXPECT_FALSE(check_streamed_mesh(*open(), 0, mesh_of(whole_), whole_).ok());
    change(of_leaf);
    EXPECT_TRUE(check_streamed_mesh(*open(), 0, mesh_of(whole_), whole_).ok());
}

// Two meshes of one file, and one between them that has no groups: each is what it is alone.
TEST_F(StreamedTriangles, OfSeveralMeshesOfAFileAreTheirOwn) {
    std::vector<ContainerPart> parts;
    const auto add = [&](const PlacedMesh& mesh, const std::string& name) {
        const std::string path = (folder_ / name).string();
        ASSERT_TRUE(write_baked_mesh(path, mesh, geoid_, 2).ok());
        parts.push_back({path, static_cast<std::uint32_t>(parts.size())});
    };
    add(coloured_sheet(40), "sheet");
    add(test::ball_of_two_features(), "ball");
    add(coloured_sheet(50), "other");
    std::string joined;
    const auto written = join_containers(parts, [&](std::span<const std::byte> bytes) -> Result<void> {
        joined.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return {};
    });
    ASSERT_TRUE(written.ok()) << written.error().line();
    std::ofstream(path_, std::ios::binary) << joined;
    whole_ = region_with({}), streamed_ = region_with({});
    whole_.grids.front().field.undulation = streamed_.grids.front().field.undulation = geoid_;
    whole_.meshes =
        std::make_shared<const std::vector<PlacedMesh>>(read_baked_meshes(*open(), geoid_).value());
    auto meshes = open_baked_meshes(open(), geoid_).value();
    ASSERT_EQ(meshes.size(), 3U);
    meshes[1] = (*whole_.meshes)[1];  // as of a file without its groups
    streamed_.meshes = std::make_shared<const std::vector<PlacedMesh>>(std::move(meshes));
    const auto a = MeshDetail::open(whole_, 1.0, 2), b = MeshDetail::open(streamed_, 1.0, 2);
    ASSERT_TRUE(a.ok() && b.ok());
    for (const double south_m : {100.0, 4000.0}) {
        const MeshCut one = a->cut(eye_at(south_m, 80.0), 1.0, {}, {}).value(),
                      other = b->cut(eye_at(south_m, 80.0), 1.0, {}, {}).value();
        EXPECT_EQ(one.clusters, other.clusters);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ((*one.meshes)[i].triangles, (*other.meshes)[i].triangles);
            EXPECT_EQ((*one.meshes)[i].colours, (*other.meshes)[i].colours);
            EXPECT_EQ((*one.meshes)[i].feature_of, (*other.meshes)[i].feature_of);
        }
    }
    for (std::uint32_t i = 0; i < 3; ++i)
        EXPECT_TRUE(check_streamed_mesh(*open(), i, (*whole_.meshes)[i], whole_).ok()) << i;
    EXPECT_FALSE(check_streamed_mesh(*open(), 0, (*whole_.meshes)[2], whole_).ok());
}

// Records of one mesh and groups of another, each with right checksums.
TEST_F(StreamedTriangles, OfAnotherMeshAreTold) {
    bake(coloured_sheet(40));
    const auto whole = read_baked_meshes(*open(), geoid_);
    PlacedMesh other = whole->front();
    auto moved = std::make_shared<StoredMesh>(*other.stored());
    moved->places[5][2] += 3;
    other.baked = std::make_shared<const BakedMesh>(BakedMesh{moved, nullptr, 0});
    const auto checked = check_streamed_mesh(*open(), 0, other, whole_);
    ASSERT_FALSE(checked.ok());
    EXPECT_NE(checked.error().line().find("the groups of the mesh are not those of its triangles"),
              std::string::npos);
}

}  // namespace
}  // namespace oro
